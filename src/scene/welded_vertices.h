// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Welded vertices, numbered in order of first appearance.
struct WeldedVertices {
    std::vector<std::uint32_t> first;   ///< for each welded vertex, a vertex
    std::vector<std::uint32_t> number;  ///< for each vertex, its welded vertex
};

/// @param weld  smallest index of a vertex at the same place
inline WeldedVertices weldVertices(const std::vector<std::uint32_t>& weld)
{
    WeldedVertices welded;
    welded.number.resize(weld.size());
    for (std::uint32_t i = 0; i < weld.size(); ++i) {
        if (weld[i] == i) {
            welded.number[i] = static_cast<std::uint32_t>(welded.first.size());
            welded.first.push_back(i);
        } else {
            welded.number[i] = welded.number[weld[i]];
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
