// SPDX-License-Identifier: GPL-3.0-or-later
#include "expression/grid_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "liquid2d/region.h"

namespace {

using droplet::GridField;
using droplet::Loop;
using droplet::Region;
using droplet::Vec2;

/// From 0 outside to 1 inside, over two cells of a hundredth to either side of the rim.
double ramp(double distance)
{
    return std::clamp(0.5 + distance / 0.04, 0.0, 1.0);
}

TEST(GridField, FillClosesSlitsAndHolesAndMovesNoStraightEdge)
{
    constexpr double kWidth = 0.1;
    const auto area_with = [](const Region& region) {
        GridField field({-1.0, -1.0}, {1.0, 1.0}, 0.01);
        field.add(region, ramp);
        field.fill(kWidth);
        double area = 0.0;
        for (const Loop& loop : field.loops(0.5, 0.0)) {
            area += droplet::signedArea(loop);
        }
        return area;
    };
    const auto halves = [](double gap) {
        Region region = droplet::rectangle({-0.8, -0.8}, {-0.5 * gap, 0.8});
        region.loops.push_back(droplet::rectangle({0.5 * gap, -0.8}, {0.8, 0.8}).loops[0]);
        return region;
    };
    const double whole = 1.6 * 1.6;
    // Corners are as they were, and slits are filled but for their ends, or left alone.
    EXPECT_NEAR(area_with(droplet::rectangle({-0.8, -0.8}, {0.8, 0.8})), whole, 0.005 * whole);
    EXPECT_NEAR(area_with(halves(0.5 * kWidth)), whole, 0.01 * whole);
    EXPECT_NEAR(area_with(halves(3.0 * kWidth)), whole - 1.6 * 3.0 * kWidth, 0.01 * whole);
    const auto hole = [&](double radius) {
        Region region = droplet::rectangle({-0.8, -0.8}, {0.8, 0.8});
        region.loops.push_back(droplet::circle({0.0, 0.0}, radius).loops[0]);
        return area_with(droplet::rectangle({-0.8, -0.8}, {0.8, 0.8})) - area_with(region);
    };
    EXPECT_NEAR(hole(0.9 * kWidth), 0.0, 1e-4);
    EXPECT_NEAR(hole(3.0 * kWidth), std::numbers::pi * 9.0 * kWidth * kWidth, 0.1 * 9.0 * kWidth * kWidth);
    // It closes without a jump.
    double before = hole(1.8 * kWidth);
    for (int step = 35; step > 18; --step) {
        const double part = 0.05 * step;
        const double now = hole(part * kWidth);
        EXPECT_LE(now, before + 1e-6) << part;
        EXPECT_GT(now, before - 0.7 * kWidth * kWidth) << part;
        before = now;
    }
}

TEST(GridField, LoopsOfARegionAreItsRim)
{
    Region ring = droplet::circle({0.5, 0.5}, 0.3);
    ring.loops.push_back(droplet::circle({0.5, 0.5}, 0.1).loops[0]);
    GridField field({-0.2, -0.2}, {1.2, 1.2}, 0.01);
    field.add(ring, ramp);
    const std::vector<Loop> loops = field.loops(0.5, 0.0);
    ASSERT_EQ(loops.size(), 2U);
    double area = 0.0;
    for (const Loop& loop : loops) {
        area += droplet::signedArea(loop);
    }
    EXPECT_NEAR(area, std::numbers::pi * (0.09 - 0.01), 1e-4);
}

TEST(GridField, ParticlesOnALatticeCoverTheirArea)
{
    const double spacing = 0.02;
    const std::vector<Vec2> points = droplet::latticeIn(droplet::circle({0.5, 0.5}, 0.4), spacing);
    GridField field({0.0, 0.0}, {1.0, 1.0}, 0.5 * spacing);
    field.add({points, spacing * spacing, 2.2 * spacing}, 1.0);
    const double area = static_cast<double>(points.size()) * spacing * spacing;
    const std::vector<Loop> loops = field.loops(0.5, 0.0);
    ASSERT_EQ(loops.size(), 1U);
    EXPECT_NEAR(droplet::signedArea(loops[0]) / area, 1.0, 0.02);
    const std::vector<Loop> exact = field.loopsOfArea(area, 0.0);
    ASSERT_EQ(exact.size(), 1U);
    EXPECT_NEAR(droplet::signedArea(exact[0]) / area, 1.0, 1e-5);
}

TEST(GridField, DistancesFromACircleAreThoseFromItsMiddle)
{
    const Vec2 middle{0.4, 0.3};
    GridField field({-0.5, -0.5}, {1.5, 1.0}, 0.02);
    field.add(droplet::circle(middle, 0.2), [](double distance) { return distance; });
    for (const Vec2 place : {Vec2{0.4, 0.3}, Vec2{0.55, 0.3}, Vec2{0.7, 0.7}, Vec2{1.4, 0.9}, Vec2{-0.4, -0.4}}) {
        EXPECT_NEAR(field.at(place), 0.2 - droplet::length(place - middle), 0.02) << place.x;
    }
}

TEST(GridField, ARegionWithoutLoopsIsFarAway)
{
    GridField field({0.0, 0.0}, {1.0, 1.0}, 0.1);
    field.add(Region{}, [](double distance) { return distance; });
    EXPECT_LT(field.at({0.5, 0.5}), -1.0);
}

}  // namespace
