// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/colours/colour_regions.h"
#include "droplet/image/css_colour.h"
#include "droplet/vector.h"

namespace droplet {

/// All parts of a drawing that have one colour.
struct ColourArea {
    CssColour colour;                      ///< of the liquid
    std::vector<std::vector<Vec2>> loops;  ///< closed polygons with liquid on their left; they may touch [m]
};

/// Drawing in flat colours without pixels.
struct ColourDrawing {
    std::vector<ColourArea> areas;  ///< each colour once; areas do not overlap
    Vec2 extent;                    ///< width and height [m]; the origin is in the middle, y up
};

/// Area of one colour [m²].
double area(const ColourArea& colour_area);

/// Draws a drawing with pixels. Each pixel knows the exact area of its colours, so colours may be as alike as they
/// like. The palette has the colours in the order of the areas. The result does not depend on the number of threads.
/// @param drawing    valid
/// @param long_side  pixels of the longer side, 1 … 16384; the shorter side is rounded up
/// @throws Error     InvalidInput: more than 255 colours; InvalidArgument: long_side
ColourRegions drawColours(const ColourDrawing& drawing, int long_side = 2048);

}  // namespace droplet
