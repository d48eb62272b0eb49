#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the functions and reports of the package from the command's --help=json and the reports' schemas.

    python/make_package.py [--check] [PROGRAM]

PROGRAM is build/release/cli/droplet-shape by default. The script writes

    python/droplet_shape/_functions.py   a function for each command, with all its options
    python/droplet_shape/_reports.py     a dataclass for each object of the schemas

With --check it writes nothing, and the exit code is 1 if a file would change.
"""
import difflib
import json
import keyword
import re
import subprocess
import sys
import textwrap
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MADE_BY = "# SPDX-License-Identifier: GPL-3.0-or-later\n# Made by python/make_package.py.\n"


# ------------------------------------------------------------------------------------------------ options of the command


@dataclass
class Option:
    name: str  # in Python
    group: str
    value: str  # name of the value in the help, or the allowed words; empty for a flag
    kind: str  # as of --help=json
    unit: str
    words: list  # those that are allowed, or may stand instead of a value
    text: str
    default: str


def read_options(program, command):
    """Options of a command, from its --help=json."""
    words = [program, *([command] if command else []), "--help=json"]
    told = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
    names = [option["name"][2:].replace("-", "_") for option in told["options"]]
    return {
        name: Option(name, **{key: option[key] for key in ("group", "value", "kind", "unit", "words", "text", "default")})
        for name, option in zip(names, told["options"])
    }


@dataclass
class Kind:
    """How values of an option are written in Python."""

    name: str  # in droplet_shape/_arguments.py
    type: str
    unit: str = ""  # of a number, where it is not that of --help=json


QUANTITY = "str | float"
KINDS = {
    "flag": Kind("flag", "bool"),
    "text": Kind("text", "str"),
    "path": Kind("path", "Path"),
    "ground": Kind("text", "str"),  # a path or a surface
    "count": Kind("number", "str | int"),
    "number": Kind("number", "float"),
    "length": Kind("m", QUANTITY),
    "area": Kind("m2", QUANTITY),
    "volume": Kind("m3", QUANTITY),
    "angle": Kind("rad", QUANTITY),
    "tension": Kind("N/m", QUANTITY),
    "density": Kind("kg/m3", QUANTITY),
    "acceleration": Kind("m/s2", QUANTITY),
    "speed": Kind("m/s", QUANTITY),
    "duration": Kind("s", QUANTITY),
    "rainfall": Kind("rainfall", QUANTITY),
    "viscosity": Kind("Pa.s", QUANTITY),
    "share": Kind("share", QUANTITY),
    "spin": Kind("rad/s", QUANTITY),
    "range": Kind("range", "str | tuple[float, float]"),
    "axes": Kind("axes", "Mapping[str, float]"),
    "vector": Kind("vector", "str | Sequence[float]"),
    "texts": Kind("texts", "str | Sequence[str]"),
    "size": Kind("size", "str | tuple[int, int]"),
    "volumes": Kind("list m3", "str | float | Sequence[float]"),
    "speeds": Kind("list m/s", "str | float | Sequence[float]"),
    "angles": Kind("list rad", "str | float | Sequence[float]"),
    "numbers": Kind("list ", "str | float | Sequence[float]"),
    "band": Kind("band m/s", "str | tuple[float, float]"),
    "angles_of_place": Kind("list rad", "str | Sequence[float]"),
    "lengths_of_place": Kind("list m", "str | Sequence[float]"),
    "open": Kind("number", QUANTITY, "1 is the whole time"),
}


def kind_of(option):
    if option.kind != "words":
        return KINDS[option.kind]
    literals = ", ".join(word if word.isdigit() else f'"{word}"' for word in option.words)
    return Kind("number" if any(word.isdigit() for word in option.words) else "text", f"Literal[{literals}]")


# --------------------------------------------------------------------------------------------------------- the functions


@dataclass
class Function:
    name: str
    command: str
    groups: list  # of options, in this order
    parameters: str  # before the options
    returns: str
    doc: str
    body: str
    leave_out: set = field(default_factory=set)
    only: set = field(default_factory=set)
    run: set = field(default_factory=lambda: {"solver", "threads"})  # options of the group Run


SHAPE = ["Liquid", "Gravity and ground", "Surface"]
FUNCTIONS = [
    Function(
        "read_mask",
        "",
        ["Footprint"],
        "path: Path",
        "Mask",
        """\
