// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "box_corners.h"
#include "droplet/render/render.h"
#include "droplet/vector.h"

namespace droplet {

/// Smallest box around points.
/// @param points  at least one
inline ViewBox boxOf(const std::vector<Vec3>& points)
{
    const auto [low, high] = cornersOf(points);
    return {low, high};
}

}  // namespace droplet
