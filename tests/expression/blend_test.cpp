// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/expression/blend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "droplet/error.h"
#include "liquid2d/region.h"
#include "support/loops.h"

namespace {

using droplet::blended;
using droplet::BlendOptions;
using droplet::LiquidShape;
using droplet::Loop;
using droplet::Vec2;
using droplet::testing::pointsOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kSpacing = 0.02;

BlendOptions weightOf(double weight)
{
    BlendOptions options;
    options.weight = weight;
    options.spacing = kSpacing;
    return options;
}

Loop disc(Vec2 middle, double radius)
{
    std::vector<Vec2> points = droplet::circle(middle, radius).loops[0];
    return {points, std::vector<std::uint8_t>(points.size(), 0)};
}

Loop hole(Vec2 middle, double radius)
{
    Loop loop = disc(middle, radius);
    std::reverse(loop.points.begin(), loop.points.end());
    return loop;
}

LiquidShape liquidOf(std::vector<Loop> loops)
{
    LiquidShape shape;
    shape.liquid = std::move(loops);
    return shape;
}

LiquidShape dropletsOf(std::vector<Loop> loops)
{
    LiquidShape shape;
    shape.droplets = std::move(loops);
    return shape;
}

/// Greatest distance of a loop's points from a circle.
double departure(const Loop& loop, Vec2 middle, double radius)
{
    double most = 0.0;
    for (const Vec2 p : loop.points) {
        most = std::max(most, std::abs(droplet::length(p - middle) - radius));
    }
    return most;
}

TEST(Blend, EndsAreTheTwoShapes)
{
    LiquidShape from = liquidOf({disc({0.3, 0.3}, 0.2)});
    from.droplets = {disc({0.8, 0.8}, 0.02)};
    const LiquidShape to = liquidOf({disc({1.3, 0.4}, 0.3)});
    EXPECT_EQ(pointsOf(blended(from, to, weightOf(0.0)).liquid), pointsOf(from.liquid));
    EXPECT_EQ(pointsOf(blended(from, to, weightOf(0.0)).droplets), pointsOf(from.droplets));
    EXPECT_EQ(pointsOf(blended(from, to, weightOf(1.0)).liquid), pointsOf(to.liquid));
    EXPECT_TRUE(blended(from, to, weightOf(1.0)).droplets.empty());
}

TEST(Blend, NearTheEndsShapesAreAlmostThese)
{
    const LiquidShape from = liquidOf({disc({0.3, 0.3}, 0.2)});
    const LiquidShape to = liquidOf({disc({0.4, 0.3}, 0.2)});
    const LiquidShape first = blended(from, to, weightOf(1e-3));
    const LiquidShape last = blended(from, to, weightOf(1.0 - 1e-3));
    ASSERT_EQ(first.liquid.size(), 1U);
    ASSERT_EQ(last.liquid.size(), 1U);
    EXPECT_LT(departure(first.liquid[0], {0.3, 0.3}, 0.2), 0.05 * kSpacing);
    EXPECT_LT(departure(last.liquid[0], {0.4, 0.3}, 0.2), 0.05 * kSpacing);
}

TEST(Blend, StillLiquidStaysAsItIs)
{
    LiquidShape shape = liquidOf({disc({0.5, 0.5}, 0.3), hole({0.5, 0.5}, 0.1)});
    shape.foam = {shape.liquid[1]};
    shape.droplets = {disc({1.2, 0.5}, 0.03)};
    const LiquidShape middle = blended(shape, shape, weightOf(0.5));
    ASSERT_EQ(middle.liquid.size(), 2U);
    for (const Loop& loop : middle.liquid) {
        EXPECT_LT(departure(loop, {0.5, 0.5}, droplet::signedArea(loop) > 0.0 ? 0.3 : 0.1), 0.05 * kSpacing);
    }
    ASSERT_EQ(middle.foam.size(), 1U);
    EXPECT_LT(departure(middle.foam[0], {0.5, 0.5}, 0.1), 0.05 * kSpacing);
    ASSERT_EQ(middle.droplets.size(), 1U);
    EXPECT_NEAR(departure(middle.droplets[0], {1.2, 0.5}, 0.03), departure(shape.droplets[0], {1.2, 0.5}, 0.03), 1e-9);
}

TEST(Blend, AreaGoesFromOneToTheOther)
{
    LiquidShape from = liquidOf({disc({0.3, 0.3}, 0.2), disc({1.4, 0.4}, 0.1)});
    from.droplets = {disc({2.0, 0.8}, 0.03)};
    LiquidShape to = liquidOf({disc({0.7, 0.4}, 0.3)});
    to.droplets = {disc({2.0, 0.5}, 0.02), disc({0.0, 1.0}, 0.02)};
    for (const double weight : {0.01, 0.2, 0.4, 0.5, 0.6, 0.8, 0.99}) {
        const double area = std::lerp(from.area(), to.area(), weight);
        EXPECT_NEAR(blended(from, to, weightOf(weight)).area() / area, 1.0, 1e-3) << weight;
    }
}

// A body that has nothing near it in the other shape does not vanish at once.
TEST(Blend, ABodyThatIsInOneShapeAloneShrinks)
{
    const Vec2 middle{2.0, 0.5};
    const LiquidShape from = liquidOf({disc({0.4, 0.5}, 0.3), disc(middle, 0.15)});
    const LiquidShape to = liquidOf({disc({0.4, 0.5}, 0.3)});
    double before = std::numbers::pi * 0.15 * 0.15;
    double most = 0.0;
    for (int step = 1; step <= 24; ++step) {
        double area = 0.0;
        for (const Loop& loop : blended(from, to, weightOf(step / 24.0)).liquid) {
            if (loop.points[0].x > 1.2) {
                area += droplet::signedArea(loop);
            }
        }
        EXPECT_LE(area, 1.01 * before) << step;
        most = std::max(most, before - area);
        before = area;
    }
    EXPECT_EQ(before, 0.0);
    EXPECT_LT(most, 0.3 * std::numbers::pi * 0.15 * 0.15);
}

TEST(Blend, ADropletUnderLiquidIsTakenUp)
{
    const LiquidShape from = dropletsOf({disc({0.5, 0.5}, 0.03)});
    const LiquidShape to = liquidOf({disc({0.5, 0.5}, 0.3)});
    EXPECT_EQ(blended(from, to, weightOf(0.1)).droplets.size(), 1U);
    EXPECT_TRUE(blended(from, to, weightOf(0.9)).droplets.empty());
}

TEST(Blend, FoamOfOneShapeStaysFoam)
{
    LiquidShape from = liquidOf({disc({0.5, 0.5}, 0.3), hole({0.5, 0.5}, 0.1)});
    const LiquidShape to = liquidOf({disc({0.5, 0.5}, 0.3)});
    ASSERT_EQ(blended(from, to, weightOf(0.1)).liquid.size(), 2U);
    EXPECT_TRUE(blended(from, to, weightOf(0.1)).foam.empty());
    from.foam = {from.liquid[1]};
    EXPECT_EQ(blended(from, to, weightOf(0.1)).foam.size(), 1U);
}

TEST(Blend, NothingStaysNothing)
{
    const LiquidShape nothing;
    EXPECT_TRUE(blended(nothing, nothing, weightOf(0.5)).liquid.empty());
    // Liquid that comes from nowhere grows.
    const LiquidShape to = liquidOf({disc({0.5, 0.5}, 0.3)});
    EXPECT_NEAR(blended(nothing, to, weightOf(0.25)).area() / to.area(), 0.25, 1e-3);
}

TEST(Blend, RefusesWeightsAndSizesOutOfRange)
{
    const LiquidShape shape = liquidOf({disc({0.5, 0.5}, 0.3)});
    EXPECT_THAT([&] { blended(shape, shape, weightOf(1.5)); }, ThrowsMessage<droplet::Error>(HasSubstr("weight")));
    BlendOptions options;
    options.spacing = 0.0;
    EXPECT_THAT([&] { blended(shape, shape, options); }, ThrowsMessage<droplet::Error>(HasSubstr("spacing")));
}

}  // namespace
