// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "droplet/error.h"
#include "droplet/surface/surface.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using testing::asOnePart;
using testing::kExtent;
using testing::roundDroplet;
using testing::RoundDroplet;

/// Flat triangles at given places.
Surface flat(const std::vector<Vec2>& places, const std::vector<Triangle>& triangles)
{
    Surface surface;
    for (const Vec2 place : places) {
        surface.weld.push_back(static_cast<std::uint32_t>(surface.vertices.size()));
        surface.vertices.push_back({place.x, place.y, 0.0});
        surface.normals.push_back({0.0, 0.0, 1.0});
        surface.uvs.push_back({place.x / kExtent, place.y / kExtent});
    }
    surface.triangles = triangles;
    return asOnePart(surface);
}

/// Triangles that begin with their lowest vertex, in order.
std::vector<Triangle> sorted(std::vector<Triangle> triangles)
{
    for (Triangle& t : triangles) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

TEST(JoinTriangles, ARingOfSquaresHasNoTriangleLeft)
{
    Surface surface = asOnePart(roundDroplet({.inner = 1e-3, .rings = 6, .segments = 40}));
    const std::vector<Triangle> before = sorted(surface.triangles);
    joinTriangles(surface);
    EXPECT_NO_THROW(surface.validate());
    EXPECT_EQ(2 * surface.parts[0].quads, surface.triangles.size());
    EXPECT_EQ(sorted(surface.triangles), before);
    const std::vector<std::uint32_t> quads = quadrilaterals(surface);
    ASSERT_EQ(quads.size(), surface.parts[0].quads);
    for (std::size_t q = 0; q < quads.size(); ++q) {
        EXPECT_EQ(quads[q], 2 * q);
    }
}

TEST(JoinTriangles, CornersAreBetween30And150Degrees)
{
    for (const RoundDroplet& wish : {RoundDroplet{}, RoundDroplet{.rings = 3, .segments = 7},
                                     RoundDroplet{.inner = 3.6e-3, .rings = 1, .segments = 30}}) {
        Surface surface = asOnePart(roundDroplet(wish));
        joinTriangles(surface);
        EXPECT_NO_THROW(surface.validate());
        EXPECT_GT(surface.parts[0].quads, 0U);
        for (const std::uint32_t t : quadrilaterals(surface)) {
            const auto& [a, b, c] = surface.triangles[t];
            const std::uint32_t corners[4] = {a, b, c, surface.triangles[t + 1][2]};
            double sum = 0.0;
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec3 at = surface.vertices[corners[k]];
                const Vec3 on = surface.vertices[corners[(k + 1) % 4]] - at;
                const Vec3 back = surface.vertices[corners[(k + 3) % 4]] - at;
                // Not flat, a quadrilateral has corners a little smaller than the sums of its halves' angles.
                const double angle = std::atan2(length(cross(on, back)), dot(on, back)) * 180.0 / std::numbers::pi;
                EXPECT_GE(angle, 29.0);
                EXPECT_LE(angle, 150.0 + 1e-9);
                sum += angle;
            }
            EXPECT_NEAR(sum, 360.0, 3.0);  // convex
        }
    }
}

// The best pair is the one in the middle of four: both others would stay alone.
TEST(JoinTriangles, PartnersAreExchangedForMorePairs)
{
    Surface surface =
        flat({{1, 1}, {2, 1}, {2, 2}, {1, 2}, {0, 1.3}, {3, 1.7}}, {{4, 0, 3}, {0, 2, 3}, {0, 1, 2}, {5, 2, 1}});
    joinTriangles(surface);
    EXPECT_NO_THROW(surface.validate());
    EXPECT_EQ(surface.parts[0].quads, 2U);
}

TEST(JoinTriangles, TwoThatMakeNoGoodQuadrilateralStayApart)
{
    // A dart, a corner of 162 degrees (beside one of 118), and two that have no edge in common.
    for (const double tip : {0.2, 0.58, 0.8}) {
        Surface surface = flat({{0, 0}, {1, 0}, {0, 1}, {tip, tip}}, {{0, 1, 3}, {0, 3, 2}});
        joinTriangles(surface);
        EXPECT_EQ(surface.parts[0].quads, tip > 0.6 ? 1U : 0U) << tip;
    }
    Surface apart = flat({{0, 0}, {1, 0}, {0, 1}, {2, 0}, {3, 0}, {2, 1}}, {{0, 1, 2}, {3, 4, 5}});
    joinTriangles(apart);
    EXPECT_EQ(apart.parts[0].quads, 0U);
}

TEST(JoinTriangles, EveryDropletHasItsOwn)
{
    Surface surface = testing::pairOfDroplets();
    joinTriangles(surface);
    EXPECT_NO_THROW(surface.validate());
    for (const SurfacePart& part : surface.parts) {
        EXPECT_GT(static_cast<double>(2 * part.quads), 0.9 * static_cast<double>(part.triangles));
    }
    const std::vector<std::uint32_t> quads = quadrilaterals(surface);
    EXPECT_EQ(quads.size(), surface.parts[0].quads + surface.parts[1].quads);
    EXPECT_TRUE(std::is_sorted(quads.begin(), quads.end()));
    const Surface one = extract(surface, {0});
    EXPECT_NO_THROW(one.validate());
    ASSERT_EQ(one.parts.size(), 1U);
    EXPECT_GT(one.parts[0].quads, 0U);
}

TEST(JoinTriangles, TheSameTrianglesGiveTheSamePairs)
{
    Surface one = testing::pairOfDroplets();
    Surface other = one;
    joinTriangles(one);
    joinTriangles(other);
    EXPECT_EQ(one.triangles, other.triangles);
}

TEST(JoinTriangles, WithoutPartsNothingIsJoined)
{
    Surface surface = roundDroplet();
    const std::vector<Triangle> before = surface.triangles;
    joinTriangles(surface);
    EXPECT_EQ(surface.triangles, before);
    EXPECT_TRUE(quadrilaterals(surface).empty());
}

TEST(Surface, QuadrilateralsHaveTheirHalvesFirst)
{
    Surface surface = asOnePart(roundDroplet({.inner = 1e-3}));
    joinTriangles(surface);
    ASSERT_NO_THROW(surface.validate());
    Surface turned = surface;
    std::rotate(turned.triangles[0].begin(), turned.triangles[0].begin() + 1, turned.triangles[0].end());
    EXPECT_THROW(turned.validate(), Error);
    Surface many = surface;
    many.parts[0].quads = many.triangles.size();
    EXPECT_THROW(many.validate(), Error);
}

}  // namespace
}  // namespace droplet
