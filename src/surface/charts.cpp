// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/charts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "surface/half_edges.h"
#include "union_find.h"

namespace droplet {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Gives equal keys the same number, in ascending order. Returns the number of different keys.
template <class Key>
std::uint32_t numberEqual(const std::vector<Key>& keys, std::vector<std::uint32_t>& numbers)
{
    std::vector<std::uint32_t> order(keys.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
    numbers.resize(keys.size());
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        count += i == 0 || keys[order[i - 1]] < keys[order[i]] ? 1 : 0;
        numbers[order[i]] = count - 1;
    }
    return count;
}

/// 1, or −1 if a triangle mirrors the picture, seen from outside.
double facingOf(const TexturedMesh& object, const Facet& facet)
{
    const auto [i, j, k] = facet.corners;
    const Vec3 a = object.vertices[i];
    const Vec3 normal = cross(object.vertices[j] - a, object.vertices[k] - a);
    const double out = dot(normal, object.normals[i] + object.normals[j] + object.normals[k]);
    return std::copysign(1.0, facet.twice_flat) * (out < 0.0 ? -1.0 : 1.0);
}

}  // namespace

std::vector<double> joinCharts(const TexturedMesh& object, std::vector<Facet>& facets)
{
    std::vector<std::array<double, 5>> keys;
    for (std::size_t v = 0; v < object.vertices.size(); ++v) {
        const Vec3 p = object.vertices[v];
        keys.push_back({p.x, p.y, p.z, object.uvs[v].x, object.uvs[v].y});
    }
    std::vector<std::uint32_t> welded;
    const std::uint32_t welded_count = numberEqual(keys, welded);

    // Only triangles that face the same way share vertices. All are made to wind outward.
    std::vector<Vec3> vertices(2 * std::size_t{welded_count});
    std::vector<Triangle> outward;
    std::vector<double> facing;
    for (const Facet& facet : facets) {
        facing.push_back(facingOf(object, facet));
        Triangle t{};
        for (std::size_t k = 0; k < 3; ++k) {
            t[k] = 2 * welded[facet.corners[k]] + (facing.back() < 0.0 ? 1U : 0U);
            vertices[t[k]] = object.vertices[facet.corners[k]];
        }
        if (facing.back() * facet.twice_flat < 0.0) {
            std::swap(t[1], t[2]);
        }
        outward.push_back(t);
    }
    UnionFind charts = joinedAcrossEdges(halfEdges(vertices, outward), outward);
    std::vector<std::uint32_t> number(facets.size(), kNone);
    std::vector<double> chart_facing;
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        const std::uint32_t name = charts.find(f);
        if (name == f) {
            number[f] = static_cast<std::uint32_t>(chart_facing.size());
            chart_facing.push_back(facing[f]);
        }
        facets[f].chart = number[name];
    }
    std::vector<std::array<std::uint32_t, 2>> corner_keys;
    for (const Facet& facet : facets) {
        for (const std::uint32_t v : facet.corners) {
            corner_keys.push_back({facet.chart, welded[v]});
        }
    }
    std::vector<std::uint32_t> corner;
    numberEqual(corner_keys, corner);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        std::copy_n(corner.begin() + static_cast<std::ptrdiff_t>(3 * f), 3, facets[f].corners.begin());
    }
    return chart_facing;
}

std::vector<Vec2> joinedUvs(const TexturedMesh& object)
{
    constexpr double kSame = 1e-6;  // bits of single precision from 1 on, in which Blender's grids end
    std::vector<std::array<double, 3>> places;
    for (const Vec3& p : object.vertices) {
        places.push_back({p.x, p.y, p.z});
    }
    std::vector<std::uint32_t> place;
    std::vector<std::vector<Vec2>> known(numberEqual(places, place));
    std::vector<Vec2> uvs = object.uvs;
    for (std::size_t v = 0; v < uvs.size(); ++v) {
        std::vector<Vec2>& here = known[place[v]];
        const auto same = std::find_if(here.begin(), here.end(), [&](Vec2 uv) {
            return std::max(std::abs(uv.x - uvs[v].x), std::abs(uv.y - uvs[v].y)) <= kSame;
        });
        if (same != here.end()) {
            uvs[v] = *same;
        } else {
            here.push_back(uvs[v]);
        }
    }
    return uvs;
}

}  // namespace droplet
