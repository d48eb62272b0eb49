// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "droplet/render/render.h"
#include "droplet/vector.h"

namespace droplet {

/// Smallest box around points.
/// @param points  at least one
inline ViewBox boxOf(const std::vector<Vec3>& points)
{
    ViewBox box{points.front(), points.front()};
    for (const Vec3& p : points) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
    return box;
}

}  // namespace droplet
