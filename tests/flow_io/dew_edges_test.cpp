// SPDX-License-Identifier: GPL-3.0-or-later
// Droplets on objects with sharp edges: none lies across one, none is in another, and all are as smooth as on a plate.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "droplet/flow/dew.h"
#include "droplet/flow_io/dew_model.h"
#include "droplet/units.h"
#include "flow/footing.h"
#include "support/objects.h"

namespace droplet {
namespace {

struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;

    void addFace(const std::vector<Vec3>& loop)
    {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), loop.begin(), loop.end());
        for (std::uint32_t k = 2; k < loop.size(); ++k) {
            triangles.push_back({first, first + k - 1, first + k});
        }
    }
};

/// Prism over a polygon around the z axis, closed; with 4 sides a box.
Mesh prism(std::uint32_t sides, double radius, double height)
{
    Mesh mesh;
    std::vector<Vec3> lower;
    std::vector<Vec3> upper;
    for (std::uint32_t k = 0; k < sides; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / sides;
        lower.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
        upper.push_back(lower.back() + Vec3{0.0, 0.0, height});
    }
    mesh.addFace(upper);
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t next = (k + 1) % sides;
        mesh.addFace({lower[k], lower[next], upper[next], upper[k]});
    }
    std::reverse(lower.begin(), lower.end());
    mesh.addFace(lower);
    return mesh;
}

/// Horizontal floor and wall of a square step, open at its ends.
Mesh step()
{
    Mesh mesh;
    mesh.addFace({{0.0, 0.0, 0.0}, {0.04, 0.0, 0.0}, {0.04, 0.04, 0.0}, {0.0, 0.04, 0.0}});
    mesh.addFace({{0.0, 0.04, 0.0}, {0.04, 0.04, 0.0}, {0.04, 0.04, 0.04}, {0.0, 0.04, 0.04}});
    return mesh;
}

/// An object with droplets.
struct Wet {
    explicit Wet(const Mesh& mesh, const DewOptions& with = {})
        : terrain(flowSurface(mesh.vertices, mesh.triangles)),
          bodies(BodyShape::Capillary, with.forces),
          options(withExtent(with)),
          dew(dewDroplets(terrain, options)),
          model(terrain, dew.samples, bodies, options.gravity)
    {
    }

    [[nodiscard]] DewOptions withExtent(DewOptions with) const
    {
        with.extent = dewExtents(bodies, with.gravity);
        return with;
    }

    FlowTerrain terrain;
    DropletBodies bodies;
    DewOptions options;
    DewDroplets dew;
    DewModel model;
};

/// Triangles of every droplet.
std::vector<std::vector<Triangle>> dropletsOf(const Surface& surface)
{
    std::vector<std::uint32_t> root(surface.vertices.size());
    std::iota(root.begin(), root.end(), std::uint32_t{0});
    const auto find = [&](std::uint32_t v) {
        while (root[v] != v) {
            v = root[v] = root[root[v]];
        }
        return v;
    };
    for (const auto& [a, b, c] : surface.triangles) {
        const std::uint32_t to = find(surface.weld[a]);
        root[find(surface.weld[b])] = to;
        root[find(surface.weld[c])] = to;
    }
    std::map<std::uint32_t, std::vector<Triangle>> droplets;
    for (const Triangle& t : surface.triangles) {
        droplets[find(surface.weld[t[0]])].push_back(t);
    }
    std::vector<std::vector<Triangle>> all;
    for (auto& [first, triangles] : droplets) {
        all.push_back(std::move(triangles));
    }
    return all;
}

