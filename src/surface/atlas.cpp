// SPDX-License-Identifier: GPL-3.0-or-later
// Thesis, section 4.2.5: droplets are solved on nearly level ground, then mapped onto the object "like texture
// mapping". Normals are mapped by the cofactors of the map's derivative; J. F. Blinn, "Simulation of wrinkled surfaces"
// (1978), is the case of a thin layer.
#include "surface/atlas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace droplet {
namespace {

/// Distance at which a point counts as on a triangle, in extents of the picture: the resolution of float uvs.
constexpr double kTolerance = 1e-7;

Vec3 unitOr(Vec3 a, Vec3 otherwise)
{
    const double size = length(a);
    return size > 0.0 && std::isfinite(size) ? (1.0 / size) * a : otherwise;
}

/// Derivatives along x and y of a linear function on a triangle.
std::array<Vec3, 2> derivatives(const Facet& facet, const std::array<Vec3, 3>& values)
{
    const Vec2 p = facet.flat[1] - facet.flat[0];
    const Vec2 q = facet.flat[2] - facet.flat[0];
    const Vec3 a = values[1] - values[0];
    const Vec3 b = values[2] - values[0];
    const double inverse = 1.0 / facet.twice_flat;
    return {inverse * (q.y * a - p.y * b), inverse * (p.x * b - q.x * a)};
}

/// Angles of a facet in the picture's plane. Their sum at a vertex does not depend on the triangulation.
std::array<double, 3> anglesOf(const Facet& facet)
{
    std::array<double, 3> angles{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 a = facet.flat[(k + 1) % 3] - facet.flat[k];
        const Vec2 b = facet.flat[(k + 2) % 3] - facet.flat[k];
        angles[k] = std::atan2(std::abs(cross(a, b)), dot(a, b));
    }
    return angles;
}

/// Means over the facets around every corner, weighted by their angles there.
std::vector<AtlasCorner> cornersOf(const TexturedMesh& object, const std::vector<Facet>& facets,
                                   const std::vector<std::array<std::uint32_t, 3>>& vertices)
{
    std::uint32_t count = 0;
    for (const Facet& facet : facets) {
        count = std::max({count, facet.corners[0] + 1, facet.corners[1] + 1, facet.corners[2] + 1});
    }
    std::vector<AtlasCorner> corners(count);
    std::vector<double> weights(count, 0.0);
    const auto add = [](std::array<Vec3, 2>& sum, double weight, const std::array<Vec3, 2>& value) {
        sum = {sum[0] + weight * value[0], sum[1] + weight * value[1]};
    };
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const Facet& facet = facets[f];
        const std::array<double, 3> angles = anglesOf(facet);
        std::array<Vec3, 3> places;
        for (std::size_t k = 0; k < 3; ++k) {
            places[k] = object.vertices[vertices[f][k]];
        }
        const double stretch = length(cross(places[1] - places[0], places[2] - places[0])) / std::abs(facet.twice_flat);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t c = facet.corners[k];
            corners[c].place = places[k];
            corners[c].normal = corners[c].normal + angles[k] * object.normals[vertices[f][k]];
            corners[c].scale += angles[k] * stretch;
            add(corners[c].along, angles[k], derivatives(facet, places));
            weights[c] += angles[k];
        }
    }
    for (std::size_t f = 0; f < facets.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            // If opposite normals cancel, the first one is used.
            AtlasCorner& corner = corners[facets[f].corners[k]];
            corner.normal = unitOr(corner.normal, object.normals[vertices[f][k]]);
        }
    }
    for (std::size_t c = 0; c < count; ++c) {
        corners[c].scale = std::sqrt(corners[c].scale / weights[c]);
        corners[c].along = {(1.0 / weights[c]) * corners[c].along[0], (1.0 / weights[c]) * corners[c].along[1]};
    }
    for (const Facet& facet : facets) {
        const std::array<double, 3> angles = anglesOf(facet);
        std::array<Vec3, 3> heights;
        for (std::size_t k = 0; k < 3; ++k) {
            const AtlasCorner& corner = corners[facet.corners[k]];
            heights[k] = corner.scale * corner.normal;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t c = facet.corners[k];
            add(corners[c].swelling, angles[k] / weights[c], derivatives(facet, heights));
        }
    }
    return corners;
}

}  // namespace

