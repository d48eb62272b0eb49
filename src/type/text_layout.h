// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/type/glyph.h"
#include "type/font_face.h"
#include "type/glyph_frame.h"

namespace droplet {

/// Line of glyphs from left to right; lengths in ems.
struct TextLine {
    std::vector<ShapedGlyph> glyphs;
    double advance = 0.0;
    bool leftward = false;  ///< whether the line starts on the right
};

/// Sets one line of text.
/// @param text      without line feeds
/// @param tracking  as in TextOptions
TextLine layOutLine(const FontFace& face, const std::u32string& text, double tracking = 0.0);

/// Glyph in its place.
struct PlacedGlyph {
    GlyphId glyph = 0;
    Vec2 origin;
    Vec2 along = {1.0, 0.0};  ///< direction of its base line, as long as the glyph's em
    double size = 1.0;        ///< the glyph's em
};

/// Glyphs of a text; lengths in ems.
struct PlacedText {
    std::vector<PlacedGlyph> glyphs;  ///< in the order in which they are drawn
    Box box;                          ///< of the lines
    std::vector<char32_t> missing;    ///< as in TextLayout
    std::size_t lines = 0;            ///< as in TextLayout
    std::size_t beyond = 0;           ///< as in TextLayout
    double smallest = 1.0;            ///< em of the smallest line
};

/// Places all glyphs of a text, as layOutText() describes it.
/// @throws Error  InvalidArgument: text that is not UTF-8
PlacedText placeText(const FontFace& face, std::string_view text, const TextOptions& options);

/// A contour, turned and scaled so that its unit in x becomes a vector, then moved.
Contour moved(Contour contour, Vec2 by, Vec2 along = {1.0, 0.0});

}  // namespace droplet
