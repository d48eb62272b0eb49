// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <vector>

#include "droplet/image/css_colour.h"
#include "droplet/type/font.h"

struct FT_FaceRec_;

namespace droplet {

/// Colour of a font's palette.
struct PaletteEntry {
    CssColour colour;
    double opacity = 1.0;
};

/// Outline of a glyph, filled with a colour.
struct ColourLayer {
    GlyphId glyph = 0;
    PaletteEntry paint;
};

/// Glyph whose layers are damaged, or which is painted in another way. The text goes on after the glyph's name.
class Unreadable : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reads the layers of a glyph, the lowest first; none if the glyph has no layers.
/// @param palette      colours of the font
/// @param text_colour  for layers that have the text's colour
/// @throws Unreadable
std::vector<ColourLayer> readLayers(FT_FaceRec_* face, GlyphId glyph, const std::vector<PaletteEntry>& palette,
                                    const CssColour& text_colour);

}  // namespace droplet
