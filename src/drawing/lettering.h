// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "droplet/drawing/picture.h"
#include "droplet/vector.h"

namespace droplet {

class Canvas;

// Letters are built-in strokes, so pictures do not depend on installed fonts.

/// Style of text.
struct Pen {
    double size = 12.0;                              ///< height of capitals [px]
    double width = 1.6;                              ///< width of strokes [px]
    std::array<std::uint8_t, 3> colour{30, 34, 40};  ///< sRGB
};

/// Length of a line of UTF-8 text [px]. Characters other than printable ASCII and ° µ ² · − – Δ are shown as `?`.
double textWidth(std::string_view text, double size);

/// Shortens a text with an ellipsis, if needed, to a width [px].
std::string fitted(std::string_view text, double size, double width);

/// Draws a line of text, clipped to the picture.
/// @param at  left end of the baseline [px], y down
void drawText(Picture& picture, std::string_view text, Vec2 at, const Pen& pen);
void drawText(const Canvas& canvas, std::string_view text, Vec2 at, const Pen& pen);

}  // namespace droplet