Reads the mask in a picture.

Formats are PNG, JPEG, SVG, GIF, TIFF, WebP, BMP, TGA, ICO, PNM, JPEG 2000, OpenEXR and HDR. It does what the command does with its INPUT. numpy.asarray() of the result is the array of the mask.

path: file of the picture.

>>> read_mask("data/ampersand.png", channel="luma")
<Mask of 642 x 548 pixels>
""",
        "_core.read_mask(path, {tokens})",
        only={"channel", "threshold", "invert", "segment", "colour"},
        run=set(),
    ),
    Function(
        "make_droplet",
        "",
        ["Footprint", *SHAPE],
        "mask: MaskLike",
        "Droplet",
        """\
Makes the droplets of liquid that have a mask as their footprints.

mask: array of two dimensions, rows from the top: bool; uint8 or uint16, whose largest value is liquid; or float from 0 to
1. Or the result of read_mask(). With by_colour, an array of rows, columns, and red, green, blue and maybe alpha, of uint8.

>>> import numpy
>>> y, x = numpy.mgrid[-1:1:200j, -1:1:200j]
>>> drop = make_droplet(x**2 + y**2 < 0.8, width="10mm", volume="30uL", triangles=2000)
>>> round(drop.report.shape.volume_ul, 6)
30.0
>>> drop.vertices.shape[1], drop.triangles.dtype
(3, dtype('uint32'))
>>> flag = numpy.zeros((60, 90, 3), numpy.uint8)
>>> flag[:, :45], flag[:, 45:] = (0, 0, 255), (255, 215, 0)
>>> [droplet.colour for droplet in make_droplet(flag, by_colour=True, triangles=1000).report.droplets]
['#0000ff', '#ffd700']
""",
        "_core.make_droplet(mask_of(mask), {tokens})",
        leave_out={
            "segment", "colour", "mask_out", "unit", "format", "material",
            "colour_map", "nodes", "materials", "droplets_only", "compress", "sink", "base", "lod", "weld",
        },
    ),
    Function(
        "glyphs",
        "glyphs",
        ["Type", *SHAPE],
        "font: Path, text: str",
        "Droplet",
        """\
Makes the droplets of a text.

font: file of the font: TrueType, OpenType, a collection, WOFF or Type 1.
text: one line or more, separated by line feeds.

>>> from matplotlib import font_manager
>>> drop = glyphs(font_manager.findfont("DejaVu Serif"), "ok", em="10mm", triangles=2000)
>>> len(drop.report.droplets)
2
""",
        "_core.glyphs(font, text, {tokens})",
        leave_out={
            "font", "text", "charset", "all", "list", "output", "json", "equal_height", "unit", "format", "material", "nodes",
            "materials", "droplets_only", "compress", "sink", "base", "lod", "weld", "by_colour", "palette", "text_colour", "gap",
        },
    ),
    Function(
        "animate",
        "animate",
        ["Sequence", "Footprint", *SHAPE],
        "frames: Iterable[MaskLike]",
        "Animation",
        """\
Makes droplets whose footprints move.

frames: masks of one size, as of make_droplet(), one after another. A mask without liquid is allowed. One on which no droplet
is stable shows the droplets of the mask before; a warning and `held` in the report say so.

