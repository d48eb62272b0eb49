#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes tests/type/colour.ttf, a font of squares and discs with colour layers. Needs python3-fonttools.

An em has 1024 units. Palettes: red, blue, gold, half-transparent blue; and the same in green, grey, white, black.
"""
from pathlib import Path

from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen


def outline(*contours):
    pen = TTGlyphPen(None)
    for contour in contours:
        contour(pen)
    return pen.glyph()


def square(x, y, side):
    def draw(pen):
        pen.moveTo((x, y))
        for corner in ((x, y + side), (x + side, y + side), (x + side, y)):
            pen.lineTo(corner)
        pen.closePath()

    return draw


def disc(x, y, radius):
    """A square with corners rounded off as far as they go, by quadratic curves."""

    def draw(pen):
        pen.moveTo((x - radius, y))
        pen.qCurveTo((x - radius, y + radius), (x, y + radius))
        pen.qCurveTo((x + radius, y + radius), (x + radius, y))
        pen.qCurveTo((x + radius, y - radius), (x, y - radius))
        pen.qCurveTo((x - radius, y - radius), (x - radius, y))
        pen.closePath()

    return draw


RED, BLUE, GOLD, GLASS, TEXT = 0, 1, 2, 3, 0xFFFF
GLYPHS = {
    ".notdef": outline(square(100, 0, 500)),
    "space": outline(),
    "plain": outline(disc(500, 300, 300)),
    "square": outline(square(100, 0, 512)),
    "corner": outline(square(484, 256, 256)),
    "disc": outline(disc(356, 256, 200)),
    "almost": outline(square(102, 2, 510)),
    "touching": outline(square(612, 0, 256)),
}
LAYERS = {
    "overlap": [("square", RED), ("corner", BLUE)],
    "curved": [("square", GOLD), ("disc", RED)],
    "hidden": [("disc", BLUE), ("square", RED)],
    "glass": [("square", TEXT), ("corner", GLASS)],
    "hairline": [("square", RED), ("almost", BLUE)],
    "same": [("square", RED), ("touching", RED)],
    "blank": [("space", RED)],
    "gradient": {"Format": 10, "Glyph": "square", "Paint": {"Format": 2, "PaletteIndex": RED, "Alpha": 1.0}},
}
CHARACTERS = {" ": "space", "P": "plain", "O": "overlap", "C": "curved", "H": "hidden", "T": "glass", "L": "hairline",
              "S": "same", "0": "blank", "1": "gradient", "🦊": "curved"}  # fmt: skip
PALETTES = [
    [(1.0, 0.0, 0.0, 1.0), (0.0, 0.4, 0.8, 1.0), (1.0, 0.8, 0.0, 1.0), (0.0, 0.4, 0.8, 128 / 255)],
    [(0.0, 0.6, 0.2, 1.0), (0.4, 0.4, 0.4, 1.0), (1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 128 / 255)],
]


def main():
    # Colour glyphs have the outline of a square, as fonts give it to programs without colours.
    glyphs = GLYPHS | {name: outline(square(100, 0, 512)) for name in LAYERS}
    font = FontBuilder(1024, isTTF=True)
    font.setupGlyphOrder(list(glyphs))
    font.setupCharacterMap({ord(character): name for character, name in CHARACTERS.items()})
    font.setupGlyf(glyphs)
    bounds = font.font["glyf"]
    font.setupHorizontalMetrics({name: (1000, getattr(bounds[name], "xMin", 0)) for name in glyphs})
    font.setupHorizontalHeader(ascent=800, descent=-200)
    font.setupNameTable({"familyName": "Droplet Colours", "styleName": "Regular"})
    font.setupOS2()
    font.setupPost()
    font.setupHead(unitsPerEm=1024, created=0, modified=0)
    font.setupCPAL(PALETTES)
    font.setupCOLR(LAYERS)
    font.font.recalcTimestamp = False
    font.save(Path(__file__).with_name("colour.ttf"))


main()
