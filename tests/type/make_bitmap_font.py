#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes tests/type/bitmap.ttf, a font of colour bitmaps (CBDT) in two sizes. Needs python3-fonttools.

The large size has 64 x 60 pixels for an em of 50, the small one 16 x 15. Glyphs are a red disc and a blue ring.
"""
import math
import struct
import zlib
from pathlib import Path

from fontTools.fontBuilder import FontBuilder
from fontTools.ttLib import newTable
from fontTools.ttLib.tables.BitmapGlyphMetrics import SmallGlyphMetrics
from fontTools.ttLib.tables.C_B_D_T_ import cbdt_bitmap_format_17
from fontTools.ttLib.tables.E_B_L_C_ import BitmapSizeTable, SbitLineMetrics, Strike, eblc_index_sub_table_1

GLYPHS = {"space": None, "disc": (0, (220, 20, 20)), "ring": (10, (20, 60, 200))}
CHARACTERS = {" ": "space", "D": "disc", "O": "ring"}


def png(width, height, pixel):
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x + 0.5, y + 0.5)) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def picture(glyph, scale):
    """A disc of radius 20 around (32, 38) from the top left, in pixels of the large size, or nothing."""

    def pixel(x, y):
        if glyph is None:
            return 0, 0, 0, 0
        hole, colour = glyph
        away = math.hypot(x - 32 * scale, y - 38 * scale)
        covered = min(max(20 * scale + 0.5 - away, 0), 1) * min(max(away - hole * scale + 0.5, 0), 1)
        return (*colour, round(255 * covered))

    return png(round(64 * scale), round(60 * scale), pixel)


def line(scale):
    metrics = SbitLineMetrics()
    for name in ("caretSlopeNumerator", "caretSlopeDenominator", "caretOffset", "minOriginSB", "minAdvanceSB",
                 "maxBeforeBL", "minAfterBL", "pad1", "pad2"):  # fmt: skip
        setattr(metrics, name, 0)
    metrics.ascender, metrics.descender, metrics.widthMax = round(50 * scale), -round(10 * scale), round(64 * scale)
    return metrics


def strike(names, scale):
    result = Strike()
    size = result.bitmapSizeTable = BitmapSizeTable()
    size.hori = size.vert = line(scale)
    size.ppemX = size.ppemY = round(50 * scale)
    size.bitDepth, size.flags, size.colorRef = 32, 1, 0
    size.startGlyphIndex, size.endGlyphIndex = 1, len(names)
    table = eblc_index_sub_table_1(None, None)
    table.names, table.indexFormat, table.imageFormat = names, 1, 17
    table.firstGlyphIndex, table.lastGlyphIndex = 1, len(names)
    result.indexSubTables = [table]
    return result


def bitmap(glyph, scale):
    data = cbdt_bitmap_format_17(None, None)
    data.metrics = SmallGlyphMetrics()
    data.metrics.height, data.metrics.width = round(60 * scale), round(64 * scale)
    data.metrics.BearingX, data.metrics.BearingY, data.metrics.Advance = 0, round(50 * scale), round(64 * scale)
    data.imageData = picture(glyph, scale)
    return data


def main():
    names = list(GLYPHS)
    font = FontBuilder(1000, isTTF=True)
    font.setupGlyphOrder([".notdef", *names])
    font.setupCharacterMap({ord(character): name for character, name in CHARACTERS.items()})
    font.setupHorizontalMetrics({name: (1280, 0) for name in [".notdef", *names]})
    font.setupHorizontalHeader(ascent=1000, descent=-200)
    font.setupNameTable({"familyName": "Droplet Bitmaps", "styleName": "Regular"})
    font.setupOS2()
    font.setupPost()
    font.setupHead(unitsPerEm=1000, created=0, modified=0)
    font.setupMaxp()
    scales = (0.25, 1.0)
    places = font.font["CBLC"] = newTable("CBLC")
    places.version, places.strikes = 3.0, [strike(names, scale) for scale in scales]
    data = font.font["CBDT"] = newTable("CBDT")
    data.version = 3.0
    data.strikeData = [{name: bitmap(GLYPHS[name], scale) for name in names} for scale in scales]
    font.font.recalcTimestamp = False
    font.save(Path(__file__).with_name("bitmap.ttf"))


main()
