# SPDX-License-Identifier: GPL-3.0-or-later
"""Footprints: what the droplet's rim comes from, as a file that the command reads."""

import os
import re
import struct
import zlib
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Vector

from .command import DropletError, Input

OUTLINES = {"FONT", "CURVE"}
_MARGIN = 0.02  # of the drawing's longer side; the border of a page would cut off liquid
_SEGMENTS = 32  # lines for each Bezier segment
_PAGE = 10000  # width of a drawing in the units of its coordinates


@dataclass(frozen=True)
class Footprint:
    file: Input
    page: float = 1.0  # width of the page, as a multiple of the footprint's
    extent: float | None = None  # width of the footprint of a text or a curve in its own units
    frame: Matrix | None = None  # its middle and axes in the world


def from_file(path):
    """Footprint in a picture or an SVG file."""
    if not path:
        raise DropletError("no picture is chosen")
    return Footprint(Input(os.path.abspath(bpy.path.abspath(path))))


def from_image(name):
    """Footprint in one of Blender's images, as it is now, saved or not."""
    image = bpy.data.images.get(name)
    if image is None:
        raise DropletError(f"there is no image {name!r}" if name else "no image is chosen")
    if image.source == "FILE" and not image.is_dirty and image.packed_file is None:
        return from_file(bpy.path.abspath(image.filepath, library=image.library))
    width, height = image.size
    if width * height == 0:
        raise DropletError(f"the image {name!r} has no pixels")
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    return Footprint(Input("image.png", _png(pixels.reshape(height, width, image.channels)[::-1])))


def _png(pixels):
    levels = np.rint(np.clip(pixels, 0, 1) * 255).astype(np.uint8)
    height, width, channels = levels.shape
    rows = np.zeros((height, 1 + width * channels), np.uint8)  # each row begins with its filter: none
    rows[:, 1:] = levels.reshape(height, -1)
    colour = {1: 0, 2: 4, 3: 2, 4: 6}[channels]

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return b"".join((b"\x89PNG\r\n\x1a\n", chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0)),
                     chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)), chunk(b"IEND", b"")))


def from_object(item):
    """Footprint of a text or a curve: what it fills in its own plane."""
    corners, triangles = _filled(item)
    loops = _loops(corners, triangles)
    if not loops:
        raise DropletError(f"{item.name!r} encloses no area; curves must be closed")
    rim = corners[np.concatenate(loops)]
    low, high = rim.min(axis=0), rim.max(axis=0)
    width, height = high - low
    margin = _MARGIN * max(width, height)
    scale = _PAGE / (width + 2 * margin)
    points = np.rint((corners - (low[0] - margin, high[1] + margin)) * (scale, -scale)).astype(int).tolist()
    path = "".join("M" + " ".join("{},{}".format(*points[corner]) for corner in loop) + "Z" for loop in loops)
    drawing = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_PAGE} {(height + 2 * margin) * scale:.0f}">'
               f'<path d="{path}"/></svg>')
    middle = Matrix.Translation(Vector((*(low + high) / 2, 0.0)))
    return Footprint(
        file=Input("outline.svg", drawing.encode()),
        page=float(_PAGE / scale / width),
        extent=float(width),
        frame=item.matrix_world @ middle,
    )


def _filled(item):
    """Corners (n, 2) and triangles (m, 3) of what the text or curve fills, without depth."""
    data = item.data.copy()
    flat = bpy.data.objects.new("droplet outline", data)
    try:
        data.extrude = data.bevel_depth = 0.0
        data.bevel_object = None
        data.resolution_u = max(data.resolution_u, _SEGMENTS)
        if item.type == "CURVE":
            data.dimensions = "2D"
        else:
            data.use_fast_edit = False
        data.fill_mode = "BOTH"
        mesh = flat.to_mesh()
        mesh.calc_loop_triangles()
        corners = np.empty(3 * len(mesh.vertices), np.float32)
        mesh.vertices.foreach_get("co", corners)
        triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.loop_triangles.foreach_get("vertices", triangles)
        flat.to_mesh_clear()
    finally:
        bpy.data.objects.remove(flat)
        bpy.data.curves.remove(data)
    return corners.reshape(-1, 3)[:, :2].astype(float), triangles.reshape(-1, 3).astype(np.int64)


def _loops(corners, triangles):
    """Closed loops of corners around the triangles, counter-clockwise; clockwise around holes."""
    a, b, c = (corners[triangles[:, i]] for i in range(3))
    turned = (b - a)[:, 0] * (c - a)[:, 1] < (b - a)[:, 1] * (c - a)[:, 0]
    triangles = np.where(turned[:, None], triangles[:, ::-1], triangles)
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    lower, upper = edges.min(axis=1), edges.max(axis=1)
    keys, which = np.unique(lower * len(corners) + upper, return_inverse=True)
    # An edge inside runs both ways, which cancels out. What is left ends at every corner as often as it begins there.
    net = np.bincount(which.reshape(-1), np.where(edges[:, 0] == lower, 1, -1), len(keys)).astype(int)
    following = {}
    for key, times in zip(keys[net != 0].tolist(), net[net != 0].tolist()):
        begin, end = divmod(key, len(corners))
        if times < 0:
            begin, end = end, begin
        following.setdefault(begin, []).extend([end] * abs(times))
    loops = []
    for first in list(following):
        while following[first]:
            loop = [first]
            while following[loop[-1]]:
                loop.append(following[loop[-1]].pop())
            loops.append(loop[:-1])
    return loops


def numbered(path):
    """Pattern for the numbered pictures that the file is one of; the path itself if its name has no number."""
    path = Path(path)
    match = re.fullmatch(r"(.*?)(\d+)", path.stem)
    if not match or "%" in path.name:
        return str(path)
    digits = match.group(2)
    number = f"%0{len(digits)}d" if digits.startswith("0") else "%d"
    return str(path.with_name(match.group(1) + number + path.suffix))