>>> import numpy
>>> y, x = numpy.mgrid[-1:1:150j, -1:1:150j]
>>> frames = [x**2 + y**2 < radius**2 for radius in (0.6, 0.62, 0.64)]
>>> film = animate(frames, width="10mm", volume="20uL", triangles=1000)
>>> len(film), film.report.transitions.vertices_kept
(3, 2)
""",
        "_core.animate(masks_of(frames), {tokens})",
        # The last six are of the command's one picture; here, footprints that move are the frames.
        leave_out={
            "channel", "segment", "colour", "contact_sheet", "unit", "material", "onto", "advancing", "receding", "lod", "reveal",
            "drips", "seed", "feed", "slow", "frames",
        },
    ),
    Function(
        "compare",
        "compare",
        ["Allowed"],
        "a: Surface | Path, b: Surface | Path",
        "Comparison",
        """\
Measures the difference of two surfaces.

The bounds of the largest distance hold for all points, not only for vertices.

a, b: surfaces, or files: .glb, .gltf, .obj, .ply or .stl.

With a tolerance, Comparison.exceeded lists the differences over it; topologies must then be the same, too.

>>> import numpy
>>> y, x = numpy.mgrid[-1:1:150j, -1:1:150j]
>>> coarse, fine = (make_droplet(x**2 + y**2 < 0.8, triangles=n) for n in (1000, 4000))
>>> compare(coarse, fine, tolerance="0.2mm").exceeded
()
""",
        "_reports.Comparison.from_json(_core.compare(a, b, {tokens}))",
        run={"threads"},
    ),
    Function(
        "wind_tunnel",
        "wind-tunnel",
        ["Sweep", "Coating", "Air", "Liquid", "Charts and series"],
        "",
        "WindTunnelReport",
        """\
Computes how droplets on a slope move in the wind: all combinations of volumes, winds, slopes and hystereses.

>>> report = wind_tunnel(volume=["10uL", "30uL"], wind_speed="0..16m/s:1", slope=[0.6])
>>> [round(case.upper_threshold_m_per_s, 1) for case in report.runs[0].cases]
[11.7, 10.5]
""",
        "_reports.WindTunnelReport.from_json(_core.wind_tunnel({tokens}))",
        leave_out={"chart", "map", "trace", "time", "trace_step", "initial_speed", "gust", "gust_period"},
        run={"threads"},
    ),
    Function(
        "windshield",
        "windshield",
        ["Car and rain", "Glass", "Droplets", "Coating", "Air", "Liquid", "Time", "View", "Beside the frames"],
        "output: Path",
        "WindshieldReport",
        """\
Simulates rain on the windshield of a moving car, and writes what the driver sees.

output: frames such as out/%05d.png; a video, .mp4, .mkv, .mov or .webm, which needs ffmpeg; or a .png of the last frame.

>>> report = windshield("still.png", time="0.1s", warm_up="1s", frame_size=(160, 90), samples=1)
>>> report.output.frames, report.warnings
(3, ())
""",
        "_reports.WindshieldReport.from_json(_core.windshield(output, {tokens}))",
        leave_out={"json", "live"},
        run={"resume", "no_clobber", "threads"},
    ),
    Function(
        "flow",
        "flow",
        ["Object", "Droplets", "Motion", "Coating", "Air", "Liquid", "Time", "Output", "Picture"],
        "object: Path | None, output: Path",
        "FlowReport",
        """\
Lets droplets run over a mesh, and writes them.

object: mesh: .glb, .gltf, .obj, .ply or .stl; or None for the object of the preset.
output: animated .glb; meshes of the droplets in every frame, such as out/%04d.obj; pictures, out/%04d.png; a .png of the
last frame; or a video, .mp4, .mkv, .mov or .webm, which needs ffmpeg.

>>> report = flow("data/can.glb", "wet.glb", drops=20, time="0.1s")
>>> report.counts.released
20
""",
        "_reports.FlowReport.from_json(_core.flow(object, output, {tokens}))",
        leave_out={"json"},
        run={"resume", "no_clobber", "threads"},
    ),
    Function(
        "dew",
        "dew",
        ["Object", "Droplets", "Slopes", "Coating", "Liquid", "Output"],
        "object: Path, output: Path",
        "DewReport",
        """\
