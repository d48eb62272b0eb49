// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/round_inward.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "support/domains.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::polygonLoop;
using testing::reversed;

TEST(RoundInward, LeavesFootprintsWithoutInnerCorners)
{
    for (const Domain& domain : {domainOf(ellipseLoop(1, 0.5)), domainOf(polygonLoop({{0, 0}, {1, 0}, {1, 1}})),
                                 domainOf(ellipseLoop(1, 1), {reversed(ellipseLoop(0.5, 0.5))})}) {
        const PlanarMesh mesh = triangulate(domain, {.edge = 0.1}).front();
        EXPECT_FALSE(roundInward(mesh, 0.05, 0.1));
    }
}

TEST(RoundInward, AddsTheCornerBesideAnArc)
{
    const PlanarMesh mesh =
        triangulate(domainOf(polygonLoop({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})), {.edge = 0.03}).front();
    for (const double radius : {0.05, 0.2}) {
        const std::optional<PlanarMesh> rounded = roundInward(mesh, radius, 0.03);
        ASSERT_TRUE(rounded);
        EXPECT_NO_THROW(rounded->validate());
        EXPECT_NEAR(area(*rounded) - 3.0, radius * radius * (1.0 - 0.25 * std::numbers::pi), 0.02 * radius * radius);
    }
}

// Liquid rolls over the arcs: with one or two edges each it had facets there.
TEST(RoundInward, ArcsHaveFourEdges)
{
    const PlanarMesh mesh =
        triangulate(domainOf(polygonLoop({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})), {.edge = 0.04}).front();
    const std::optional<PlanarMesh> rounded = roundInward(mesh, 0.02, 0.04);
    ASSERT_TRUE(rounded);
    const std::size_t count = rounded->rimVertexCount();
    std::size_t turned = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 in = rounded->vertices[i] - rounded->vertices[(i + count - 1) % count];
        const Vec2 out = rounded->vertices[(i + 1) % count] - rounded->vertices[i];
        const double turn = std::atan2(cross(in, out), dot(in, out));
        EXPECT_GT(turn, -0.5);
        turned += turn < -0.1 ? 1 : 0;
    }
    EXPECT_GE(turned, 4U) << "of 90 degrees";
}

TEST(RoundInward, ClosesSlitsAndKeepsHoles)
{
    // A slit of 0.06 from the right, and a hole.
    const Domain domain =
        domainOf(polygonLoop({{0, 0}, {2, 0}, {2, 0.97}, {1.8, 0.97}, {1.8, 1.03}, {2, 1.03}, {2, 2}, {0, 2}}),
                 {reversed(polygonLoop({{0.3, 0.3}, {0.7, 0.3}, {0.7, 0.7}, {0.3, 0.7}}))});
    const PlanarMesh mesh = triangulate(domain, {.edge = 0.05}).front();
    const std::optional<PlanarMesh> rounded = roundInward(mesh, 0.035, 0.05);
    ASSERT_TRUE(rounded);
    EXPECT_EQ(rounded->loopCount(), 2U);
    // What is left of the slit is its round mouth.
    EXPECT_NEAR(area(*rounded), 4.0 - 0.16, 2e-3);
}

// A film of liquid between rim and hole, far thinner than the edges that are left: loops may then touch each other.
TEST(RoundInward, NeverThrowsOnCoarseTriangles)
{
    const auto wavy = [](double inset) {
        std::vector<Vec2> points;
        for (int k = 0; k < 800; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / 800.0;
            const double radius = 1.0 - inset + 0.05 * std::cos(40.0 * angle);
            points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
        }
        return testing::smoothLoop(points);
    };
    for (const double gap : {0.03, 0.01, 0.005}) {
        const PlanarMesh mesh = triangulate(domainOf(wavy(0.0), {reversed(wavy(gap))}), {.edge = 0.05}).front();
        for (const double edge : {0.1, 0.4, 1.6}) {
            for (const double radius : {0.0, 0.5 * edge}) {
                const std::optional<PlanarMesh> rounded = roundInward(mesh, radius, edge);
                if (rounded) {
                    EXPECT_NO_THROW(rounded->validate());
                }
            }
        }
    }
}

}  // namespace
}  // namespace droplet
