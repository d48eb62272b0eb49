// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "droplet/shape/capillary_surface.h"

namespace droplet {

/// Half the cross product of two edges: outward, as long as the triangle's area.
inline Vec3 areaVector(const std::vector<Vec3>& vertices, const Triangle& t)
{
    return 0.5 * cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]);
}

/// Whether the ground under a triangle is dry: all its vertices are on the ground, and it is not upside down, as under
/// liquid that leans out beside the footprint.
inline bool isDry(const CapillarySurface& surface, const Triangle& t)
{
    return !surface.dry.empty() &&
           std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return surface.onRim(v) || surface.dry[v] != 0; }) &&
           areaVector(surface.vertices, t).z >= 0.0;
}

}  // namespace droplet