/// Share of the directions from a point that meet triangles from inside (A. Van Oosterom and J. Strackee, 1983).
double winding(const Surface& surface, const std::vector<Triangle>& triangles, Vec3 from)
{
    double angle = 0.0;
    for (const Triangle& t : triangles) {
        const Vec3 a = surface.vertices[t[0]] - from;
        const Vec3 b = surface.vertices[t[1]] - from;
        const Vec3 c = surface.vertices[t[2]] - from;
        const double la = length(a);
        const double lb = length(b);
        const double lc = length(c);
        angle += 2.0 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return angle / (4.0 * std::numbers::pi);
}

struct Box {
    Vec3 low{1e9, 1e9, 1e9};
    Vec3 high{-1e9, -1e9, -1e9};

    [[nodiscard]] bool meets(const Box& b) const
    {
        return low.x < b.high.x && b.low.x < high.x && low.y < b.high.y && b.low.y < high.y && low.z < b.high.z &&
               b.low.z < high.z;
    }
    [[nodiscard]] bool has(Vec3 p) const
    {
        return p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y && p.z > low.z && p.z < high.z;
    }
};

/// Number of droplets with a vertex in another one.
std::size_t overlapsOf(const Surface& surface)
{
    const std::vector<std::vector<Triangle>> droplets = dropletsOf(surface);
    std::vector<Box> boxes(droplets.size());
    for (std::size_t d = 0; d < droplets.size(); ++d) {
        for (const Triangle& t : droplets[d]) {
            for (const std::uint32_t v : t) {
                const Vec3 p = surface.vertices[v];
                Box& box = boxes[d];
                box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
                box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
            }
        }
    }
    std::size_t overlaps = 0;
    for (std::size_t d = 0; d < droplets.size(); ++d) {
        bool overlaps_another = false;
        for (std::size_t e = 0; e < droplets.size() && !overlaps_another; ++e) {
            if (d == e || !boxes[d].meets(boxes[e])) {
                continue;
            }
            for (const Triangle& t : droplets[d]) {
                const Vec3 p = surface.vertices[t[0]];
                if (boxes[e].has(p) && winding(surface, droplets[e], p) > 0.5) {
                    overlaps_another = true;
                    break;
                }
            }
        }
        overlaps += overlaps_another ? 1 : 0;
    }
    return overlaps;
}

/// Largest angle between neighbouring facets [rad]; rims are no neighbours of bases.
double sharpestOf(const Surface& surface)
{
    struct Side {
        std::array<std::uint32_t, 2> edge;
        Vec3 normal;
    };
    std::vector<Side> sides;
    for (const Triangle& t : surface.triangles) {
        const Vec3 area =
            cross(surface.vertices[t[1]] - surface.vertices[t[0]], surface.vertices[t[2]] - surface.vertices[t[0]]);
        const double size = length(area);
        for (std::size_t k = 0; k < 3 && size > 0.0; ++k) {
            const std::uint32_t a = t[k];
            const std::uint32_t b = t[(k + 1) % 3];
            sides.push_back({{std::min(a, b), std::max(a, b)}, (1.0 / size) * area});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.edge < b.edge; });
    double sharpest = 0.0;
    for (std::size_t k = 1; k < sides.size(); ++k) {
        if (sides[k].edge == sides[k - 1].edge) {
            const double turn = std::clamp(dot(sides[k].normal, sides[k - 1].normal), -1.0, 1.0);
            sharpest = std::max(sharpest, std::acos(turn));
        }
    }
    return sharpest;
}

Mesh box()
{
    return prism(4, 0.02, 0.03);
}

Mesh can()
{
    return prism(48, 0.02, 0.04);
}

/// Covers half of an object with droplets that are flat, round and overhanging, and expects that no two overlap.
void expectDropletsApart(const Mesh& mesh)
{
    for (const double angle : {60.0, 105.0, 140.0}) {
        DewOptions options;
        options.coverage = 0.5;
        options.smallest = 0.4e-3;
        options.largest = 2e-3;
        options.forces.wetting.contact_angle = angle * kDegree;
        const Wet wet(mesh, options);
        ASSERT_GT(wet.model.shown().size(), 300U);
        EXPECT_EQ(overlapsOf(wet.model.surface()), 0U) << angle << " of " << wet.model.shown().size();
    }
}

TEST(DewEdges, DropletsOnABoxAndACanAreApart)
{
    for (const Mesh& mesh : {box(), can(), step()}) {
        expectDropletsApart(mesh);
    }
}

Mesh meshOf(const TexturedMesh& from)
{
    return {from.vertices, from.triangles};
}

/// Sphere of 2 cm.
Mesh sphere()
{
    return meshOf(testing::ball(64, [](Vec3) { return 0.02; }));
}

/// As a bunny: bumps and dents whose curvature is as strong as that of large droplets.
Mesh bunny()
{
    return meshOf(testing::ball(160, [](Vec3 n) {
        return 0.02 + 1.5e-3 * std::sin(14.0 * n.x + 1.0) * std::sin(13.0 * n.y) * std::sin(12.0 * n.z + 2.0);
    }));
}

/// Ring of 15 mm about a tube of 6 mm: saddles inside, and a hole.
Mesh torus()
{
    testing::Sheet sheet;
    sheet.columns = 96;
    sheet.rows = 40;
    sheet.place = [](Vec2 uv) {
        const double turn = 2.0 * std::numbers::pi * uv.x;
        const double tilt = -2.0 * std::numbers::pi * uv.y;
        const double away = 0.015 + 6e-3 * std::cos(tilt);
        return Vec3{away * std::cos(turn), away * std::sin(turn), 6e-3 * std::sin(tilt)};
    };
    return meshOf(testing::meshOf(sheet));
}

// Bent droplets lean and stand closer or farther than on a plane.
TEST(DewEdges, DropletsOnCurvedGroundAreApart)
{
    for (const Mesh& mesh : {sphere(), bunny(), torus()}) {
        expectDropletsApart(mesh);
    }
}

// The count finds what overlaps.
TEST(DewEdges, OverlapsAreFound)
{
    DewOptions options;
    options.coverage = 0.2;
    options.smallest = 1e-3;
    options.largest = 2e-3;
    const Wet wet(sphere(), options);
    Surface surface = wet.model.surface();
    ASSERT_EQ(overlapsOf(surface), 0U);
    const Surface once = surface;
    const Vec3 aside = 0.3e-3 * Vec3{0.6, 0.0, 0.8};
    for (std::size_t v = 0; v < once.vertices.size(); ++v) {
        surface.vertices.push_back(once.vertices[v] + aside);
        surface.weld.push_back(once.weld[v] + static_cast<std::uint32_t>(once.vertices.size()));
    }
    for (const auto& [a, b, c] : once.triangles) {
        const auto offset = static_cast<std::uint32_t>(once.vertices.size());
        surface.triangles.push_back({a + offset, b + offset, c + offset});
    }
    EXPECT_GE(overlapsOf(surface), 2 * wet.model.shown().size()) << "each and its copy beside it";
}

/// A square of 6 cm that leans.
Mesh plate(double slope)
{
    const Vec3 along{0.06 * std::cos(slope), 0.0, 0.06 * std::sin(slope)};
    const Vec3 across{0.0, 0.06, 0.0};
    Mesh mesh;
    mesh.addFace({{}, along, along + across, across});
    return mesh;
}

TEST(DewEdges, DropletsAreAsSmoothAsOnPlates)
{
    double smooth = 0.0;
    for (const double slope : {0.0, 90.0, 180.0}) {
        smooth = std::max(smooth, sharpestOf(Wet(plate(slope * kDegree)).model.surface()));
    }
    for (const Mesh& mesh : {box(), can(), step()}) {
        const double sharpest = sharpestOf(Wet(mesh).model.surface());
        EXPECT_LE(sharpest, smooth + 2.0 * kDegree) << sharpest / kDegree << " and " << smooth / kDegree;
    }
}

TEST(DewEdges, ContactLinesDoNotCrossEdges)
{
    const Wet wet(box());
    const double half = 0.02 / std::sqrt(2.0);  // of its sides, which lie at 45° to the axes
    for (const FlowSample& sample : wet.dew.samples) {
        const double contact = capOf(sample.volume, wet.options.forces.wetting.contact_angle).contact_radius;
        const Vec3 p = sample.place;
        const std::array<double, 3> off{half - std::abs(p.x + p.y) / std::sqrt(2.0),
                                        half - std::abs(p.x - p.y) / std::sqrt(2.0), std::min(p.z, 0.03 - p.z)};
        std::array<double, 3> sorted = off;
        std::sort(sorted.begin(), sorted.end());
        EXPECT_NEAR(sorted[0], 0.0, 1e-12) << "on a face";
        EXPECT_GE(sorted[1], 0.92 * contact) << "from the nearest edge";
    }
    EXPECT_NEAR(wet.dew.covered / wet.dew.area, wet.options.coverage, 0.02) << "small ones fill what large ones leave";
}

TEST(DewEdges, FootingFindsEdgesAndTheirSides)
{
    const Mesh mesh = box();
    const FlowTerrain terrain(flowSurface(mesh.vertices, mesh.triangles));
    const double half = 0.02 / std::sqrt(2.0);
    const Vec3 across{std::sqrt(0.5), std::sqrt(0.5), 0.0};  // to the middle of a side
    constexpr double kRadius = 1e-3;
    for (const double away : {0.2, 0.6, 0.9, 0.99, 1.01, 3.0}) {
        const Vec3 place = (half - away * kRadius) * across + Vec3{0.0, 0.0, 0.03};
        const auto found = awayFromEdge(terrain, terrain.nearest(place), kRadius);
        EXPECT_EQ(found.has_value(), away < 0.95) << away;
        if (found) {
            EXPECT_LT(dot(*found - place, across), 0.0) << "back over the top";
            EXPECT_NEAR(found->z, 0.03, 1e-9);
        }
    }
    EXPECT_FALSE(awayFromEdge(terrain, terrain.nearest({0.0, 0.0, 0.05}), 0.013)) << "edges of triangles alone";
    EXPECT_TRUE(awayFromEdge(terrain, terrain.nearest({0.0, 0.0, 0.05}), 0.016)) << "it would hang over four edges";
    const Mesh low = step();
    const FlowTerrain corner(flowSurface(low.vertices, low.triangles));
    EXPECT_TRUE(awayFromEdge(corner, corner.nearest({0.02, 0.0395, 0.0}), kRadius)) << "at the foot of a wall";
    EXPECT_TRUE(awayFromEdge(corner, corner.nearest({0.02, 0.0005, 0.0}), kRadius)) << "at the end of the surface";
    EXPECT_FALSE(awayFromEdge(corner, corner.nearest({0.02, 0.02, 0.0}), kRadius));
}

}  // namespace
}  // namespace droplet
