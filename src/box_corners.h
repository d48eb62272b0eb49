// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Lowest and highest corner of the box around points.
/// @param points  one or more
inline std::array<Vec3, 2> cornersOf(const std::vector<Vec3>& points)
{
    Vec3 low = points.front();
    Vec3 high = low;
    for (const Vec3& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return {low, high};
}

}  // namespace droplet
