// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/narrow_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace droplet {
namespace {

PlanarMesh footprintOf(const std::vector<std::vector<Vec2>>& loops)
{
    PlanarMesh mesh;
    mesh.loop_starts = {0};
    for (const std::vector<Vec2>& loop : loops) {
        mesh.vertices.insert(mesh.vertices.end(), loop.begin(), loop.end());
        mesh.loop_starts.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    }
    return mesh;
}

/// Points of a circle; a negative radius is a hole.
std::vector<Vec2> circle(double radius, int count = 720)
{
    std::vector<Vec2> loop;
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        loop.push_back({std::abs(radius) * std::cos(angle), radius * std::sin(angle)});
    }
    return loop;
}

std::vector<Vec2> rectangle(double width, double height)
{
    return {{0, 0}, {width, 0}, {width, height}, {0, height}};
}

TEST(NarrowParts, AreStripsNarrowerThanTheDisc)
{
    EXPECT_NEAR(narrowArea(footprintOf({rectangle(10.0, 0.98)}), 1.0), 9.8, 1e-3);
    EXPECT_EQ(narrowArea(footprintOf({rectangle(10.0, 1.0)}), 1.0), 0.0);
    // A ring 0.9 wide, and one 1.1 wide.
    EXPECT_NEAR(narrowArea(footprintOf({circle(5.0), circle(-4.1)}), 1.0), std::numbers::pi * (5.0 * 5.0 - 4.1 * 4.1),
                1e-3);
    EXPECT_EQ(narrowArea(footprintOf({circle(5.0), circle(-3.9)}), 1.0), 0.0);
}

TEST(NarrowParts, AreNecksBetweenWideParts)
{
    // Squares of 3 with a neck 0.5 wide and 6 long. At its ends a disc enters until it meets the corners, by a segment
    // of 60 degrees.
    const std::vector<Vec2> dumbbell{{0, 0},  {3, 0}, {3, 1.25}, {9, 1.25}, {9, 0}, {12, 0},
                                     {12, 3}, {9, 3}, {9, 1.75}, {3, 1.75}, {3, 3}, {0, 3}};
    const double segment = 0.125 * (std::numbers::pi / 3.0 - std::sqrt(0.75));
    EXPECT_NEAR(narrowArea(footprintOf({dumbbell}), 1.0), 0.5 * 6.0 - 2.0 * segment, 0.01);
}

TEST(NarrowParts, AreNotPointsOfCorners)
{
    EXPECT_EQ(narrowArea(footprintOf({rectangle(10.0, 10.0)}), 1.0), 0.0);
    std::vector<Vec2> star;
    for (int k = 0; k < 10; ++k) {
        const double angle = std::numbers::pi * k / 5.0;
        const double radius = k % 2 == 0 ? 10.0 : 4.0;
        star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    EXPECT_EQ(narrowArea(footprintOf({star}), 1.0), 0.0);
    // A needle: what a disc leaves of a point of angle a is r² (cot(a/2) - (pi - a)/2).
    const std::vector<Vec2> needle{{0, -2}, {40, 0}, {0, 2}};
    const double half = std::atan(2.0 / 40.0);
    const double left = 0.25 * (1.0 / std::tan(half) - (std::numbers::pi / 2.0 - half));
    EXPECT_NEAR(narrowArea(footprintOf({needle}), 1.0), left, 0.05 * left);
}

TEST(NarrowParts, AreSpecksAsAWhole)
{
    EXPECT_NEAR(narrowArea(footprintOf({circle(0.3)}), 1.0), std::numbers::pi * 0.09, 1e-4);
    EXPECT_EQ(narrowArea(footprintOf({circle(0.5)}), 1.0), 0.0);
    // The same at the size of a print.
    EXPECT_NEAR(narrowArea(footprintOf({circle(0.1e-3)}), 0.4e-3), std::numbers::pi * 0.01e-6, 1e-11);
}

}  // namespace
}  // namespace droplet