Covers an object with droplets that rest on it, and writes them.

object: mesh: .glb, .gltf, .obj, .ply or .stl.
output: the object and its droplets, .glb, .gltf, .usda or .usdz; or the droplets alone, .obj, .ply or .stl.

>>> report = dew("data/can.glb", "wet.glb", coverage=0.1, smallest="1mm", largest="2mm")
>>> report.droplets.count > 10, report.preset
(True, 'dew')
""",
        "_reports.DewReport.from_json(_core.dew(object, output, {tokens}))",
        leave_out={"json"},
        run={"no_clobber", "threads"},
    ),
]


def in_python(text):
    """A text of the help, with the names that options have in Python."""
    text = re.sub(r"--([a-z][a-z-]+)", lambda match: match.group(1).replace("-", "_"), text)
    return re.sub(r"; - is standard output|, and - ", "", text).replace("\\", "\\\\")


def line_of(option, kind):
    unit = kind.unit or option.unit.replace("2", "²").replace("3", "³").replace(".", "·")
    unit = f" [{unit}]" if unit else ""
    allowed = f": {option.value.replace('|', ', ')}" if "|" in option.value and option.value[0].islower() else ""
    text = in_python(option.text) + (f" (default: {in_python(option.default)})" if option.default else "")
    return f"{option.name}{unit}{allowed}: {text}"


def wrapped(text, indent, hanging=""):
    return textwrap.fill(
        text, 118, initial_indent=indent, subsequent_indent=indent + hanging, break_long_words=False, break_on_hyphens=False
    )


INPUT_OF = {
    "read_mask": "the file is no picture, or has no mask",
    "make_droplet": "the mask has no liquid",
    "glyphs": "the font cannot be read, or the text has no ink",
    "animate": "no frame has liquid, or sizes differ",
    "compare": "a file cannot be read",
    "wind_tunnel": "never",
    "windshield": "a file cannot be read",
    "flow": "a file cannot be read, or there is no place for droplets",
    "dew": "a file cannot be read, or there is no place for droplets",
}


def raises_of(function):
    raises = ["InvalidArgument: a value is outside of its range"]
    if function.name != "wind_tunnel":
        raises.append(f"InvalidInput: {INPUT_OF[function.name]}")
    if function.name in ("windshield", "flow", "dew"):
        raises.append("OutputFailed: a file cannot be written")
    if function.name in ("make_droplet", "glyphs", "animate"):
        raises.append("NoSuchDroplet: no such droplet exists, or the solver failed")
    return "Raises " + "; ".join(raises) + "."


def write_function(function, program):
    options = read_options(program, function.command)
    chosen = []
    for group in function.groups:
        found = [option for option in options.values() if option.group == group and option.name not in function.leave_out]
        if not found:
            raise SystemExit(f"make_package.py: {function.name}: no options in the group {group}")
        chosen += [option for option in found if not function.only or option.name in function.only]
    chosen += [option for option in options.values() if option.group == "Run" and option.name in function.run]
    kinds = {option.name: kind_of(option) for option in chosen}

    signature = [part.strip() for part in re.split(r", (?=\w+:)", function.parameters) if part] + ["*"]
    for option in chosen:
        kind = kinds[option.name]
        name = parameter_name(option.name)
        signature.append(f"{name}: bool = False" if kind.name == "flag" else f"{name}: {kind.type} | None = None")
    lines = [f"_{function.name.upper()} = {{"]
    lines += [f'    "{parameter_name(name)}": "{kind.name}",' for name, kind in kinds.items()]
    lines += ["}", "", "", f"def {function.name}("]
    for part in signature:
        name, is_literal, words = part.partition("Literal[")
        if is_literal and len(part) > 113:
            words = wrapped(words.rpartition("]")[0] + ",", " " * 8)
            part = f"{name}Literal[\n{words}\n    ]{part.rpartition(']')[2]}"
        lines.append(f"    {part},")
    lines += [f") -> {function.returns}:"]
    title, _, doc = function.doc.rstrip("\n").partition("\n")
    lines += ['    """' + title]
    for line in doc.split("\n"):
        lines.append("    " + line if line.startswith(">>>") else wrapped(line, "    "))
    group = None
    for option in chosen:
        if option.group != group:
            group = option.group
            lines += ["", f"    {group}:"]
        lines.append(wrapped(line_of(option, kinds[option.name]), " " * 6, "  "))
    lines += ["", wrapped(raises_of(function), " " * 4), '    """']
    body = function.body.format(tokens=f"arguments_of(_{function.name.upper()}, locals())")
    lines += [f"    return {body}", ""]
    return "\n".join(lines)


