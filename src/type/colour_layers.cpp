// SPDX-License-Identifier: GPL-3.0-or-later
//
// Table COLR, OpenType 1.9.1. FreeType reads lists of layers (version 0). Debian builds it without graphs of paints
// (version 1), so here they are only recognised, and refused.

#include "type/colour_layers.h"

#include <ft2build.h>
#include FT_COLOR_H
#include FT_FREETYPE_H
#include FT_TRUETYPE_TABLES_H

#include <array>
#include <cstddef>
#include <string>

namespace droplet {
namespace {

constexpr FT_UInt kTextColour = 0xFFFF;

/// Number of `count` bytes, the highest first, in the table COLR; 0 beyond its end.
std::size_t numberAt(FT_Face face, std::size_t place, std::size_t count)
{
    std::array<FT_Byte, 4> bytes{};
    auto size = static_cast<FT_ULong>(count);
    const auto at = static_cast<FT_Long>(place);
    if (FT_Load_Sfnt_Table(face, FT_MAKE_TAG('C', 'O', 'L', 'R'), at, bytes.data(), &size) != 0) {
        return 0;
    }
    std::size_t number = 0;
    for (std::size_t i = 0; i < count; ++i) {
        number = 256 * number + bytes[i];
    }
    return number;
}

/// Whether a glyph is painted by a graph: whether it is in the BaseGlyphList.
bool hasGraph(FT_Face face, GlyphId glyph)
{
    constexpr std::size_t kRecord = 6;
    const std::size_t list = numberAt(face, 0, 2) == 0 ? 0 : numberAt(face, 14, 4);
    if (list == 0) {
        return false;
    }
    std::size_t begin = 0;
    std::size_t end = numberAt(face, list, 4);
    while (begin < end) {
        const std::size_t middle = begin + (end - begin) / 2;
        const std::size_t here = numberAt(face, list + 4 + kRecord * middle, 2);
        if (here == glyph) {
            return true;
        }
        (here < glyph ? begin : end) = here < glyph ? middle + 1 : middle;
    }
    return false;
}

PaletteEntry entryOf(FT_UInt index, const std::vector<PaletteEntry>& palette, const CssColour& text_colour)
{
    if (index == kTextColour) {
        return {text_colour, 1.0};
    }
    if (index >= palette.size()) {
        throw Unreadable("has a layer in colour " + std::to_string(index) + ", but the font's palette has only " +
                         std::to_string(palette.size()) + " colours");
    }
    return palette[index];
}

}  // namespace

std::vector<ColourLayer> readLayers(FT_FaceRec_* face, GlyphId glyph, const std::vector<PaletteEntry>& palette,
                                    const CssColour& text_colour)
{
    constexpr std::size_t kMaxLayers = 4096;  // the largest emoji have about a hundred
    std::vector<ColourLayer> layers;
    FT_LayerIterator iterator{};
    FT_UInt layer = 0;
    FT_UInt colour = 0;
    while (FT_Get_Color_Glyph_Layer(face, glyph, &layer, &colour, &iterator) != 0) {
        if (static_cast<FT_Long>(layer) >= face->num_glyphs || layers.size() >= kMaxLayers) {
            throw Unreadable("has damaged colour layers");
        }
        layers.push_back({layer, entryOf(colour, palette, text_colour)});
    }
    if (layers.empty() && hasGraph(face, glyph)) {
        throw Unreadable(
            "has gradients or other paints of COLR version 1; only layers in flat colours (version 0) can become "
            "droplets");
    }
    return layers;
}

}  // namespace droplet
