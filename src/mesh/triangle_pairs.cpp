// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_pairs.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace droplet {

std::vector<TrianglePair> trianglePairs(std::span<const Triangle> triangles)
{
    struct Edge {
        std::uint32_t low;
        std::uint32_t high;
        TriangleCorner facing;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangles[t][(k + 1) % 3];
            const std::uint32_t b = triangles[t][(k + 2) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), {t, k}});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::array{a.low, a.high, a.facing.triangle} < std::array{b.low, b.high, b.facing.triangle};
    });
    std::vector<TrianglePair> pairs;
    for (std::size_t i = 1; i < edges.size(); ++i) {
        if (edges[i - 1].low == edges[i].low && edges[i - 1].high == edges[i].high) {
            pairs.push_back({edges[i - 1].facing, edges[i].facing});
        }
    }
    return pairs;
}

}  // namespace droplet
