// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid2d/wall_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using droplet::FluidScene;
using droplet::GridShape;
using droplet::Vec2;
using droplet::WallDistance;
using droplet::WallField;

Vec2 cornerOf(const GridShape& grid, std::size_t k)
{
    return grid.placeOf(static_cast<double>(k % grid.cornerColumns()), static_cast<double>(k / grid.cornerColumns()));
}

TEST(WallDistance, OfACircleIsThatFromItsRim)
{
    FluidScene scene;
    scene.walls = {{droplet::circle({0.5, 0.5}, 0.3), {}, true}};
    const GridShape grid{0.02, -10, -10, 70, 70};
    const WallField field = WallDistance(scene, grid.cell).at(0.0, grid);
    const double reach = WallDistance::kReach * grid.cell;
    for (std::size_t k = 0; k < grid.corners(); ++k) {
        const double exact = length(cornerOf(grid, k) - Vec2{0.5, 0.5}) - 0.3;
        // The circle has 96 sides.
        EXPECT_NEAR(field.distance[k], std::clamp(exact, -reach, reach), 1e-3);
    }
}

TEST(WallDistance, FollowsAWallThatMovesAndTurns)
{
    FluidScene scene;
    droplet::WallMotion motion;
    motion.amplitude = {0.1, 0.0};
    motion.swing = 0.3;
    motion.pivot = {0.5, 0.5};
    scene.walls = {{droplet::rectangle({0.4, 0.2}, {0.6, 0.8}), motion, true}};
    const WallDistance walls(scene, 0.02);
    const GridShape grid{0.02, 0, 0, 50, 50};
    constexpr double kTime = 1.3;
    constexpr double kLater = 1e-6;
    const WallField now = walls.at(kTime, grid);
    const WallField later = walls.at(kTime + kLater, grid);
    std::size_t met = 0;
    for (std::size_t k = 0; k < grid.corners(); ++k) {
        const std::size_t right = k + 1;
        const std::size_t above = k + grid.cornerColumns();
        if (above >= grid.corners() || std::abs(now.distance[k]) > 0.5 * grid.cell) {
            continue;
        }
        const Vec2 slope =
            (1.0 / grid.cell) * Vec2{now.distance[right] - now.distance[k], now.distance[above] - now.distance[k]};
        if (std::abs(length(slope) - 1.0) > 1e-6) {
            continue;  // at a corner of the wall
        }
        // What the wall's matter goes along the normal, the distance loses.
        const double speed = dot(walls.velocity(now, 0, cornerOf(grid, k) - now.distance[k] * slope), slope);
        EXPECT_NEAR((later.distance[k] - now.distance[k]) / kLater, -speed, 1e-3);
        ++met;
    }
    EXPECT_GT(met, 50U);
}

TEST(WallDistance, HasNoSurfaceBetweenWallsThatAdjoin)
{
    FluidScene scene;
    scene.walls = {{droplet::rectangle({-1.0, -1.0}, {2.0, 0.0}), {}, true},
                   {droplet::rectangle({-1.0, 0.0}, {0.0, 2.0}), {}, true}};
    const GridShape grid{0.1, -4, -4, 10, 10};
    const WallField field = WallDistance(scene, grid.cell).at(0.0, grid);
    for (std::size_t k = 0; k < grid.corners(); ++k) {
        const Vec2 place = cornerOf(grid, k);
        if (place.x < -0.05 && std::abs(place.y) < 0.05 && k % grid.cornerColumns() > 0) {
            EXPECT_LT(field.distance[k], -0.05) << place.x;
        }
    }
}

TEST(WallDistance, TakesThinWallsAsOneCellThick)
{
    FluidScene scene;
    scene.walls = {{droplet::rectangle({-1.0, 0.0}, {2.0, 0.01}), {}, true}};
    const GridShape grid{0.1, 0, -4, 10, 10};
    const WallField field = WallDistance(scene, grid.cell).at(0.0, grid);
    for (std::size_t k = 0; k < grid.corners(); ++k) {
        const double y = cornerOf(grid, k).y;
        const double exact = std::max(y - 0.01, -y) - 0.05;
        EXPECT_NEAR(field.distance[k], std::min(exact, 0.3), 0.011);
    }
}

}  // namespace
