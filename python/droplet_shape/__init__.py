# SPDX-License-Identifier: GPL-3.0-or-later
"""Liquid droplets in 3D from masks.

    import droplet_shape as ds

    drop = ds.make_droplet(mask, width="20mm", contact_angle="40deg")
    drop.vertices, drop.triangles     # arrays that share the memory of the mesh
    drop.report.shape.volume_m3
    drop.save("drop.glb")

Each function does what a command of droplet-shape does, with the same options and results. A quantity is a number in SI
units (metres, radians, cubic metres, …), or a text with a number and a unit such as "20mm".
"""
from ._core import Animation, Droplet, Mask, Surface, Windshield, WindshieldFigures, WindshieldWater
from ._core import version as __version__
from ._errors import Error, InputNotFound, InvalidArgument, InvalidInput, NoSuchDroplet, OutputFailed
from ._functions import animate, compare, dew, flow, glyphs, make_droplet, read_mask, wind_tunnel, windshield

_REPORTS = ("Comparison", "DewReport", "FlowReport", "Report", "SequenceReport", "WindTunnelReport", "WindshieldReport")

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


def __getattr__(name: str) -> type:
    # The classes of reports take longer to load than all else, so they are loaded when they are needed.
    if name in _REPORTS:
        from . import _reports

        return getattr(_reports, name)
    raise AttributeError(f"module 'droplet_shape' has no attribute '{name}'")


def __dir__() -> list:
    return sorted([*__all__, "__version__"])
