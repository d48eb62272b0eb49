# SPDX-License-Identifier: GPL-3.0-or-later
from ._core import Animation as Animation
from ._core import Droplet as Droplet
from ._core import Mask as Mask
from ._core import Surface as Surface
from ._core import Windshield as Windshield
from ._core import WindshieldFigures as WindshieldFigures
from ._core import WindshieldWater as WindshieldWater
from ._errors import Error as Error
from ._errors import InputNotFound as InputNotFound
from ._errors import InvalidArgument as InvalidArgument
from ._errors import InvalidInput as InvalidInput
from ._errors import NoSuchDroplet as NoSuchDroplet
from ._errors import OutputFailed as OutputFailed
from ._functions import animate as animate
from ._functions import compare as compare
from ._functions import dew as dew
from ._functions import flow as flow
from ._functions import glyphs as glyphs
from ._functions import make_droplet as make_droplet
from ._functions import read_mask as read_mask
from ._functions import wind_tunnel as wind_tunnel
from ._functions import windshield as windshield
from ._reports import Comparison as Comparison
from ._reports import DewReport as DewReport
from ._reports import FlowReport as FlowReport
from ._reports import Report as Report
from ._reports import SequenceReport as SequenceReport
from ._reports import WindshieldReport as WindshieldReport
from ._reports import WindTunnelReport as WindTunnelReport

__all__ = [
    "Animation",
    "Comparison",
    "DewReport",
    "Droplet",
    "Error",
    "FlowReport",
    "InputNotFound",
    "InvalidArgument",
    "InvalidInput",
    "Mask",
    "NoSuchDroplet",
    "OutputFailed",
    "Report",
    "SequenceReport",
    "Surface",
    "WindTunnelReport",
    "Windshield",
    "WindshieldFigures",
    "WindshieldReport",
    "WindshieldWater",
    "animate",
    "compare",
    "dew",
    "flow",
    "glyphs",
    "make_droplet",
    "read_mask",
    "wind_tunnel",
    "windshield",
]
__version__: str