std::vector<Hit> Atlas::at(Vec2 p) const
{
    std::vector<Hit> hits;
    boxes.visit(p, [&](std::uint32_t f) {
        const Facet& facet = facets[f];
        double depth = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 a = facet.flat[k];
            const Vec2 side = facet.flat[(k + 1) % 3] - a;
            depth = std::min(depth, std::copysign(1.0, facet.twice_flat) * cross(side, p - a) / length(side));
        }
        if (!(depth >= -tolerance)) {
            return;
        }
        const auto same = std::find_if(hits.begin(), hits.end(), [&](const Hit& h) { return h.chart == facet.chart; });
        if (same == hits.end()) {
            hits.push_back({0, facet.chart, f, depth});
        } else if (depth > same->depth || (depth == same->depth && f < same->facet)) {
            *same = {0, facet.chart, f, depth};
        }
    });
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.chart < b.chart; });
    return hits;
}

PlacedVertex Atlas::placeVertex(const Facet& facet, Vec2 p, double z, Vec3 normal) const
{
    std::array<double, 3> share{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 a = facet.flat[(k + 1) % 3];
        share[k] = cross(facet.flat[(k + 2) % 3] - a, p - a) / facet.twice_flat;
    }
    Vec3 place;
    Vec3 up;
    std::array<Vec3, 2> along;
    std::array<Vec3, 2> swelling;
    PlacedVertex placed;
    for (std::size_t k = 0; k < 3; ++k) {
        const AtlasCorner& corner = corners[facet.corners[k]];
        place = place + share[k] * corner.place;
        up = up + share[k] * corner.normal;
        placed.scale += share[k] * corner.scale;
        for (std::size_t i = 0; i < 2; ++i) {
            along[i] = along[i] + share[k] * corner.along[i];
            swelling[i] = swelling[i] + share[k] * corner.swelling[i];
        }
    }
    up = unitOr(up, corners[facet.corners[0]].normal);
    const Vec3 rise = placed.scale * up;
    // At the end of a chart the mean of the facets is inclined to the object, so only its tangent part is used.
    const auto tangent = [&](std::size_t i) {
        const Vec3 level = along[i] - dot(along[i], up) * up;
        return level + z * swelling[i];
    };
    const Vec3 a = tangent(0);
    const Vec3 b = tangent(1);
    placed.volume_ratio = dot(cross(a, b), rise);
    placed.position = z == 0.0 ? place : place + z * rise;
    const Vec3 turned = normal.x * cross(b, rise) + normal.y * cross(rise, a) + normal.z * cross(a, b);
    placed.normal = unitOr(std::copysign(1.0, placed.volume_ratio) * turned, std::copysign(1.0, normal.z) * up);
    placed.ground_normal = up;
    return placed;
}

Atlas atlasOf(const TexturedMesh& given, Vec2 extent)
{
    TexturedMesh object = given;
    object.uvs = joinedUvs(given);
    Atlas atlas;
    atlas.facets = facetsOf(object, extent);
    std::vector<std::array<std::uint32_t, 3>> vertices;
    for (const Facet& facet : atlas.facets) {
        vertices.push_back(facet.corners);
    }
    atlas.facing = joinCharts(object, atlas.facets);
    atlas.corners = cornersOf(object, atlas.facets, vertices);
    atlas.tolerance = kTolerance * std::max(extent.x, extent.y);
    atlas.boxes = FacetBoxes(atlas.facets, atlas.tolerance);
    return atlas;
}

}  // namespace droplet
