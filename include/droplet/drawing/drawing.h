// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/vector.h"

namespace droplet {

using Colour = std::array<std::uint8_t, 3>;  ///< sRGB: red, green, blue

/// Filled polygon whose sides do not cross.
struct Area {
    std::vector<Vec2> points;  ///< corners
    Colour colour{};           ///< of the filling
    double opacity = 1.0;      ///< 0 … 1
};

/// Polyline with round ends and bends.
struct Line {
    std::vector<Vec2> points;  ///< of the polyline
    Colour colour{};           ///< of the stroke
    double width = 1.0;        ///< of the stroke
    double dash = 0.0;         ///< length of dashes and gaps; 0: solid
};

/// Point of a text that stands at its position.
enum class Anchor { Start, Middle, End };

/// Line of text.
struct Text {
    std::string text;               ///< printable ASCII and ° µ ² · − – Δ
    Vec2 at;                        ///< position on the baseline
    double size = 9.0;              ///< height of capitals
    Colour colour{};                ///< of the letters
    Anchor anchor = Anchor::Start;  ///< part of the text at `at`
    bool bold = false;              ///< thicker strokes
    bool halo = false;              ///< white outline that separates letters from marks below
};

/// Vector drawing on white, y down.
struct Drawing {
    double width = 0.0;                                 ///< in the drawing's units
    double height = 0.0;                                ///< in the drawing's units
    std::vector<std::variant<Area, Line, Text>> marks;  ///< later ones over earlier ones
};

/// Joins drawings side by side, aligned at the top.
Drawing beside(const std::vector<Drawing>& drawings);

/// Writes a drawing as SVG. Text remains text, in the viewer's sans-serif font.
///
/// Guarantees: the same drawing gives the same bytes; the stream is left failed if it did not take everything.
void writeSvg(const Drawing& drawing, std::ostream& out);

/// Draws a drawing as pixels, with built-in letters that need no fonts.
/// @param drawing  to draw
/// @param scale    pixels per unit, > 0
/// @throws Error   InvalidArgument: the picture would be empty, over kMaxPicturePixels, or over 32767 pixels a side
Picture pictureOf(const Drawing& drawing, double scale);

}  // namespace droplet
