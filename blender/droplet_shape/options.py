# SPDX-License-Identifier: GPL-3.0-or-later
"""Words, ranges and defaults of the command's options. scripts/make-docs writes options.json from --help=json."""

import json
import re
from pathlib import Path

_OPTIONS = json.loads(Path(__file__).with_name("options.json").read_text(encoding="utf-8"))


def words(name):
    """The allowed words of an option."""
    return _OPTIONS[name]["words"]


def number(name):
    """The number in an option's default, in the default's unit: 20 of 20mm, 40000 of 40k."""
    value, factor = re.match(r"(-?[0-9.]+)([kM]?)", _OPTIONS[name]["default"]).groups()
    return float(value) * {"": 1, "k": 1e3, "M": 1e6}[factor]


def limits(name, unit=1.0, whole=False):
    """The range of an option, as arguments of a property of Blender. unit: in SI units."""
    kind = int if whole else float
    largest = 2**31 - 1  # of Blender's whole numbers
    low, high = (_OPTIONS[name][end] / unit for end in ("min", "max"))
    return {"min": kind(low), "max": kind(min(high, largest) if whole else high)}
