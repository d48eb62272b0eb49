// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Welded vertices, numbered in order of first appearance.
struct WeldedVertices {
    std::vector<std::uint32_t> first;   ///< for each welded vertex, a vertex of the surface
    std::vector<std::uint32_t> number;  ///< for each vertex of the surface, its welded vertex
};

inline WeldedVertices weldVertices(const Surface& surface)
{
    WeldedVertices welded;
    welded.number.resize(surface.weld.size());
    for (std::uint32_t i = 0; i < surface.weld.size(); ++i) {
        if (surface.weld[i] == i) {
            welded.number[i] = static_cast<std::uint32_t>(welded.first.size());
            welded.first.push_back(i);
        } else {
            welded.number[i] = welded.number[surface.weld[i]];
        }
    }
    return welded;
}

/// Moves the origin of texture coordinates from the upper left to the lower left.
constexpr Vec2 fromBelow(Vec2 uv)
{
    return {uv.x, 1.0 - uv.y};
}

}  // namespace droplet