def parameter_name(name):
    return name + "_" if keyword.iskeyword(name) else name


FUNCTIONS_HEAD = '''"""Functions of the package; each does what a command of droplet-shape does.

A quantity is a number in SI units (metres, radians, cubic metres, …), or a text with a number and a unit: "20mm".
"""
from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, Union

from . import _core
from ._arguments import arguments_of, mask_of, masks_of
from ._core import Animation, Droplet, Mask, Surface

if TYPE_CHECKING:
    import numpy

    from ._reports import Comparison, FlowReport, WindshieldReport, WindTunnelReport

    MaskLike = Union[numpy.ndarray, Mask]
    Path = Union[str, os.PathLike[str]]


class _Reports:
    """The module of the reports, loaded when it is first used."""

    def __getattr__(self, name: str):
        from . import _reports

        return getattr(_reports, name)


_reports = _Reports()
'''


def functions_text(program):
    return MADE_BY + FUNCTIONS_HEAD + "".join("\n\n" + write_function(function, program) for function in FUNCTIONS)


# ----------------------------------------------------------------------------------------------------------- the reports

ROOTS = {
    "report": ("Report", "Report", "Report on droplets, with the names of the command's JSON report."),
    "compare": ("Comparison", "Comparison", "Difference of two surfaces."),
    "sequence": ("SequenceReport", "Sequence", "Report on droplets whose footprints move."),
    "wind-tunnel": ("WindTunnelReport", "WindTunnel", "Droplets in the wind tunnel."),
    "windshield": ("WindshieldReport", "Windshield", "Report on rain on a windshield."),
    "flow": ("FlowReport", "Flow", "Report on droplets that run over a mesh."),
    "dew": ("DewReport", "Dew", "Report on droplets that rest on an object."),
}
NAMES = {
    "a": "surface",
    "cases": "case",
    "distance_from_measured": "distance",
    "droplets": "droplet",
    "emitters": "emitter",
    "frames": "frame",
    "runs": "run",
}
UNITS = re.compile(r"(_(m|m2|m3|deg|s|n|j|px|pa))+$")
SIMPLE = {"number": "float", "integer": "int", "string": "str", "boolean": "bool"}


