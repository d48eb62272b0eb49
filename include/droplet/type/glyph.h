// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "droplet/footprint/outline.h"
#include "droplet/type/font.h"

namespace droplet {

/// How outlines of a font become outlines of droplets.
struct GlyphOptions {
    double em = 20e-3;                ///< edge of the em square, the font's size [m], > 0
    std::optional<double> tolerance;  ///< farthest a curve's straight pieces may lie from it [m], > 0 [em/20000];
                                      ///< no finer than em/2²⁶
    double speck_size = 1e-5;         ///< loops that enclose less than this are dropped [em²], ≥ 0

    /// @throws Error InvalidArgument
    void validate() const;
};

/// The outline of one glyph, without hinting.
///
/// What the glyph's contours enclose by the non-zero rule, however they overlap and whichever way they run. Where loops
/// would touch, they are moved apart by em/4096. Corners are where the curve turns by more than 25°. Points are at most
/// em/256 apart, also along straight sides. The extent is the box from the font's descender to its ascender, as wide as
/// the glyph's advance, enlarged on both sides alike if the glyph stands out of it: so the middle of the box, the
/// origin, lies at the same height above the base line for all glyphs of a font. There are no pixels: pixel_size is 0.
/// @param font   any
/// @param glyph  less than font.glyphCount()
/// @return       without loops if the glyph has no ink, like a space
/// @throws Error InvalidArgument: options, or no such glyph; InvalidInput: the font is broken there
Outline glyphOutline(const Font& font, GlyphId glyph, const GlyphOptions& options = {});

/// Whether glyphOutline() has loops; much quicker.
/// @throws Error as glyphOutline()
bool hasInk(const Font& font, GlyphId glyph, const GlyphOptions& options = {});

/// Where lines of a text stand in its box; for those that run from right to left, the start is on the right.
enum class TextAlign { Start, Centre, End };

/// How a text is set.
struct TextOptions {
    GlyphOptions glyph;
    TextAlign align = TextAlign::Start;
    double line_spacing = 1.0;  ///< from base line to base line, in those of the font, > 0

    /// @throws Error InvalidArgument
    void validate() const;
};

/// A text's outline, and what became of the text.
struct SetText {
    Outline outline;                ///< without loops if the text has no ink
    std::vector<char32_t> missing;  ///< characters the font lacks, left out; in order of first occurrence, each once
    std::size_t lines = 0;
};

/// Sets a text: kerning, ligatures, combining marks and contextual forms as the font has them, letters from left to
/// right or right to left as their scripts run, both in one line by the Unicode bidirectional algorithm.
///
/// What letters enclose together is liquid: overlapping ones run into one. The extent is the box of the lines, from the
/// first one's ascender to the last one's descender, enlarged on both sides alike if letters stand out of it. Otherwise
/// as glyphOutline().
/// @param text   UTF-8, lines parted by line feeds; a tabulator counts as a space
/// @throws Error InvalidArgument: options, text that is not UTF-8; InvalidInput: the font is broken where it is needed
SetText setText(const Font& font, std::string_view text, const TextOptions& options = {});

}  // namespace droplet
