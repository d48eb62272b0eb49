// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Least box along the axes that holds some points; without points its lower corner is above the upper one.
struct Bounds {
    Vec2 lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Vec2 upper{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

    void include(Vec2 point)
    {
        lower = {std::min(lower.x, point.x), std::min(lower.y, point.y)};
        upper = {std::max(upper.x, point.x), std::max(upper.y, point.y)};
    }
    void include(const std::vector<Vec2>& points)
    {
        for (const Vec2 point : points) {
            include(point);
        }
    }
};

/// Box of points.
inline Bounds boundsOf(const std::vector<Vec2>& points)
{
    Bounds bounds;
    bounds.include(points);
    return bounds;
}

}  // namespace droplet
