// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "droplet/image/css_colour.h"
#include "droplet/outline/outline.h"
#include "droplet/type/font.h"

namespace droplet {

/// Options for outlines of glyphs.
struct GlyphOptions {
    double em = 20e-3;                     ///< edge of the em square (the font size) [m], > 0
    std::optional<double> tolerance;       ///< largest distance of a polyline from its curve [m], > 0; empty: em/20000.
                                           ///< Smaller values than em/2²⁶ count as that
    double speck_size = 1e-5;              ///< smallest area of a loop that is kept [em²], ≥ 0
    CssColour text_colour{255, 255, 255};  ///< of glyphs and layers without a colour of their own, where areas of
                                           ///< colour are made

    /// Checks all options.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Makes the outline of one glyph, without hinting.
///
/// The outline bounds what the glyph's contours enclose by the non-zero rule; they may overlap and have any direction.
/// Loops that would touch are moved apart by em/4096. A point is a corner if the curve turns by more than 25° there.
/// Points are at most em/256 apart, also along straight sides. The extent is the box from the font's descender to its
/// ascender, as wide as the glyph's advance. If the glyph does not fit, the box grows equally on opposite sides. So the
/// origin, in the middle of the box, has the same height above the base line for all glyphs of a font. pixel_size is 0.
/// @param font     any
/// @param glyph    less than font.glyphCount()
/// @param options  size and tolerances
/// @return         outline; without loops if the glyph has no ink, like a space
/// @throws Error   InvalidArgument: options, or no such glyph; InvalidInput: the font is damaged there
Outline glyphOutline(const Font& font, GlyphId glyph, const GlyphOptions& options = {});

/// Tells whether glyphOutline() has loops, much faster.
/// @throws Error as glyphOutline()
bool hasInk(const Font& font, GlyphId glyph, const GlyphOptions& options = {});

/// Alignment of the lines of a text in its box.
enum class TextAlign {
    Start,   ///< left; for lines from right to left, right
    Centre,  ///< centred
    End,     ///< right; for lines from right to left, left
};

/// Options of layOutText().
struct TextOptions {
    GlyphOptions glyph;                   ///< options of every glyph
    TextAlign align = TextAlign::Start;   ///< alignment of the lines
    double line_spacing = 1.0;            ///< leading: distance of base lines, as a multiple of the font's, > 0
    std::vector<double> line_sizes = {};  ///< type size of each line between line feeds [em], the last one also of all
                                          ///< further lines, each 0.05 … 20; empty: 1. Lines of different sizes are as
                                          ///< far apart as the lower part of the upper one and the upper part of the
                                          ///< lower one require
    double tracking = 0.0;  ///< extra width between letters [em], −1 … 10; none in scripts that join their
                            ///< letters. Unless it is 0, there are no ligatures
    std::optional<double> measure = {};  ///< width at which lines break at spaces [m], > 0; longer words stand over
    std::optional<double> arc = {};      ///< radius of the circle that the first base line lies on [m], not 0: letters
                                         ///< stand on it outside if it is above 0, inside below
    std::vector<Vec2> path = {};         ///< polyline that the first base line lies on [m], instead of a circle; text
                                         ///< stands on its left side. It is smooth where it turns by up to 25°, and
                                         ///< closed if the last point is the first one; empty: a straight line
    double shift = 0.0;  ///< of the text along the circle or path, as a share of its length, −1 … 1; text goes round
                         ///< closed ones, but once at most

    /// Checks all options.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Outline of a text, with figures.
struct TextLayout {
    Outline outline;                ///< without loops if the text has no ink
    std::vector<char32_t> missing;  ///< characters that the font lacks, in order of first occurrence, each once
    std::size_t lines = 0;          ///< number of lines
    std::size_t beyond = 0;         ///< letters that are left out because their middle lies beyond an end of the path
};

/// Makes the outline of a text, with the font's kerning, ligatures, combining marks and contextual forms. Letters run
/// from left to right or from right to left as in their script; the Unicode bidirectional algorithm orders mixed lines.
///
/// Letters that overlap become one region of liquid. The extent is the box of the lines, from the ascender of the first
/// line to the descender of the last one; on an arc or a path, around the letters' parts of the lines. It grows equally
/// on opposite sides if letters do not fit. All else is as in glyphOutline(), for the em of the smallest line.
///
/// On an arc and a path, the middle of every letter, with its marks, lies on the line and is turned like the line
/// there. Further lines keep their distance from the first one. On an arc, the middle of the widest line is at the top,
/// or at the bottom if the radius is below 0; lines are aligned with one another. On a path, lines are aligned between
/// its ends.
/// @param font     any
/// @param text     UTF-8; line feeds separate lines, and a tab counts as a space
/// @param options  size, alignment and spacing
/// @throws Error   InvalidArgument: options, text that is not UTF-8, a line longer than its circle, or lines that are
///                 2²⁰ em apart on their path; InvalidInput: the font is damaged
TextLayout layOutText(const Font& font, std::string_view text, const TextOptions& options = {});

}  // namespace droplet
