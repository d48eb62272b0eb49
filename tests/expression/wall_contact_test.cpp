// SPDX-License-Identifier: GPL-3.0-or-later
#include "expression/wall_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "droplet/expression/expression.h"
#include "droplet/liquid2d/fluid.h"

namespace {

using droplet::ExpressionOptions;
using droplet::FluidScene;
using droplet::LiquidShape;
using droplet::ParticleFrame;
using droplet::Vec2;

constexpr double kSpacing = 0.02;
const Vec2 kSize{1.2, 1.0};

/// Still liquid in a tank of a width of 1.2 m with sloped sides, filled up to a height.
FluidScene tank(double height)
{
    FluidScene scene;
    scene.size = kSize;
    scene.spacing = kSpacing;
    scene.walls = {
        {.region =
             {{{{-0.5, 1.0}, {-0.5, -0.2}, {1.7, -0.2}, {1.7, 1.0}, {1.3, 1.0}, {1.0, 0.0}, {0.2, 0.0}, {-0.1, 1.0}}}},
         .motion = {}}};
    scene.liquid = {{.region = droplet::rectangle({-0.1, 0.0}, {1.3, height})}};
    return scene;
}

LiquidShape shapeOf(const ParticleFrame& frame)
{
    const ExpressionOptions options = droplet::expressionOf(droplet::LiquidStyle::Cartoon);
    return liquidShape(advanceExpression({}, frame, options), frame, options);
}

/// Depth of a place in the tank's walls; negative outside.
double depthInWalls(Vec2 x)
{
    const double slope = std::hypot(1.0, 0.3);
    return std::max({-x.y, (0.2 - 0.3 * x.y - x.x) / slope, (x.x - 1.0 - 0.3 * x.y) / slope});
}

TEST(WallContact, LiquidAtRestLiesOnWallsAndFillsTheirCorners)
{
    const FluidScene scene = tank(0.4);
    droplet::FluidState state = startFluid(scene);
    for (const double time : {0.0, 1.0}) {
        if (time > 0.0) {
            state = advanceFluid(std::move(state), scene, time);
        }
        const LiquidShape shape = shapeOf(frameOf(state, scene));
        ASSERT_EQ(shape.liquid.size(), 1U);
        double top = 0.0;
        double deepest = 0.0;
        double left = 1.0;
        for (const Vec2 x : shape.liquid.front().points) {
            top = std::max(top, x.y);
            deepest = std::max(deepest, depthInWalls(x));
            left = std::min(left, length(x - Vec2{0.2, 0.0}));
            if (x.y < 0.4 - 3.0 * kSpacing) {
                EXPECT_GT(depthInWalls(x), -0.25 * kSpacing) << x.x << " " << x.y << " at " << time;
            }
        }
        EXPECT_LT(deepest, 0.2 * kSpacing);
        EXPECT_LT(left, 0.4 * kSpacing);
        EXPECT_NEAR(top, 0.4, 0.6 * kSpacing);
        const double particles = static_cast<double>(state.position.size()) * kSpacing * kSpacing;
        // Liquid up to the height has a little more: the lattice keeps away from slopes.
        EXPECT_GT(shape.area(), particles) << time;
        EXPECT_LT(shape.area(), 0.4 * (0.8 + 0.3 * 0.4)) << time;
    }
}

TEST(WallContact, SurfacesAwayFromWallsAndThoseOfFilmsStay)
{
    // A film of two particles on the floor.
    const FluidScene scene = tank(2.0 * kSpacing);
    ParticleFrame frame = frameOf(startFluid(scene), scene);
    const LiquidShape with = shapeOf(frame);
    frame.walls.clear();
    const LiquidShape without = shapeOf(frame);
    ASSERT_EQ(with.liquid.size(), 1U);
    ASSERT_EQ(without.liquid.size(), 1U);
    const std::vector<Vec2>& now = with.liquid.front().points;
    const std::vector<Vec2>& before = without.liquid.front().points;
    ASSERT_EQ(now.size(), before.size());
    std::size_t upper = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (before[i].y > 1.3 * kSpacing && before[i].x > 0.3 && before[i].x < 0.9) {
            EXPECT_EQ(now[i], before[i]);
            ++upper;
        }
    }
    EXPECT_GT(upper, 30U);
    // Liquid far from all walls.
    frame = frameOf(startFluid(tank(0.2)), scene);
    for (Vec2& x : frame.position) {
        x.y += 0.3;
    }
    const double area = shapeOf(frame).area();
    frame.walls = {droplet::rectangle({0.0, -0.4}, {1.2, 0.2})};
    EXPECT_EQ(shapeOf(frame).area(), area);
}

}  // namespace
