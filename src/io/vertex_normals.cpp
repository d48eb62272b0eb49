// SPDX-License-Identifier: GPL-3.0-or-later
// G. Thürmer, C. A. Wüthrich, "Computing vertex normals from polygonal facets" (1998).
#include "io/vertex_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "union_find.h"

namespace droplet {
namespace {

// From here on, an edge is a crease, as in three.js (BufferGeometryUtils.toCreasedNormals). Prisms of seven sides are
// round, those of six are not.
constexpr double kCosCrease = 0.5 + 1e-6;

/// Normal of a triangle with the length of twice its area.
Vec3 areaOf(const std::vector<Vec3>& p, const Triangle& t)
{
    return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
}

/// Share of a triangle in the normal at one of its corners: its unit normal times its angle there.
Vec3 shareAt(const std::vector<Vec3>& p, const Triangle& t, std::size_t k)
{
    const Vec3 normal = areaOf(p, t);
    const double size = length(normal);
    const Vec3 a = p[t[(k + 1) % 3]] - p[t[k]];
    const Vec3 b = p[t[(k + 2) % 3]] - p[t[k]];
    return size > 0.0 ? (std::atan2(size, dot(a, b)) / size) * normal : Vec3{};
}

/// Side of a triangle, from the first to the second corner's place.
struct Side {
    std::uint32_t low = 0;    ///< place with the smaller index
    std::uint32_t high = 0;   ///< the other place
    bool descends = false;    ///< whether it goes from high to low
    std::uint32_t first = 0;  ///< corner of all triangles where it begins
};

/// For every triangle the first one with its corners, in any order.
std::vector<std::uint32_t> firstWithCorners(const std::vector<Triangle>& triangles,
                                            const std::vector<std::uint32_t>& place)
{
    std::vector<std::pair<Triangle, std::uint32_t>> corners;
    corners.reserve(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        Triangle at{place[triangles[t][0]], place[triangles[t][1]], place[triangles[t][2]]};
        std::sort(at.begin(), at.end());
        corners.emplace_back(at, t);
    }
    std::sort(corners.begin(), corners.end());
    std::vector<std::uint32_t> first(triangles.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const bool repeats = i > 0 && corners[i].first == corners[i - 1].first;
        first[corners[i].second] = repeats ? first[corners[i - 1].second] : corners[i].second;
    }
    return first;
}

/// @param first  sides of triangles with another number are left out
std::vector<Side> sidesOf(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& place,
                          const std::vector<std::uint32_t>& first)
{
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t k = 0; first[t] == t && k < 3; ++k) {
            const std::uint32_t from = place[triangles[t][k]];
            const std::uint32_t to = place[triangles[t][(k + 1) % 3]];
            sides.push_back({std::min(from, to), std::max(from, to), from > to, static_cast<std::uint32_t>(3 * t + k)});
        }
    }
    const auto key = [](const Side& side) { return std::array{side.low, side.high, side.first}; };
    std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) { return key(a) < key(b); });
    return sides;
}

}  // namespace

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
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3& sum = sums[place[t[k]]];
            sum = sum + shareAt(p, t, k);
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

CreasedTriangles divideAtCreases(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                 const std::vector<std::uint32_t>& place, const std::vector<Vec3>& normals)
{
    if (std::none_of(normals.begin(), normals.end(), [](const Vec3& n) { return n == Vec3{}; })) {
        return {triangles, {}, normals};
    }
    // Corners that one side of all creases at their place shares.
    UnionFind shared(3 * triangles.size());
    const auto next = [](std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
    const std::vector<std::uint32_t> first = firstWithCorners(triangles, place);
    const std::vector<Side> sides = sidesOf(triangles, place, first);
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
        while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) {
            ++end;
        }
        if (end - i != 2 || sides[i].descends == sides[i + 1].descends) {
            continue;
        }
        const std::uint32_t a = sides[i].first;
        const std::uint32_t b = sides[i + 1].first;
        const Vec3 on_a = areaOf(vertices, triangles[a / 3]);
        const Vec3 on_b = areaOf(vertices, triangles[b / 3]);
        const double both = length(on_a) * length(on_b);
        if (both == 0.0 || dot(on_a, on_b) > kCosCrease * both) {
            shared.join(a, next(b));
            shared.join(next(a), b);
        }
    }
    std::vector<Vec3> sums(3 * triangles.size());
    for (std::uint32_t c = 0; c < sums.size(); ++c) {
        if (first[c / 3] == c / 3) {
            Vec3& sum = sums[shared.find(c)];
            sum = sum + shareAt(vertices, triangles[c / 3], c % 3);
        }
    }
    CreasedTriangles creased{triangles, {}, normals};
    std::unordered_map<std::uint64_t, std::uint32_t> vertex_of;  // of every vertex and set of corners
    std::vector<bool> is_taken(vertices.size());
    for (std::uint32_t c = 0; c < sums.size(); ++c) {
        std::uint32_t& corner = creased.triangles[c / 3][c % 3];
        if (normals[corner] != Vec3{}) {
            continue;
        }
        // A triangle that repeats another has its normals.
        std::uint32_t like = 3 * first[c / 3];
        while (place[triangles[first[c / 3]][like % 3]] != place[corner]) {
            ++like;
        }
        const std::uint64_t set = shared.find(like);
        const auto added = static_cast<std::uint32_t>(vertices.size() + creased.copies.size());
        const auto [found, is_new] =
            vertex_of.try_emplace(std::uint64_t{corner} << 32U | set, is_taken[corner] ? added : corner);
        if (is_new && found->second == added) {
            creased.copies.push_back(corner);
            creased.normals.emplace_back();
        }
        is_taken[corner] = true;
        creased.normals[found->second] = sums[set];
        corner = found->second;
    }
    return creased;
}

}  // namespace droplet
