#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the measured letter: `masks.py FOLDER PIXELS...` writes FOLDER/letter_PIXELS.png."""

import pathlib
import sys

from PIL import Image, ImageDraw, ImageFont

Image.MAX_IMAGE_PIXELS = None  # the limit protects against foreign files
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"
LETTER = "&"  # has a hole, straight and round strokes, and blunt, sharp and re-entrant corners


def letter(pixels):
    """White letter on a black square, anti-aliased, centred, nine tenths as wide as the square."""
    face = ImageFont.truetype(FONT, pixels)
    left, _, right, _ = face.getbbox(LETTER)
    face = ImageFont.truetype(FONT, round(0.9 * pixels * pixels / (right - left)))
    image = Image.new("L", (pixels, pixels), 0)
    ImageDraw.Draw(image).text((pixels // 2, pixels // 2), LETTER, font=face, fill=255, anchor="mm")
    return image


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for pixels in map(int, sys.argv[2:]):
        letter(pixels).save(folder / f"letter_{pixels}.png")


if __name__ == "__main__":
    main()