class Reports:
    """Dataclasses of a schema, inner ones first."""

    def __init__(self, prefix):
        self.prefix = prefix
        self.classes = {}  # name: (description, [(key, type, description)])

    def type_of(self, key, schema):
        """Type of a value, and the name of its dataclass or an empty text."""
        kinds = schema.get("type", [])
        kinds = [kinds] if isinstance(kinds, str) else list(kinds)
        optional = " | None" if "null" in kinds else ""
        if "const" in schema or "enum" in schema:
            return "str" + optional
        kinds = [kind for kind in kinds if kind != "null"]
        kind = kinds[0] if len(kinds) == 1 else ""
        if kind == "object" and "properties" not in schema:
            return "dict[str, Any]" + optional
        if kind == "object":
            name = UNITS.sub("", key)
            name = NAMES.get(name, name)
            return self.add(self.prefix + "".join(word.capitalize() for word in name.split("_")), schema) + optional
        if kind == "array":
            items = schema.get("items")
            return f"tuple[{self.type_of(key, items) if items else 'Any'}, ...]" + optional
        return SIMPLE[kind] + optional if kind in SIMPLE else "Any"

    def add(self, name, schema, text=""):
        members = []
        for key, value in schema["properties"].items():
            description = value.get("description", "")
            members.append((key, self.type_of(key, value), description))
        for known, (_, known_members) in self.classes.items():
            if known_members == members:
                return known
        if name in self.classes:
            raise SystemExit(f"make_package.py: two objects of the schemas would be {name}")
        self.classes[name] = (text or schema.get("description", ""), members)
        return name

    def text(self):
        parts = []
        for name, (description, members) in self.classes.items():
            doc = description or f"{name} of a report"
            lines = ["@dataclass(frozen=True)", f"class {name}(_Report):", f'    """{doc.rstrip(".")}."""', ""]
            for key, type_name, comment in members:
                line = f"    {parameter_name(key)}: {type_name}"
                lines.append(f"{line}  # {comment}" if comment and len(line) + len(comment) < 117 else line)
            parts.append("\n".join(lines) + "\n")
        return "\n\n".join(parts)


REPORTS_HEAD = '''"""Reports as dataclasses; members have the names of the JSON reports (docs/reports.md) and their units.

A name that is a word of Python has an underscore at its end: from_.
"""
from __future__ import annotations

import json
from dataclasses import dataclass, fields
from typing import Any, TypeVar

from ._errors import in_python

_T = TypeVar("_T", bound="_Report")


class _Report:
    """Base of all reports."""

    @classmethod
    def from_json(cls: type[_T], text: str) -> _T:
        """Makes a report from the JSON text that the command writes; keys that are not known are left out."""
        return _made(cls, json.loads(text))


def _made(report: type[_T], values: dict[str, Any]) -> _T:
    members = {}
    for member in fields(report):  # type: ignore[arg-type]
        key = member.name.rstrip("_")
        value = values.get(key)
        if member.name == "warnings":
            value = [in_python(line) for line in values["warnings"]]
        members[member.name] = _member(str(member.type), value)
    return report(**members)


def _member(type_name: str, value: Any) -> Any:
    if isinstance(value, list):
        inner = type_name.removesuffix(" | None").removeprefix("tuple[").removesuffix(", ...]")
        return tuple(_member(inner, item) for item in value)
    if isinstance(value, dict) and not type_name.startswith("dict["):
        return _made(globals()[type_name.removesuffix(" | None")], value)
    return value


'''


def reports_text():
    parts = []
    for stem, (root, prefix, text) in ROOTS.items():
        reports = Reports(prefix)
        schema = json.loads((ROOT / f"docs/schema/{stem}.json").read_text())
        reports.add(root, schema, text)
        parts.append(reports.text())
    return MADE_BY + REPORTS_HEAD + "\n\n".join(parts)


def main():
    check = "--check" in sys.argv[1:]
    programs = [argument for argument in sys.argv[1:] if argument != "--check"]
    program = str(Path(programs[0] if programs else ROOT / "build/release/cli/droplet-shape").resolve())
    package = ROOT / "python/droplet_shape"
    differs = False
    for path, text in {package / "_functions.py": functions_text(program), package / "_reports.py": reports_text()}.items():
        compile(text, path, "exec")  # two options, or an option and an input, may not have one name
        before = path.read_text() if path.exists() else ""
        if before == text:
            continue
        differs = True
        name = str(path.relative_to(ROOT))
        if check:
            sys.stdout.writelines(difflib.unified_diff(before.splitlines(True), text.splitlines(True), name, name))
        else:
            path.write_text(text)
            print(name)
    return 1 if check and differs else 0


if __name__ == "__main__":
    sys.exit(main())
