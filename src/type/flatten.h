// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/vector.h"
#include "type/contour_union.h"

namespace droplet {

/// Accuracy of a polyline along a curve.
struct Flatness {
    double tolerance = 0.0;  ///< largest distance from the curve, > 0
    double spacing = 0.0;    ///< largest mean length of a piece, > 0
};

/// Adds a quadratic Bézier curve from the last point of a contour. The mean turn between pieces is at most 10°.
void addConic(Contour& contour, Vec2 control, Vec2 end, const Flatness& flatness);

/// The same for a cubic curve.
void addCubic(Contour& contour, Vec2 first, Vec2 second, Vec2 end, const Flatness& flatness);

}  // namespace droplet
