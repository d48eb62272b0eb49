# SPDX-License-Identifier: GPL-3.0-or-later
# Made by python/make_package.py.
"""Functions of the package; each does what a command of droplet-shape does.

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


_READ_MASK = {
    "channel": "text",
    "threshold": "number",
    "invert": "flag",
    "segment": "text",
    "colour": "text",
}


def read_mask(
    path: Path,
    *,
    channel: Literal["auto", "alpha", "luma"] | None = None,
    threshold: float | None = None,
    invert: bool = False,
    segment: Literal["auto", "threshold", "adaptive", "grabcut"] | None = None,
    colour: str | None = None,
) -> Mask:
    """Reads the mask in a picture.

    Formats are PNG, JPEG, SVG, GIF, TIFF, WebP, BMP, TGA, ICO, PNM, JPEG 2000, OpenEXR and HDR. It does what the
    command does with its INPUT. numpy.asarray() of the result is the array of the mask.

    path: file of the picture.

    >>> read_mask("data/ampersand.png", channel="luma")
    <Mask of 642 x 548 pixels>

    Footprint:
      channel: auto, alpha, luma: Channel that shows the liquid: auto takes alpha if the picture has transparent
        parts, else what differs from the brightness of its border (default: auto)
      threshold: Coverage at which liquid begins, between 0 and 1 (default: 0.5)
      invert: Exchange liquid and dry
      segment: auto, threshold, adaptive, grabcut: How to separate liquid from dry: threshold for drawings and scans,
        adaptive for photographs in uneven light, grabcut by colour; auto chooses and reports its choice (default:
        auto)
      colour: Take the regions of this colour, such as red or #e30613

    Raises InvalidArgument: a value is outside of its range; InvalidInput: the file is no picture, or has no mask.
    """
    return _core.read_mask(path, arguments_of(_READ_MASK, locals()))


_MAKE_DROPLET = {
    "width": "m",
    "pixel_size": "m",
    "channel": "text",
    "threshold": "number",
    "invert": "flag",
    "smooth": "m",
    "fill_holes": "m2",
    "keep": "number",
    "speck_size": "number",
    "by_colour": "flag",
    "colours": "number",
    "gap": "m",
    "seeds": "path",
    "contact_angle": "rad",
    "on": "text",
    "volume": "m3",
    "height": "m",
    "fill": "text",
    "liquid": "text",
    "surface_tension": "N/m",
    "density": "kg/m3",
    "model": "text",
    "gravity": "m/s2",
    "tilt": "rad",
    "tilt_direction": "rad",
    "surface": "text",
    "surface_depth": "m",
    "no_penetration": "flag",
    "onto": "path",
    "scale": "number",
    "object_size": "m",
    "up": "text",
    "advancing": "rad",
    "receding": "rad",
    "triangles": "number",
    "edge": "m",
    "grading": "number",
    "open": "flag",
    "quads": "flag",
    "fill_range": "range",
    "solver": "text",
    "threads": "number",
}


def make_droplet(
    mask: MaskLike,
    *,
    width: str | float | None = None,
    pixel_size: str | float | None = None,
    channel: Literal["auto", "alpha", "luma"] | None = None,
    threshold: float | None = None,
    invert: bool = False,
    smooth: str | float | None = None,
    fill_holes: str | float | None = None,
    keep: str | int | None = None,
    speck_size: float | None = None,
    by_colour: bool = False,
    colours: str | int | None = None,
    gap: str | float | None = None,
    seeds: Path | None = None,
    contact_angle: str | float | None = None,
    on: Literal["glass", "ptfe", "wax", "lotus"] | None = None,
    volume: str | float | None = None,
    height: str | float | None = None,
    fill: Literal["each", "total"] | None = None,
    liquid: Literal["water", "ethanol", "glycerol", "mercury", "honey"] | None = None,
    surface_tension: str | float | None = None,
    density: str | float | None = None,
    model: Literal["auto", "linear", "exact"] | None = None,
    gravity: str | float | None = None,
    tilt: str | float | None = None,
    tilt_direction: str | float | None = None,
    surface: str | None = None,
    surface_depth: str | float | None = None,
    no_penetration: bool = False,
    onto: Path | None = None,
    scale: float | None = None,
    object_size: str | float | None = None,
    up: Literal["y", "z"] | None = None,
    advancing: str | float | None = None,
    receding: str | float | None = None,
    triangles: str | int | None = None,
    edge: str | float | None = None,
    grading: Literal["auto", 1, 2, 4, 8, 16, 32, 64] | None = None,
    open: bool = False,
    quads: bool = False,
    fill_range: str | tuple[float, float] | None = None,
    solver: Literal["auto", "llt", "multigrid"] | None = None,
    threads: str | int | None = None,
) -> Droplet:
    """Makes the droplets of liquid that have a mask as their footprints.

    mask: array of two dimensions, rows from the top: bool; uint8 or uint16, whose largest value is liquid; or float
    from 0 to
    1. Or the result of read_mask(). With by_colour, an array of rows, columns, and red, green, blue and maybe alpha,
    of uint8.

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

    Footprint:
      width [m]: Width of the picture; an SVG may state its own (default: 20mm)
      pixel_size [m]: Size of one pixel, instead of width
      channel: auto, alpha, luma: Channel that shows the liquid: auto takes alpha if the picture has transparent
        parts, else what differs from the brightness of its border (default: auto)
      threshold: Coverage at which liquid begins, between 0 and 1 (default: 0.5)
      invert: Exchange liquid and dry
      smooth [m]: Remove spots, and bends of the rim, that are narrower than this
      fill_holes [m²]: Fill holes smaller than this, such as glints: 1mm2
      keep: Keep only the N largest droplets
      speck_size: Drop spots and holes smaller than F square pixels (default: 3)
      by_colour: Make one droplet for each region of one colour, in that colour; neighbours share their boundary. Dry
        is what is transparent, else the border's colour if 95 % of the border has it; channel alpha: only what is
        transparent; channel luma: the border's most common colour
      colours: Number of colours for by_colour, 1 to 64 (default: auto)
      gap [m]: Dry width between neighbours for by_colour (default: none)
      seeds: Strokes on the picture, in a picture of its size: light ones on liquid, dark ones on dry ground, the rest
        transparent or grey; for clear droplets, whose rims are then found between them

    Liquid:
      contact_angle [rad]: Amount of liquid, by the mean contact angle along the rim, up to 179deg; natural: that of
        the liquid on what it lies on. By default no droplet is higher than a puddle of 40deg; by default and with
        natural, the largest angle that exists is taken if that one does not (default: 40deg)
      on: glass, ptfe, wax, lotus: What the liquid lies on, for contact_angle natural (default: glass)
      volume [m³]: Amount of liquid, by its volume
      height [m]: Amount of liquid, by its largest height; if two droplets have it, the one with less liquid
      fill: each, total: each: every droplet gets this amount; total: all droplets share it at one pressure (default:
        each)
      liquid: water, ethanol, glycerol, mercury, honey: Liquid, at 20 C (default: water)
      surface_tension [N/m]: Surface tension, instead of the liquid's own
      density [kg/m³]: Density, instead of the liquid's own
      model: auto, linear, exact: Model of the surface's area: linear is within 1 % up to 5 to 8deg, exact for all
        slopes, also where liquid hangs over its rim; auto takes linear where it is within 0.3 % (default: auto)

    Gravity and ground:
      gravity [m/s²]: Gravity into the ground; negative under a ceiling (default: 9.81m/s2)
      tilt [rad]: Tilt of the ground: 90deg is a wall, 180deg a ceiling (default: 0deg)
      tilt_direction [rad]: Direction of downhill, counter-clockwise from the picture's right; -90deg is its lower
        edge (default: -90deg)
      surface: Curved ground: a height map's file, white is high; sphere:R=40mm; or cylinder:R=33mm,axis=y, with axis
        x, y or an angle; R < 0 is a bowl or a gutter (default: flat)
      surface_depth [m]: Height of white above black in the height map; samples that are floating-point numbers are
        metres without it
      no_penetration: Keep the liquid above the ground; where it would sink in, the ground stays dry
      onto: Lay the droplets on the object in a .glb, .gltf, .obj or .ply file by its texture coordinates; a .glb,
        .gltf, .usda or .usdz has the object with them, other formats the droplets alone
      scale: With onto: Factor on the lengths of the file (default: 1)
      object_size [m]: With onto: Longest side of the object, 0.1mm to 1000m; scales it
      up: y, z: With onto: Axis that points up in an .obj, .ply or .stl (default: y, of .ply z)
      advancing [rad]: Advancing contact angle; with receding the report says whether droplets slide
      receding [rad]: Receding contact angle, at most advancing

    Surface:
      triangles: Number of triangles of the liquid's surface, within 10 %: 5000, 5k, 1M (default: 40k)
      edge [m]: Edge length of the triangles, instead of triangles
      grading: auto, 1, 2, 4, 8, 16, 32, 64: Largest edge length far from the rim, as a multiple of the length at the
        rim; auto: 1, or 64 in puddles where gravity flattens all but the rim (default: auto)
      open: Leave out the base
      quads: Quadrilaterals along the rim, for subdivision and sculpting, in .obj, .ply and USD; triangles counts
        their halves
      fill_range: Add a slider to glTF that fills and drains the droplet, such as 0..2 from none to twice its liquid;
        takes the linear model unless model exact is given

    Run:
      solver: auto, llt, multigrid: Solver of the linear system: llt is Eigen's factorisation, multigrid iterates;
        auto takes llt for linear models of up to 25,000 unknowns and for small or irregular meshes (default: auto)
      threads: Maximum number of threads (default: all cores)

    Raises InvalidArgument: a value is outside of its range; InvalidInput: the mask has no liquid; NoSuchDroplet: no
    such droplet exists, or the solver failed.
    """
    return _core.make_droplet(mask_of(mask), arguments_of(_MAKE_DROPLET, locals()))


_GLYPHS = {
    "face_index": "number",
    "axis": "axes",
    "em": "m",
    "tolerance": "m",
    "align": "text",
    "line_sizes": "list ",
    "line_spacing": "number",
    "tracking": "number",
    "line_width": "m",
    "arc": "m",
    "path": "path",
    "path_width": "m",
    "shift": "number",
    "contact_angle": "rad",
    "on": "text",
    "volume": "m3",
    "height": "m",
    "fill": "text",
    "liquid": "text",
    "surface_tension": "N/m",
    "density": "kg/m3",
    "model": "text",
    "gravity": "m/s2",
    "tilt": "rad",
    "tilt_direction": "rad",
    "surface": "text",
    "surface_depth": "m",
    "no_penetration": "flag",
    "onto": "path",
    "scale": "number",
    "object_size": "m",
    "up": "text",
    "advancing": "rad",
    "receding": "rad",
    "triangles": "number",
    "edge": "m",
    "grading": "number",
    "open": "flag",
    "quads": "flag",
    "fill_range": "range",
    "solver": "text",
    "threads": "number",
}


def glyphs(
    font: Path,
    text: str,
    *,
    face_index: str | int | None = None,
    axis: Mapping[str, float] | None = None,
    em: str | float | None = None,
    tolerance: str | float | None = None,
    align: Literal["start", "centre", "end"] | None = None,
    line_sizes: str | float | Sequence[float] | None = None,
    line_spacing: float | None = None,
    tracking: float | None = None,
    line_width: str | float | None = None,
    arc: str | float | None = None,
    path: Path | None = None,
    path_width: str | float | None = None,
    shift: float | None = None,
    contact_angle: str | float | None = None,
    on: Literal["glass", "ptfe", "wax", "lotus"] | None = None,
    volume: str | float | None = None,
    height: str | float | None = None,
    fill: Literal["each", "total"] | None = None,
    liquid: Literal["water", "ethanol", "glycerol", "mercury", "honey"] | None = None,
    surface_tension: str | float | None = None,
    density: str | float | None = None,
    model: Literal["auto", "linear", "exact"] | None = None,
    gravity: str | float | None = None,
    tilt: str | float | None = None,
    tilt_direction: str | float | None = None,
    surface: str | None = None,
    surface_depth: str | float | None = None,
    no_penetration: bool = False,
    onto: Path | None = None,
    scale: float | None = None,
    object_size: str | float | None = None,
    up: Literal["y", "z"] | None = None,
    advancing: str | float | None = None,
    receding: str | float | None = None,
    triangles: str | int | None = None,
    edge: str | float | None = None,
    grading: Literal["auto", 1, 2, 4, 8, 16, 32, 64] | None = None,
    open: bool = False,
    quads: bool = False,
    fill_range: str | tuple[float, float] | None = None,
    solver: Literal["auto", "llt", "multigrid"] | None = None,
    threads: str | int | None = None,
) -> Droplet:
    """Makes the droplets of a text.

    font: file of the font: TrueType, OpenType, a collection, WOFF or Type 1.
    text: one line or more, separated by line feeds.

    >>> from matplotlib import font_manager
    >>> drop = glyphs(font_manager.findfont("DejaVu Serif"), "ok", em="10mm", triangles=2000)
    >>> len(drop.report.droplets)
    2

    Type:
      face_index: Index of the font in a collection (default: 0)
      axis: Axis of a variable font, such as wght=700; may be given several times
      em [m]: Type size: edge of the em square (default: 20mm)
      tolerance [m]: Largest error of a curve drawn as lines (default: em/20000)
      align: start, centre, end: Alignment of the lines of a text; Hebrew and Arabic start on the right (default:
        start)
      line_sizes: Type sizes of the lines between \\n, in em: 2,1 makes the first line twice as large; the last number
        holds for all further lines (default: 1)
      line_spacing: Leading: distance of lines, as a multiple of the font's own (default: 1)
      tracking: Extra width between the letters of a text, as a share of the em, such as 0.05 (default: 0)
      line_width [m]: Width at which the lines of a text break at spaces (default: only at \\n)
      arc [m]: Set a text around a circle of this radius; below 0, such as -30mm, inside along its lower half
        (default: none)
      path: Set a text along a path of this SVG drawing: the one that the drawing's own text follows, or the longest
      path_width [m]: Width of the page of path (default: its own; a px and a number without a unit are 1/96 inch)
      shift: Move a text along arc or path, by this share of its length, such as 0.25; around if it is closed
        (default: 0)

    Liquid:
      contact_angle [rad]: Amount of liquid, by the mean contact angle along the rim, up to 179deg; natural: that of
        the liquid on what it lies on. By default no droplet is higher than a puddle of 40deg; by default and with
        natural, the largest angle that exists is taken if that one does not (default: 40deg)
      on: glass, ptfe, wax, lotus: What the liquid lies on, for contact_angle natural (default: glass)
      volume [m³]: Amount of liquid, by its volume
      height [m]: Amount of liquid, by its largest height; if two droplets have it, the one with less liquid
      fill: each, total: each: every droplet gets this amount; total: all droplets share it at one pressure (default:
        each)
      liquid: water, ethanol, glycerol, mercury, honey: Liquid, at 20 C (default: water)
      surface_tension [N/m]: Surface tension, instead of the liquid's own
      density [kg/m³]: Density, instead of the liquid's own
      model: auto, linear, exact: Model of the surface's area: linear is within 1 % up to 5 to 8deg, exact for all
        slopes, also where liquid hangs over its rim; auto takes linear where it is within 0.3 % (default: auto)

    Gravity and ground:
      gravity [m/s²]: Gravity into the ground; negative under a ceiling (default: 9.81m/s2)
      tilt [rad]: Tilt of the ground: 90deg is a wall, 180deg a ceiling (default: 0deg)
      tilt_direction [rad]: Direction of downhill, counter-clockwise from the picture's right; -90deg is its lower
        edge (default: -90deg)
      surface: Curved ground: a height map's file, white is high; sphere:R=40mm; or cylinder:R=33mm,axis=y, with axis
        x, y or an angle; R < 0 is a bowl or a gutter (default: flat)
      surface_depth [m]: Height of white above black in the height map; samples that are floating-point numbers are
        metres without it
      no_penetration: Keep the liquid above the ground; where it would sink in, the ground stays dry
      onto: Lay the droplets on the object in a .glb, .gltf, .obj or .ply file by its texture coordinates; a .glb,
        .gltf, .usda or .usdz has the object with them, other formats the droplets alone
      scale: With onto: Factor on the lengths of the file (default: 1)
      object_size [m]: With onto: Longest side of the object, 0.1mm to 1000m; scales it
      up: y, z: With onto: Axis that points up in an .obj, .ply or .stl (default: y, of .ply z)
      advancing [rad]: Advancing contact angle; with receding the report says whether droplets slide
      receding [rad]: Receding contact angle, at most advancing

    Surface:
      triangles: Number of triangles of the liquid's surface, within 10 %: 5000, 5k, 1M (default: 40k)
      edge [m]: Edge length of the triangles, instead of triangles
      grading: auto, 1, 2, 4, 8, 16, 32, 64: Largest edge length far from the rim, as a multiple of the length at the
        rim; auto: 1, or 64 in puddles where gravity flattens all but the rim (default: auto)
      open: Leave out the base
      quads: Quadrilaterals along the rim, for subdivision and sculpting, in .obj, .ply and USD; triangles counts
        their halves
      fill_range: Add a slider to glTF that fills and drains the droplet, such as 0..2 from none to twice its liquid;
        takes the linear model unless model exact is given

    Run:
      solver: auto, llt, multigrid: Solver of the linear system: llt is Eigen's factorisation, multigrid iterates;
        auto takes llt for linear models of up to 25,000 unknowns and for small or irregular meshes (default: auto)
      threads: Maximum number of threads (default: all cores)

    Raises InvalidArgument: a value is outside of its range; InvalidInput: the font cannot be read, or the text has no
    ink; NoSuchDroplet: no such droplet exists, or the solver failed.
    """
    return _core.glyphs(font, text, arguments_of(_GLYPHS, locals()))


_ANIMATE = {
    "volume_mode": "text",
    "fps": "number",
    "width": "m",
    "pixel_size": "m",
    "threshold": "number",
    "invert": "flag",
    "smooth": "m",
    "fill_holes": "m2",
    "keep": "number",
    "speck_size": "number",
    "contact_angle": "rad",
    "on": "text",
    "volume": "m3",
    "height": "m",
    "fill": "text",
    "liquid": "text",
    "surface_tension": "N/m",
    "density": "kg/m3",
    "model": "text",
    "gravity": "m/s2",
    "tilt": "rad",
    "tilt_direction": "rad",
    "surface": "text",
    "surface_depth": "m",
    "no_penetration": "flag",
    "scale": "number",
    "object_size": "m",
    "up": "text",
    "triangles": "number",
    "edge": "m",
    "grading": "number",
    "open": "flag",
    "compress": "text",
    "solver": "text",
    "threads": "number",
}


def animate(
    frames: Iterable[MaskLike],
    *,
    volume_mode: Literal["total", "track", "fill"] | None = None,
    fps: float | None = None,
    width: str | float | None = None,
    pixel_size: str | float | None = None,
    threshold: float | None = None,
    invert: bool = False,
    smooth: str | float | None = None,
    fill_holes: str | float | None = None,
    keep: str | int | None = None,
    speck_size: float | None = None,
    contact_angle: str | float | None = None,
    on: Literal["glass", "ptfe", "wax", "lotus"] | None = None,
    volume: str | float | None = None,
    height: str | float | None = None,
    fill: Literal["each", "total"] | None = None,
    liquid: Literal["water", "ethanol", "glycerol", "mercury", "honey"] | None = None,
    surface_tension: str | float | None = None,
    density: str | float | None = None,
    model: Literal["auto", "linear", "exact"] | None = None,
    gravity: str | float | None = None,
    tilt: str | float | None = None,
    tilt_direction: str | float | None = None,
    surface: str | None = None,
    surface_depth: str | float | None = None,
    no_penetration: bool = False,
    scale: float | None = None,
    object_size: str | float | None = None,
    up: Literal["y", "z"] | None = None,
    triangles: str | int | None = None,
    edge: str | float | None = None,
    grading: Literal["auto", 1, 2, 4, 8, 16, 32, 64] | None = None,
    open: bool = False,
    compress: Literal["none", "quantize", "meshopt"] | None = None,
    solver: Literal["auto", "llt", "multigrid"] | None = None,
    threads: str | int | None = None,
) -> Animation:
    """Makes droplets whose footprints move.

    frames: masks of one size, as of make_droplet(), one after another. A mask without liquid is allowed. One on which
    no droplet
    is stable shows the droplets of the mask before; a warning and `held` in the report say so.

    >>> import numpy
    >>> y, x = numpy.mgrid[-1:1:150j, -1:1:150j]
    >>> frames = [x**2 + y**2 < radius**2 for radius in (0.6, 0.62, 0.64)]
    >>> film = animate(frames, width="10mm", volume="20uL", triangles=1000)
    >>> len(film), film.report.transitions.vertices_kept
    (3, 2)

    Sequence:
      volume_mode: total, track, fill: Volume that stays the same: total, of all droplets together at one pressure;
        track, of every droplet, through merging and splitting; fill, none, every frame has the contact_angle, volume
        or height (default: total)
      fps: Frames per second (default: 24, or the video's)

    Footprint:
      width [m]: Width of the picture; an SVG may state its own (default: 20mm)
      pixel_size [m]: Size of one pixel, instead of width
      threshold: Coverage at which liquid begins, between 0 and 1 (default: 0.5)
      invert: Exchange liquid and dry
      smooth [m]: Remove spots, and bends of the rim, that are narrower than this
      fill_holes [m²]: Fill holes smaller than this, such as glints: 1mm2
      keep: Keep only the N largest droplets
      speck_size: Drop spots and holes smaller than F square pixels (default: 3)

    Liquid:
      contact_angle [rad]: Amount of liquid, by the mean contact angle along the rim, up to 179deg; natural: that of
        the liquid on what it lies on. By default no droplet is higher than a puddle of 40deg; by default and with
        natural, the largest angle that exists is taken if that one does not (default: 40deg)
      on: glass, ptfe, wax, lotus: What the liquid lies on, for contact_angle natural (default: glass)
      volume [m³]: Amount of liquid, by its volume
      height [m]: Amount of liquid, by its largest height; if two droplets have it, the one with less liquid
      fill: each, total: each: every droplet gets this amount; total: all droplets share it at one pressure (default:
        total with volume_mode total, else each)
      liquid: water, ethanol, glycerol, mercury, honey: Liquid, at 20 C (default: water)
      surface_tension [N/m]: Surface tension, instead of the liquid's own
      density [kg/m³]: Density, instead of the liquid's own
      model: auto, linear, exact: Model of the surface's area: linear is within 1 % up to 5 to 8deg, exact for all
        slopes, also where liquid hangs over its rim; auto takes linear where it is within 0.3 % (default: auto)

    Gravity and ground:
      gravity [m/s²]: Gravity into the ground; negative under a ceiling (default: 9.81m/s2)
      tilt [rad]: Tilt of the ground: 90deg is a wall, 180deg a ceiling (default: 0deg)
      tilt_direction [rad]: Direction of downhill, counter-clockwise from the picture's right; -90deg is its lower
        edge (default: -90deg)
      surface: Curved ground: a height map's file, white is high; sphere:R=40mm; or cylinder:R=33mm,axis=y, with axis
        x, y or an angle; R < 0 is a bowl or a gutter (default: flat)
      surface_depth [m]: Height of white above black in the height map; samples that are floating-point numbers are
        metres without it
      no_penetration: Keep the liquid above the ground; where it would sink in, the ground stays dry
      scale: With onto: Factor on the lengths of the file (default: 1)
      object_size [m]: With onto: Longest side of the object, 0.1mm to 1000m; scales it
      up: y, z: With onto: Axis that points up in an .obj, .ply or .stl (default: y, of .ply z)

    Surface:
      triangles: Number of triangles of the liquid's surface, within 10 %: 5000, 5k, 1M (default: 40k)
      edge [m]: Edge length of the triangles, instead of triangles
      grading: auto, 1, 2, 4, 8, 16, 32, 64: Largest edge length far from the rim, as a multiple of the length at the
        rim; auto: 1, or 64 in puddles where gravity flattens all but the rim (default: auto)
      open: Leave out the base
      compress: none, quantize, meshopt: Compress a .glb: quantize, integers of 16 bits (KHR_mesh_quantization), three
        quarters of the size; meshopt, those encoded (EXT_meshopt_compression), a third of the size (default: none)

    Run:
      solver: auto, llt, multigrid: Solver of the linear system: llt is Eigen's factorisation, multigrid iterates;
        auto takes llt for linear models of up to 25,000 unknowns and for small or irregular meshes (default: auto)
      threads: Maximum number of threads (default: all cores)

    Raises InvalidArgument: a value is outside of its range; InvalidInput: no frame has liquid, or sizes differ;
    NoSuchDroplet: no such droplet exists, or the solver failed.
    """
    return _core.animate(masks_of(frames), arguments_of(_ANIMATE, locals()))


_COMPARE = {
    "tolerance": "m",
    "volume_tolerance": "share",
    "normal_tolerance": "rad",
    "threads": "number",
}


def compare(
    a: Surface | Path,
    b: Surface | Path,
    *,
    tolerance: str | float | None = None,
    volume_tolerance: str | float | None = None,
    normal_tolerance: str | float | None = None,
    threads: str | int | None = None,
) -> Comparison:
    """Measures the difference of two surfaces.

    The bounds of the largest distance hold for all points, not only for vertices.

    a, b: surfaces, or files: .glb, .gltf, .obj, .ply or .stl.

    With a tolerance, Comparison.exceeded lists the differences over it; topologies must then be the same, too.

    >>> import numpy
    >>> y, x = numpy.mgrid[-1:1:150j, -1:1:150j]
    >>> coarse, fine = (make_droplet(x**2 + y**2 < 0.8, triangles=n) for n in (1000, 4000))
    >>> compare(coarse, fine, tolerance="0.2mm").exceeded
    ()

    Allowed:
      tolerance [m]: Largest distance of a point of one surface from the other
      volume_tolerance: Largest difference of the volumes, such as 0.1% of A's
      normal_tolerance [rad]: Largest rms angle between normals

    Run:
      threads: Maximum number of threads (default: all cores)

    Raises InvalidArgument: a value is outside of its range; InvalidInput: a file cannot be read.
    """
    return _reports.Comparison.from_json(_core.compare(a, b, arguments_of(_COMPARE, locals())))


_WIND_TUNNEL = {
    "preset": "text",
    "volume": "list m3",
    "wind_speed": "list m/s",
    "slope": "list rad",
    "hysteresis": "list ",
    "sliding_angle": "rad",
    "sliding_volume": "m3",
    "contact_angle": "rad",
    "viscosity_factor": "Pa.s",
    "kinetic_fraction": "number",
    "drag_coefficient": "number",
    "boundary_layer": "m",
    "profile_exponent": "number",
    "air_density": "kg/m3",
    "liquid": "text",
    "surface_tension": "N/m",
    "density": "kg/m3",
    "gravity": "m/s2",
    "measured": "band m/s",
    "threads": "number",
}


def wind_tunnel(
    *,
    preset: Literal["hashimoto", "thesis", "thesis,hashimoto"] | None = None,
    volume: str | float | Sequence[float] | None = None,
    wind_speed: str | float | Sequence[float] | None = None,
    slope: str | float | Sequence[float] | None = None,
    hysteresis: str | float | Sequence[float] | None = None,
    sliding_angle: str | float | None = None,
    sliding_volume: str | float | None = None,
    contact_angle: str | float | None = None,
    viscosity_factor: str | float | None = None,
    kinetic_fraction: float | None = None,
    drag_coefficient: float | None = None,
    boundary_layer: str | float | None = None,
    profile_exponent: float | None = None,
    air_density: str | float | None = None,
    liquid: Literal["water", "ethanol", "glycerol", "mercury", "honey"] | None = None,
    surface_tension: str | float | None = None,
    density: str | float | None = None,
    gravity: str | float | None = None,
    measured: str | tuple[float, float] | None = None,
    threads: str | int | None = None,
) -> WindTunnelReport:
    """Computes how droplets on a slope move in the wind: all combinations of volumes, winds, slopes and hystereses.

    >>> report = wind_tunnel(volume=["10uL", "30uL"], wind_speed="0..16m/s:1", slope=[0.6])
    >>> [round(case.upper_threshold_m_per_s, 1) for case in report.runs[0].cases]
    [11.7, 10.5]

    Sweep:
      preset: hashimoto, thesis, thesis,hashimoto: Named set of default values: hashimoto, a measured plane; thesis,
        fitted to it; or both side by side (default: hashimoto)
      volume [m³]: Volumes of the droplets (default: by preset)
      wind_speed [m/s]: Wind speeds, up the slope and along it (default: 0..16m/s:0.25)
      slope [rad]: Slopes of the ground, from horizontal (default: 35deg)
      hysteresis: Contact angle hysteresis: cosine of the receding minus cosine of the advancing angle (default: by
        preset)
      sliding_angle [rad]: Hysteresis, by the slope at which a droplet begins to run
      sliding_volume [m³]: Volume of the droplet that runs at sliding_angle; every: all of them do (default: 30uL)

    Coating:
      contact_angle [rad]: Contact angle of droplets at rest, from 1deg to 179deg (default: by preset)
      viscosity_factor [Pa·s]: Viscous drag per radius and speed: artistic is 0.5Pa.s, wedge is that of water by wedge
        theory (default: by preset)
      kinetic_fraction: Friction of a moving droplet, as a fraction of that at rest (default: 1)

    Air:
      drag_coefficient: Drag coefficient of droplets in the wind (default: 1)
      boundary_layer [m]: Thickness of the layer in which the wind is slower (default: by preset)
      profile_exponent: Exponent of the wind's growth with height in that layer; 0.143 for a turbulent one (default:
        0.5)
      air_density [kg/m³]: Density of the air (default: 1.204kg/m3)

    Liquid:
      liquid: water, ethanol, glycerol, mercury, honey: Liquid, at 20 C (default: water)
      surface_tension [N/m]: Surface tension, instead of the liquid's own
      density [kg/m³]: Density, instead of the liquid's own
      gravity [m/s²]: Gravity, downwards (default: 9.81m/s2)

    Charts and series:
      measured [m/s]: Measured range of winds in which droplets stay, drawn beside the results (default: 7..11m/s for
        unchanged presets)

    Run:
      threads: Maximum number of threads (default: all cores)

    Raises InvalidArgument: a value is outside of its range.
    """
    return _reports.WindTunnelReport.from_json(_core.wind_tunnel(arguments_of(_WIND_TUNNEL, locals())))


_WINDSHIELD = {
    "preset": "text",
    "rain": "rainfall",
    "mist": "rainfall",
    "speed": "m/s",
    "drive_cycle": "path",
    "wind_model": "text",
    "noise": "m/s2",
    "wiper_period": "s",
    "splashes": "flag",
    "seed": "number",
    "glass_width": "m",
    "glass_height": "m",
    "glass_radius": "m",
    "slope": "rad",
    "surface": "path",
    "hysteresis": "number",
    "still_diameter": "m",
    "film": "m",
    "runoff": "s",
    "shape": "text",
    "contact_angle": "rad",
    "viscosity_factor": "Pa.s",
    "kinetic_fraction": "number",
    "drag_coefficient": "number",
    "boundary_layer": "m",
    "profile_exponent": "number",
    "air_density": "kg/m3",
    "liquid": "text",
    "surface_tension": "N/m",
    "density": "kg/m3",
    "gravity": "m/s2",
    "time": "s",
    "warm_up": "s",
    "fps": "number",
    "background": "path",
    "fit": "flag",
    "environment": "path",
    "background_blur": "rad",
    "frame_size": "size",
    "field_of_view": "rad",
    "eye_distance": "m",
    "eye": "list m",
    "look_at": "list m",
    "samples": "number",
    "exposure": "number",
    "highlight_boost": "number",
    "shutter": "number",
    "layer": "flag",
    "codec": "text",
    "quality": "number",
    "maps": "path",
    "map_width": "number",
    "map_thickness": "m",
    "droplets": "path",
    "moving_only": "flag",
    "animation": "path",
    "animation_method": "text",
    "compress": "text",
    "resume": "flag",
    "no_clobber": "flag",
    "threads": "number",
}


def windshield(
    output: Path,
    *,
    preset: Literal["figure-3.10", "figure-3.11", "figure-3.12"] | None = None,
    rain: str | float | None = None,
    mist: str | float | None = None,
    speed: str | float | None = None,
    drive_cycle: Path | None = None,
    wind_model: Literal["turned", "projected"] | None = None,
    noise: str | float | None = None,
    wiper_period: str | float | None = None,
    splashes: bool = False,
    seed: str | int | None = None,
    glass_width: str | float | None = None,
    glass_height: str | float | None = None,
    glass_radius: str | float | None = None,
    slope: str | float | None = None,
    surface: Path | None = None,
    hysteresis: float | None = None,
    still_diameter: str | float | None = None,
    film: str | float | None = None,
    runoff: str | float | None = None,
    shape: Literal["capillary", "capsule"] | None = None,
    contact_angle: str | float | None = None,
    viscosity_factor: str | float | None = None,
    kinetic_fraction: float | None = None,
    drag_coefficient: float | None = None,
    boundary_layer: str | float | None = None,
    profile_exponent: float | None = None,
    air_density: str | float | None = None,
    liquid: Literal["water", "ethanol", "glycerol", "mercury", "honey"] | None = None,
    surface_tension: str | float | None = None,
    density: str | float | None = None,
    gravity: str | float | None = None,
    time: str | float | None = None,
    warm_up: str | float | None = None,
    fps: float | None = None,
    background: Path | None = None,
    fit: bool = False,
    environment: Path | None = None,
    background_blur: str | float | None = None,
    frame_size: str | tuple[int, int] | None = None,
    field_of_view: str | float | None = None,
    eye_distance: str | float | None = None,
    eye: str | Sequence[float] | None = None,
    look_at: str | Sequence[float] | None = None,
    samples: str | int | None = None,
    exposure: float | None = None,
    highlight_boost: float | None = None,
    shutter: str | float | None = None,
    layer: bool = False,
    codec: str | None = None,
    quality: float | None = None,
    maps: Path | None = None,
    map_width: str | int | None = None,
    map_thickness: str | float | None = None,
    droplets: Path | None = None,
    moving_only: bool = False,
    animation: Path | None = None,
    animation_method: Literal["nodes", "texture"] | None = None,
    compress: Literal["none", "quantize", "meshopt"] | None = None,
    resume: bool = False,
    no_clobber: bool = False,
    threads: str | int | None = None,
) -> WindshieldReport:
    """Simulates rain on the windshield of a moving car, and writes what the driver sees.

    output: frames such as out/%05d.png; a video, .mp4, .mkv, .mov or .webm, which needs ffmpeg; or a .png of the last
    frame.

    >>> report = windshield("still.png", time="0.1s", warm_up="1s", frame_size=(160, 90), samples=1)
    >>> report.output.frames, report.warnings
    (3, ())

    Car and rain:
      preset: figure-3.10, figure-3.11, figure-3.12: Named set of values, of the thesis, with its capsules for
        droplets; without it those of figure-3.12, with capillary droplets
      rain [m/s]: Rainfall, with the drop sizes of Marshall and Palmer (default: 5mm/h)
      mist [m/s]: Mist with live: growth of its thickness, such as 0.7mm/h, which makes it dense in 51s (default:
        0mm/h)
      speed [m/s]: Speed of the car in still air (default: by preset)
      drive_cycle: Speed over time: CSV with the columns time_s and speed_m_per_s or speed_km_per_h
      wind_model: turned, projected: Wind along the glass: turned keeps all of its speed, projected only the part
        along the glass (default: turned)
      noise [m/s²]: Root mean square of the car's vibration (default: 0.5m/s2)
      wiper_period [s]: At least 1.2s; without it there are no wipers
      splashes: Show rings where large raindrops hit, for some milliseconds
      seed: Random seed (default: 1)

    Glass:
      glass_width [m]: Width of the glass, along its bend (default: 1.4m)
      glass_height [m]: Height of the glass, along its slope (default: 0.8m)
      glass_radius [m]: Radius of the glass's bend across the car (default: 5m)
      slope [rad]: Slope of the glass, from horizontal (default: 45deg)
      surface: Mesh instead of that glass: .glb or .gltf, its front +Z, normals outward, with texture coordinates that
        roll it out flat

    Droplets:
      hysteresis: Contact angle hysteresis: cosine of the receding minus cosine of the advancing angle (default: by
        preset)
      still_diameter [m]: Raindrops smaller than this never move (default: 1mm)
      film [m]: Thickness of the film that running droplets leave behind (default: 0mm)
      runoff [s]: Time after which the film of heavy rain, which runs off in sheets and rivulets, breaks up without
        more rain; 0s: there is none, as on water-repellent glass (default: 1s, with preset 0s)
      shape: capillary, capsule: Shape of running droplets: capillary has least energy and a tail; capsule is the
        thesis' (default: capillary, with preset capsule)

    Coating:
      contact_angle [rad]: Contact angle of droplets at rest, from 1deg to 179deg (default: by preset)
      viscosity_factor [Pa·s]: Viscous drag per radius and speed: artistic is 0.5Pa.s, wedge is that of water by wedge
        theory (default: by preset)
      kinetic_fraction: Friction of a moving droplet, as a fraction of that at rest (default: 1)

    Air:
      drag_coefficient: Drag coefficient of droplets in the wind (default: 1)
      boundary_layer [m]: Thickness of the layer in which the wind is slower (default: by preset)
      profile_exponent: Exponent of the wind's growth with height in that layer; 0.143 for a turbulent one (default:
        0.5)
      air_density [kg/m³]: Density of the air (default: 1.204kg/m3)

    Liquid:
      liquid: water, ethanol, glycerol, mercury, honey: Liquid, at 20 C (default: water)
      surface_tension [N/m]: Surface tension, instead of the liquid's own
      density [kg/m³]: Density, instead of the liquid's own
      gravity [m/s²]: Gravity, downwards (default: 9.81m/s2)

    Time:
      time [s]: Time to show; with drive_cycle the cycle's own (default: 10s)
      warm_up [s]: Time of rain before the first frame (default: 10s)
      fps: Frames per second (default: 30)

    View:
      background: Picture or video behind the glass; a video needs ffmpeg, plays at its own speed and repeats
        (default: an evening road)
      fit: Scale the background to cover the frame and crop the rest
      environment: Panorama around the car, its middle straight ahead: .hdr, .exr, .png or .jpg; without background it
        is the whole background
      background_blur [rad]: Diameter of the disc that a distant point of light becomes, up to 20deg; droplets stay
        sharp (default: 0deg)
      frame_size [px]: Width and height of the frame in pixels (default: the background's, or 1280x720)
      field_of_view [rad]: Angle of view across the frame's width (default: 45deg)
      eye_distance [m]: Distance of the eye from the glass (default: 0.5m)
      eye [m]: Position of the eye relative to the middle of the glass: right, ahead and up, such as 0.3m,-0.6m,0.1m;
        it is behind the glass
      look_at [m]: Point in the middle of the frame, relative to the middle of the glass: right, ahead and up
        (default: straight ahead)
      samples: Rays per pixel in each direction, 1 to 4 (default: 2)
      exposure: Exposure of the frame: 1 is twice the light, -1 half (default: 0)
      highlight_boost: How much brighter lamps are than the background shows them: up to 1 + this, 0 to 4 (default: 3,
        by daylight less)
      shutter [1 is the whole time]: Motion blur: part of a frame's time that the shutter is open, such as 180deg or
        0.5 (default: 0)
      layer: Write only the droplets, with alpha: pictures, or a .webm, .mkv or .mov
      codec: Encoder of ffmpeg (default: libx264, libvpx-vp9 for .webm)
      quality: Quality of the video, 1 to 100 (default: 65)

    Beside the frames:
      maps: Textures of the whole glass, such as maps/%05d.png or .exr: three files per frame, -normal, -thickness and
        -velocity
      map_width: Width of the textures in pixels (default: 2048)
      map_thickness [m]: Thickness of the water that is white in a PNG (default: 5mm)
      droplets: Write a table of all running droplets in every frame: .csv or .json
      moving_only: Leave droplets at rest out of the table
      animation: Write the droplets as an animated .glb, .gltf, .usda or .usdz
      animation_method: nodes, texture: Form of the animation: nodes plays in every viewer; texture needs a shader and
        takes one draw call (default: nodes)
      compress: none, quantize, meshopt: Compress a .glb: quantize, integers of 16 bits (KHR_mesh_quantization), three
        quarters of the size; meshopt, those encoded (EXT_meshopt_compression), a third of the size (default: none)

    Run:
      resume: Continue an interrupted run of the same options
      no_clobber: Do not replace existing files
      threads: Maximum number of threads (default: all cores)

    Raises InvalidArgument: a value is outside of its range; InvalidInput: a file cannot be read; OutputFailed: a file
    cannot be written.
    """
    return _reports.WindshieldReport.from_json(_core.windshield(output, arguments_of(_WINDSHIELD, locals())))


_FLOW = {
    "preset": "text",
    "scale": "number",
    "object_size": "m",
    "up": "text",
    "floor": "text",
    "spin": "rad/s",
    "spin_axis": "vector",
    "motion": "path",
    "object_animation": "text",
    "no_animation": "flag",
    "drops": "number",
    "volume": "m3",
    "radius": "m",
    "volume_spread": "number",
    "from_": "vector",
    "mask": "path",
    "vertex_weights": "flag",
    "start": "path",
    "emitter": "texts",
    "rain": "rainfall",
    "condensation": "rainfall",
    "dew_spacing": "m",
    "retention": "text",
    "hysteresis": "number",
    "pinning": "number",
    "pinning_length": "m",
    "friction": "number",
    "roughness": "m",
    "roughness_map": "path",
    "friction_map": "path",
    "ground": "texts",
    "adhesion": "number",
    "gravity_direction": "vector",
    "wind_velocity": "vector",
    "no_merge": "flag",
    "no_wetting": "flag",
    "film": "m",
    "bead_spacing": "m",
    "drying": "s",
    "contact_angle": "rad",
    "viscosity_factor": "Pa.s",
    "kinetic_fraction": "number",
    "drag_coefficient": "number",
    "boundary_layer": "m",
    "profile_exponent": "number",
    "air_density": "kg/m3",
    "liquid": "text",
    "surface_tension": "N/m",
    "density": "kg/m3",
    "gravity": "m/s2",
    "time": "s",
    "fps": "number",
    "seed": "number",
    "shape": "text",
    "deformation": "number",
    "material": "text",
    "compress": "text",
    "streaks": "path",
    "maps": "path",
    "map_width": "number",
    "map_thickness": "m",
    "map_age": "s",
    "droplets": "path",
    "html": "path",
    "preview": "path",
    "view": "text",
    "camera": "list rad",
    "look_at": "vector",
    "preview_size": "size",
    "environment": "path",
    "turntable": "number",
    "codec": "text",
    "quality": "number",
    "resume": "flag",
    "no_clobber": "flag",
    "threads": "number",
}


def flow(
    object: Path | None,
    output: Path,
    *,
    preset: Literal[
        "masses", "viscosities", "adhesions", "roughnesses", "tear", "forces", "bottle", "leaf", "car", "window",
    ] | None = None,
    scale: float | None = None,
    object_size: str | float | None = None,
    up: Literal["y", "z"] | None = None,
    floor: Literal["plate", "dish"] | None = None,
    spin: str | float | None = None,
    spin_axis: str | Sequence[float] | None = None,
    motion: Path | None = None,
    object_animation: str | None = None,
    no_animation: bool = False,
    drops: str | int | None = None,
    volume: str | float | None = None,
    radius: str | float | None = None,
    volume_spread: float | None = None,
    from_: str | Sequence[float] | None = None,
    mask: Path | None = None,
    vertex_weights: bool = False,
    start: Path | None = None,
    emitter: str | Sequence[str] | None = None,
    rain: str | float | None = None,
    condensation: str | float | None = None,
    dew_spacing: str | float | None = None,
    retention: Literal["capillary", "paper"] | None = None,
    hysteresis: float | None = None,
    pinning: float | None = None,
    pinning_length: str | float | None = None,
    friction: float | None = None,
    roughness: str | float | None = None,
    roughness_map: Path | None = None,
    friction_map: Path | None = None,
    ground: str | Sequence[str] | None = None,
    adhesion: float | None = None,
    gravity_direction: str | Sequence[float] | None = None,
    wind_velocity: str | Sequence[float] | None = None,
    no_merge: bool = False,
    no_wetting: bool = False,
    film: str | float | None = None,
    bead_spacing: str | float | None = None,
    drying: str | float | None = None,
    contact_angle: str | float | None = None,
    viscosity_factor: str | float | None = None,
    kinetic_fraction: float | None = None,
    drag_coefficient: float | None = None,
    boundary_layer: str | float | None = None,
    profile_exponent: float | None = None,
    air_density: str | float | None = None,
    liquid: Literal["water", "ethanol", "glycerol", "mercury", "honey"] | None = None,
    surface_tension: str | float | None = None,
    density: str | float | None = None,
    gravity: str | float | None = None,
    time: str | float | None = None,
    fps: float | None = None,
    seed: str | int | None = None,
    shape: Literal["capillary", "springs", "capsule"] | None = None,
    deformation: float | None = None,
    material: Literal[
        "water", "ink", "mercury", "honey", "plain", "gel", "enamel", "glass", "resin", "oil", "milk", "lacquer",
        "blood", "gold", "frosted", "ice",
    ] | None = None,
    compress: Literal["none", "quantize", "meshopt"] | None = None,
    streaks: Path | None = None,
    maps: Path | None = None,
    map_width: str | int | None = None,
    map_thickness: str | float | None = None,
    map_age: str | float | None = None,
    droplets: Path | None = None,
    html: Path | None = None,
    preview: Path | None = None,
    view: Literal["three-quarter", "top", "side"] | None = None,
    camera: str | Sequence[float] | None = None,
    look_at: str | Sequence[float] | None = None,
    preview_size: str | tuple[int, int] | None = None,
    environment: Path | None = None,
    turntable: str | int | None = None,
    codec: str | None = None,
    quality: float | None = None,
    resume: bool = False,
    no_clobber: bool = False,
    threads: str | int | None = None,
) -> FlowReport:
    """Lets droplets run over a mesh, and writes them.

    object: mesh: .glb, .gltf, .obj, .ply or .stl; or None for the object of the preset.
    output: animated .glb; meshes of the droplets in every frame, such as out/%04d.obj; pictures, out/%04d.png; a .png
    of the
    last frame; or a video, .mp4, .mkv, .mov or .webm, which needs ffmpeg.

    >>> report = flow("data/can.glb", "wet.glb", drops=20, time="0.1s")
    >>> report.counts.released
    20

    Object:
      preset: masses, viscosities, adhesions, roughnesses, tear, forces, bottle, leaf, car, window: Named scene with
        its own object and droplets, instead of OBJECT; other options change it
      scale: Factor on the lengths of the file (default: 1)
      object_size [m]: Longest side of the object, 0.1mm to 1000m; scales it
      up: y, z: Axis that points up in an .obj, .ply or .stl (default: y, of .ply z)
      floor: plate, dish: What catches the water below an object that rests: a plate or a dish, with the material
        floor
      spin [rad/s]: Turn the object, such as 30deg/s
      spin_axis [m or m/s]: Axis through the origin that spin turns it about (default: 0,1,0)
      motion: Move the object: CSV with the columns time_s, x_m, y_m, z_m and a quaternion rotation_x, rotation_y,
        rotation_z, rotation_w
      object_animation: Animation of the object's file that moves or deforms it (default: the first)
      no_animation: Ignore the animation of the object's file

    Droplets:
      drops: Scatter droplets over the object at the start (default: 0)
      volume [m³]: Volume of scattered and emitted droplets, the median (default: 20uL)
      radius [m]: Contact radius instead of volume
      volume_spread: Spread of the volumes: standard deviation of their logarithm, 0 to 3 (default: 0)
      from [m or m/s]: Direction that rain comes from; drops then wet only what it can reach (default: for rain 0,1,0)
      mask: Mask over the object's texture coordinates: drops start on it
      vertex_weights: drops start where the vertices have weights: _WEIGHT or the red of COLOR_0 of glTF, weight or
        red of PLY
      start: Droplets at the start: CSV with the columns x_m, y_m, z_m, volume_m3 and, if they move,
        velocity_x_m_per_s, velocity_y_m_per_s, velocity_z_m_per_s
      emitter: Release droplets at a place, such as 0,0.1,0,50uL/s
      rain [m/s]: Rain, with the drop sizes of Marshall and Palmer (default: 0mm/h)
      condensation [m/s]: Dew: growth of the water's mean thickness, such as 5mm/h (default: 0mm/h)
      dew_spacing [m]: Mean distance of new droplets of dew on a dry surface (default: 3mm)

    Motion:
      retention: capillary, paper: What holds droplets: capillary is contact angle hysteresis, paper is roughness
        alone (default: capillary)
      hysteresis: Contact angle hysteresis: cosine of the receding minus cosine of the advancing angle (default: 0.2)
      pinning: How much hysteresis varies over the surface, so that droplets stick, slip and wander: standard
        deviation of its logarithm, 0 to 1.5 (default: 0.5)
      pinning_length [m]: Length over which it varies (default: 3mm)
      friction: Viscous friction in kg/s instead of viscosity_factor
      roughness [m]: Height of the surface's bumps; those of a droplet's height hold it (default: 0mm)
      roughness_map: Picture over the object's texture coordinates: black is smooth, white has bumps of roughness
      friction_map: Picture over the object's texture coordinates: black is without viscous friction, white has all of
        it
      ground: Properties of a material of the object: roughness, contact-angle, and factors on friction and
        hysteresis, such as Glass:contact-angle=30deg,hysteresis=0.5
      adhesion: Pressure in Pa that holds droplets to the surface (default: by surface tension)
      gravity_direction [m or m/s]: Direction of gravity (default: 0,-1,0)
      wind_velocity [m or m/s]: Wind, which pushes droplets along the surface (default: 0,0,0)
      no_merge: Droplets that touch stay apart
      no_wetting: Streaks do not smooth the surface for the next droplets
      film [m]: Thickness of the film that droplets leave behind; it becomes beads (default: 0mm)
      bead_spacing [m]: Distance of these beads (default: 4mm)
      drying [s]: Time after which streaks and beads are dry (default: never)

    Coating:
      contact_angle [rad]: Contact angle of droplets at rest, from 1deg to 179deg (default: by preset)
      viscosity_factor [Pa·s]: Viscous drag per radius and speed: artistic is 0.5Pa.s, wedge is that of water by wedge
        theory (default: by preset)
      kinetic_fraction: Friction of a moving droplet, as a fraction of that at rest (default: 1)

    Air:
      drag_coefficient: Drag coefficient of droplets in the wind (default: 1)
      boundary_layer [m]: Thickness of the layer in which the wind is slower (default: by preset)
      profile_exponent: Exponent of the wind's growth with height in that layer; 0.143 for a turbulent one (default:
        0.5)
      air_density [kg/m³]: Density of the air (default: 1.204kg/m3)

    Liquid:
      liquid: water, ethanol, glycerol, mercury, honey: Liquid, at 20 C (default: water)
      surface_tension [N/m]: Surface tension, instead of the liquid's own
      density [kg/m³]: Density, instead of the liquid's own
      gravity [m/s²]: Gravity, downwards (default: 9.81m/s2)

    Time:
      time [s]: Time to show (default: 5s, or all meshes or the animation of an object that deforms)
      fps: Frames per second; they do not change the paths (default: 30)
      seed: Random seed (default: 1)

    Output:
      shape: capillary, springs, capsule: Shape of the droplets: capillary has least energy, springs is the paper's,
        capsule a cut capsule (default: capillary)
      deformation: Small-scale deformation of droplets that move slowly: standard deviation of their outline, over its
        distance from the middle, 0 to 0.3; in pictures, textures and meshes of every frame (default: 0)
      material: water, ink, mercury, honey, plain, gel, enamel, glass, resin, oil, milk, lacquer, blood, gold,
        frosted, ice: Look of the droplets (default: by liquid)
      compress: none, quantize, meshopt: Compress a .glb: quantize, integers of 16 bits (KHR_mesh_quantization), three
        quarters of the size; meshopt, those encoded (EXT_meshopt_compression), a third of the size (default: none)
      streaks: Write the streaks at the end as a mesh, .glb, .obj, .ply or .stl, or those of every frame, such as
        wet/%04d.obj; an animation then has them too, as they grow
      maps: Textures of the water in the object's uv, such as maps/%05d.png or .exr: four files per frame, -normal,
        -thickness, -age and -wet, which tells where the age counts
      map_width: Width and height of the textures in pixels (default: 1024)
      map_thickness [m]: Thickness of the water that is white in a PNG (default: 5mm)
      map_age [s]: Greatest age in the textures, white in a PNG (default: 10s)
      droplets: Write a table of all droplets in every frame, .csv or .json, points over time with droplets as
        instances, .usda or .usdz, or a PLY of points for each frame, such as points/%04d.ply
      html: Write one page that plays droplets and streaks in a browser

    Picture:
      preview: Write a rendered picture of the last frame beside meshes, as PNG
      view: three-quarter, top, side: Direction of the preview's view (default: three-quarter)
      camera [rad]: Camera position, instead of view: azimuth, counter-clockwise from the picture's right, elevation,
        and distance, such as -60deg,30deg or -60deg,30deg,40cm (default: all fits into the picture)
      look_at [m or m/s]: Point in the picture's middle, in the frame of the output, +Y up, such as 0cm,4cm,0cm
        (default: all is in the middle)
      preview_size [px]: Width and height of the preview in pixels (default: 1280x960)
      environment: Equirectangular picture that lights the scene instead of lamps; EXR and HDR hold linear light,
        others sRGB
      turntable: Write N previews of a full turn, FILE-001.png and so on, or one video if preview names a .mp4, .mkv,
        .mov or .webm; up to 360. A video's FILE, without preview, gets 120
      codec: Encoder of ffmpeg (default: libx264, libvpx-vp9 for .webm)
      quality: Quality of the video, 1 to 100 (default: 65)

    Run:
      resume: Continue an interrupted run of the same options
      no_clobber: Do not replace existing files
      threads: Maximum number of threads (default: all cores)

    Raises InvalidArgument: a value is outside of its range; InvalidInput: a file cannot be read, or there is no place
    for droplets; OutputFailed: a file cannot be written.
    """
    return _reports.FlowReport.from_json(_core.flow(object, output, arguments_of(_FLOW, locals())))


_DEW = {
    "scale": "number",
    "object_size": "m",
    "up": "text",
    "preset": "text",
    "coverage": "number",
    "smallest": "m",
    "largest": "m",
    "sizes": "text",
    "median": "m",
    "spread": "number",
    "from_": "vector",
    "mask": "path",
    "vertex_weights": "flag",
    "inside": "flag",
    "seed": "number",
    "hysteresis": "number",
    "pinning": "number",
    "pinning_length": "m",
    "gravity_direction": "vector",
    "contact_angle": "rad",
    "viscosity_factor": "Pa.s",
    "kinetic_fraction": "number",
    "liquid": "text",
    "surface_tension": "N/m",
    "density": "kg/m3",
    "gravity": "m/s2",
    "detail": "text",
    "material": "text",
    "instancing": "text",
    "droplets_only": "flag",
    "compress": "text",
    "droplets": "path",
    "no_clobber": "flag",
    "threads": "number",
}


def dew(
    object: Path,
    output: Path,
    *,
    scale: float | None = None,
    object_size: str | float | None = None,
    up: Literal["y", "z"] | None = None,
    preset: Literal["dew", "rain", "bottle", "shower", "mist"] | None = None,
    coverage: float | None = None,
    smallest: str | float | None = None,
    largest: str | float | None = None,
    sizes: Literal["condensation", "lognormal"] | None = None,
    median: str | float | None = None,
    spread: float | None = None,
    from_: str | Sequence[float] | None = None,
    mask: Path | None = None,
    vertex_weights: bool = False,
    inside: bool = False,
    seed: str | int | None = None,
    hysteresis: float | None = None,
    pinning: float | None = None,
    pinning_length: str | float | None = None,
    gravity_direction: str | Sequence[float] | None = None,
    contact_angle: str | float | None = None,
    viscosity_factor: str | float | None = None,
    kinetic_fraction: float | None = None,
    liquid: Literal["water", "ethanol", "glycerol", "mercury", "honey"] | None = None,
    surface_tension: str | float | None = None,
    density: str | float | None = None,
    gravity: str | float | None = None,
    detail: Literal["low", "medium", "high"] | None = None,
    material: Literal[
        "water", "ink", "mercury", "honey", "plain", "gel", "enamel", "glass", "resin", "oil", "milk", "lacquer",
        "blood", "gold", "frosted", "ice",
    ] | None = None,
    instancing: Literal["auto", "none", "nodes", "gpu"] | None = None,
    droplets_only: bool = False,
    compress: Literal["none", "quantize", "meshopt"] | None = None,
    droplets: Path | None = None,
    no_clobber: bool = False,
    threads: str | int | None = None,
) -> DewReport:
    """Covers an object with droplets that rest on it, and writes them.

    object: mesh: .glb, .gltf, .obj, .ply or .stl.
    output: the object and its droplets, .glb, .gltf, .usda or .usdz; or the droplets alone, .obj, .ply or .stl.

    >>> report = dew("data/can.glb", "wet.glb", coverage=0.1, smallest="1mm", largest="2mm")
    >>> report.droplets.count > 10, report.preset
    (True, 'dew')

    Object:
      scale: Factor on the lengths of the file (default: 1)
      object_size [m]: Longest side of the object, 0.1mm to 1000m; scales it
      up: y, z: Axis that points up in an .obj, .ply or .stl (default: y, of .ply z)

    Droplets:
      preset: dew, rain, bottle, shower, mist: Kind of wetness: dew in the morning, fresh rain, a cold bottle, after a
        shower, fine mist; the other options of this group change it (default: dew)
      coverage: Share of the surface below droplets, 0.001 to 0.7 (default: by preset)
      smallest [m]: Radius of the smallest droplets seen from above (default: by preset)
      largest [m]: Radius of the largest droplets seen from above, before some join (default: by preset)
      sizes: condensation, lognormal: Numbers of droplets by radius r: condensation is r to the power of -8/3,
        lognormal has a median and a spread (default: by preset)
      median [m]: Median of the radii, lognormal (default: by preset)
      spread: Standard deviation of their logarithm, lognormal, 0 to 3 (default: by preset)
      from [m or m/s]: Direction that rain comes from; droplets are then only where it meets the object (default: of
        rain 0,1,0)
      mask: Mask over the object's texture coordinates: droplets are where it is covered
      vertex_weights: Droplets are where the vertices have weights: _WEIGHT or the red of COLOR_0 of glTF, weight or
        red of PLY
      inside: Droplets also on inner sides, which see less than a tenth of the outside
      seed: Random seed (default: 1)

    Slopes:
      hysteresis: Contact angle hysteresis: cosine of the receding minus cosine of the advancing angle; it holds
        droplets (default: 0.2)
      pinning: How much hysteresis varies over the surface, so that droplets stick, slip and wander: standard
        deviation of its logarithm, 0 to 1.5 (default: 0.5)
      pinning_length [m]: Length over which it varies (default: 3mm)
      gravity_direction [m or m/s]: Direction of gravity (default: 0,-1,0)

    Coating:
      contact_angle [rad]: Contact angle of droplets at rest, from 1deg to 179deg (default: by preset)
      viscosity_factor [Pa·s]: Viscous drag per radius and speed: artistic is 0.5Pa.s, wedge is that of water by wedge
        theory (default: by preset)
      kinetic_fraction: Friction of a moving droplet, as a fraction of that at rest (default: 1)

    Liquid:
      liquid: water, ethanol, glycerol, mercury, honey: Liquid, at 20 C (default: water)
      surface_tension [N/m]: Surface tension, instead of the liquid's own
      density [kg/m³]: Density, instead of the liquid's own
      gravity [m/s²]: Gravity, downwards (default: 9.81m/s2)

    Output:
      detail: low, medium, high: Triangles of droplets: medium has 64 of small ones to 352 of large ones (default:
        medium)
      material: water, ink, mercury, honey, plain, gel, enamel, glass, resin, oil, milk, lacquer, blood, gold,
        frosted, ice: Look of the droplets (default: by liquid)
      instancing: auto, none, nodes, gpu: auto is one mesh up to 20000 droplets; none one mesh; nodes a node for each
        droplet, with shared meshes; gpu EXT_mesh_gpu_instancing, for glTF (default: auto)
      droplets_only: Leave the object out of a .glb, .gltf, .usda or .usdz
      compress: none, quantize, meshopt: Compress a .glb: quantize, integers of 16 bits (KHR_mesh_quantization), three
        quarters of the size; meshopt, those encoded (EXT_meshopt_compression), a third of the size (default: none)
      droplets: Write a table of all droplets, .csv or .json; flow can start with the .csv

    Run:
      no_clobber: Do not replace existing files
      threads: Maximum number of threads (default: all cores)

    Raises InvalidArgument: a value is outside of its range; InvalidInput: a file cannot be read, or there is no place
    for droplets; OutputFailed: a file cannot be written.
    """
    return _reports.DewReport.from_json(_core.dew(object, output, arguments_of(_DEW, locals())))
