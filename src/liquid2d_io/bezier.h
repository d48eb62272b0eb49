// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Cubic Bézier curve after the end of the one before.
struct BezierCurve {
    Vec2 leaving;   ///< control point
    Vec2 arriving;  ///< control point
    Vec2 end;
};

/// Closed path of curves.
struct BezierPath {
    Vec2 start;
    std::vector<BezierCurve> curves;  ///< the last one ends at `start`
};

/// Fits few curves to a closed polyline.
///
/// Guarantees: every place of the polyline is within the tolerance of the path, and every place of the path within it
/// of the polyline; tangents are continuous except at corners, where the polyline turns by more than 60° within five
/// tolerances.
/// @param polyline   at least one point, the first not repeated
/// @param tolerance  > 0
BezierPath fitBezier(const std::vector<Vec2>& polyline, double tolerance);

}  // namespace droplet
