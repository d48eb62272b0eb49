// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Corner of a triangle.
struct TriangleCorner {
    std::uint32_t triangle = 0;
    std::uint32_t corner = 0;  ///< 0 … 2
};

/// Two triangles with a common edge, by the corners that face it.
struct TrianglePair {
    TriangleCorner one;  ///< of the triangle with the smaller index
    TriangleCorner other;
};

/// Finds triangles beside each other, in the order of the vertices of their common edges.
/// @param triangles  at most two at every edge
std::vector<TrianglePair> trianglePairs(std::span<const Triangle> triangles);

}  // namespace droplet
