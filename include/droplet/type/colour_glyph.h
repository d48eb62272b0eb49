// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "droplet/colours/colour_drawing.h"
#include "droplet/type/font.h"
#include "droplet/type/glyph.h"

namespace droplet {

/// Areas of colour of a glyph or a text.
struct ColourLayout {
    ColourDrawing drawing;          ///< the largest area first; without areas if there is no ink
    bool has_layers = false;        ///< whether any glyph has layers; otherwise all is one area in the text's colour
    std::vector<char32_t> missing;  ///< as in TextLayout
    std::size_t lines = 0;          ///< as in TextLayout
    std::size_t beyond = 0;         ///< as in TextLayout
};

/// Tells whether a glyph has colour layers.
/// @throws Error InvalidArgument: no such glyph; InvalidInput: as glyphColours()
bool hasColourLayers(const Font& font, GlyphId glyph);

/// Makes the areas of colour of one glyph, from its layers in the font's palette.
///
/// Upper layers cover lower ones. Where a lower layer would show less than em/256 beside the edge of an upper one, that
/// covers it, too. Where a layer is translucent, it blends in sRGB with the colour below, and has its own colour on
/// nothing. A glyph without layers has the text's colour. The extent and the curves are those of glyphOutline(), but
/// areas may touch one another and themselves.
/// @param font     any
/// @param glyph    less than font.glyphCount()
/// @param options  size, tolerance and the text's colour
/// @throws Error   as glyphOutline(); InvalidInput: the glyph is painted by COLR version 1; the message names it
ColourLayout glyphColours(const Font& font, GlyphId glyph, const GlyphOptions& options = {});

/// Makes the areas of colour of a text, whose glyphs layOutText() places. Later glyphs cover earlier ones.
/// @throws Error   as layOutText() and glyphColours()
ColourLayout layOutColours(const Font& font, std::string_view text, const TextOptions& options = {});

}  // namespace droplet
