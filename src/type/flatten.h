// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/vector.h"
#include "type/contour_union.h"

namespace droplet {

/// How closely straight pieces follow a curve.
struct Flatness {
    double tolerance = 0.0;  ///< farthest they may lie from it, > 0
    double spacing = 0.0;    ///< longest piece, as a mean along the curve, > 0
};

/// Adds a quadratic Bézier curve from a contour's last point: pieces turn by 10° at most, as a mean along the curve.
void addConic(Contour& contour, Vec2 control, Vec2 end, const Flatness& flatness);

/// Likewise a cubic one.
void addCubic(Contour& contour, Vec2 first, Vec2 second, Vec2 end, const Flatness& flatness);

}  // namespace droplet
