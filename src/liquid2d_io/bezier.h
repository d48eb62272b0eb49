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
/// Guarantees: no point of the polyline is farther than the tolerance from the path; tangents are continuous except at
/// corners, where the polyline turns by more than 60° within a few points.
/// @param points     at least three, the first not repeated
/// @param tolerance  > 0
BezierPath fitBezier(const std::vector<Vec2>& points, double tolerance);

}  // namespace droplet
