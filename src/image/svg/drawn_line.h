// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Line of a drawing that text may follow, as Bézier curves.
struct SvgLine {
    std::vector<Vec2>
        points;               ///< on the page [CSS px], y down: the start, then two control points and an end for every
                              ///< curve; straight pieces have their ends as control points. Empty if there is no line
    double page_width = 0.0;  ///< [CSS px]; that of all lines if the drawing states none
    std::size_t others = 0;   ///< further lines, which might be meant as well
};

/// Finds the line that text of a drawing follows, or else the longest line that the drawing draws, in any colour or
/// none: of paths and basic shapes that are displayed, each part that begins with a move by itself.
/// @param text  of the drawing
SvgLine lineIn(std::span<const std::byte> text);

}  // namespace droplet
