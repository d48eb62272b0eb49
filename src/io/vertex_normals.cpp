// SPDX-License-Identifier: GPL-3.0-or-later
// G. Thürmer, C. A. Wüthrich, "Computing vertex normals from polygonal facets" (1998).
#include "io/vertex_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace droplet {

std::vector<std::uint32_t> firstAtPlace(const std::vector<Vec3>& vertices)
{
    const std::vector<Vec3>& p = vertices;
    std::vector<std::uint32_t> order(p.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&p](std::uint32_t v) { return std::array{p[v].x, p[v].y, p[v].z}; };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto at_a = key(a);
        const auto at_b = key(b);
        return at_a < at_b || (at_a == at_b && a < b);
    });
    std::vector<std::uint32_t> first(p.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        first[order[i]] = i > 0 && p[order[i]] == p[order[i - 1]] ? first[order[i - 1]] : order[i];
    }
    return first;
}

void fillNormals(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                 const std::vector<std::uint32_t>& place, std::vector<Vec3>& normals)
{
    const std::vector<Vec3>& p = vertices;
    std::vector<Vec3> sums(p.size());
    for (const Triangle& t : triangles) {
        const Vec3 normal = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
        const double size = length(normal);
        for (std::size_t k = 0; size > 0.0 && k < 3; ++k) {
            const Vec3 a = p[t[(k + 1) % 3]] - p[t[k]];
            const Vec3 b = p[t[(k + 2) % 3]] - p[t[k]];
            Vec3& sum = sums[place[t[k]]];
            sum = sum + (std::atan2(size, dot(a, b)) / size) * normal;
        }
    }
    for (std::size_t v = 0; v < p.size(); ++v) {
        Vec3& n = normals[v];
        const auto towards = [&n](Vec3 a) {
            const double size = length(a);
            n = size > 0.0 && std::isfinite(size) ? (1.0 / size) * a : Vec3{};
        };
        towards(n);
        if (n == Vec3{}) {
            towards(sums[place[v]]);
        }
        if (n == Vec3{}) {
            n = {0.0, 1.0, 0.0};  // no triangle with an area
        }
    }
}

}  // namespace droplet
