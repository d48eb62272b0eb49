// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Calls visit(first triangle, corners) for every face in order; quadrilaterals have four corners.
/// @param quads  indices, ascending, of triangles (a, b, c) that are followed by (a, c, d): both are the face abcd
template <class Visit>
void forEachFace(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& quads, const Visit& visit)
{
    auto quad = quads.begin();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t];
        if (quad != quads.end() && *quad == t) {
            ++quad;
            visit(t, std::initializer_list<std::uint32_t>{a, b, c, triangles[t + 1][2]});
            ++t;
        } else {
            visit(t, std::initializer_list<std::uint32_t>{a, b, c});
        }
    }
}

}  // namespace droplet
