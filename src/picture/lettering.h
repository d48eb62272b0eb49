// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "droplet/picture/picture.h"
#include "droplet/vector.h"

namespace droplet {

class Canvas;

// Letters are strokes of our own: a picture is the same whatever fonts are installed, or none.

/// How words are drawn.
struct Pen {
    double size = 12.0;                              ///< height of capitals [px]
    double width = 1.6;                              ///< of strokes [px]
    std::array<std::uint8_t, 3> colour{30, 34, 40};  ///< sRGB
};

/// How long a line of text is [px]. UTF-8; what is neither printable ASCII nor one of ° µ ² · − – Δ
/// counts, and shows, as `?`.
double textWidth(std::string_view text, double size);

/// The text, or as much of it as fits into a width with an ellipsis [px].
std::string fitted(std::string_view text, double size, double width);

/// Draws a line of text; what lies beyond the picture is left out.
/// @param at  left end of the line the letters stand on [px], y down
void drawText(Picture& picture, std::string_view text, Vec2 at, const Pen& pen);
void drawText(const Canvas& canvas, std::string_view text, Vec2 at, const Pen& pen);

}  // namespace droplet
