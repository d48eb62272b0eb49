// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/expression/expression.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "droplet/error.h"
#include "droplet/liquid2d/fluid.h"
#include "expression/drops.h"
#include "expression/field.h"
#include "expression/isoline.h"

namespace {

using droplet::advanceExpression;
using droplet::Error;
using droplet::expressionOf;
using droplet::ExpressionOptions;
using droplet::ExpressionState;
using droplet::LiquidShape;
using droplet::liquidShape;
using droplet::LiquidStyle;
using droplet::ParticleFrame;
using droplet::Vec2;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kSpacing = 0.1;

ParticleFrame frameOf(double time, const std::vector<Vec2>& position, Vec2 velocity = {})
{
    ParticleFrame frame{time, kSpacing, position, {}, {}, {}};
    frame.velocity.assign(position.size(), velocity);
    for (std::uint32_t i = 0; i < position.size(); ++i) {
        frame.id.push_back(i);
    }
    return frame;
}

/// The `count` points of the hexagonal lattice, one per spacing², that are nearest to the origin.
std::vector<Vec2> cluster(std::size_t count)
{
    const double step = kSpacing * std::sqrt(2.0 / std::sqrt(3.0));
    std::vector<Vec2> points;
    for (int row = -60; row <= 60; ++row) {
        for (int column = -90; column <= 90; ++column) {
            points.push_back({step * (column + 0.5 * row), step * 0.5 * std::sqrt(3.0) * row});
        }
    }
    std::sort(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return dot(a, a) < dot(b, b); });
    points.resize(count);
    return points;
}

LiquidShape shapeOf(const ParticleFrame& frame, const ExpressionOptions& options)
{
    return liquidShape(advanceExpression({}, frame, options), frame, options);
}

double areaOf(std::size_t particles)
{
    return static_cast<double>(particles) * kSpacing * kSpacing;
}

TEST(Expression, ClustersHaveTheAreaOfTheirParticles)
{
    ExpressionOptions fine;
    fine.resolution = 0.2;
    EXPECT_NEAR(shapeOf(frameOf(0.0, cluster(1)), fine).area(), areaOf(1), 0.02 * areaOf(1));
    for (const std::size_t count : {2U, 3U, 7U, 19U, 61U, 2000U}) {
        const LiquidShape shape = shapeOf(frameOf(0.0, cluster(count)), {});
        EXPECT_NEAR(shape.area(), areaOf(count), 0.05 * areaOf(count)) << count;
        EXPECT_EQ(shape.liquid.size() + shape.droplets.size(), 1U) << count;
    }
    EXPECT_NEAR(shapeOf(frameOf(0.0, cluster(5000)), {}).area(), areaOf(5000), 0.01 * areaOf(5000));
}

TEST(Expression, DiscsInRingsAreRound)
{
    for (const double radius : {0.35, 0.6, 1.3, 2.2}) {
        droplet::FluidScene scene;
        scene.spacing = kSpacing;
        scene.size = {6.0, 6.0};
        const Vec2 middle{3.0, 3.0};
        scene.liquid = {{.region = droplet::circle(middle, radius), .rings = true}};
        const droplet::FluidState state = droplet::startFluid(scene);
        EXPECT_NEAR(areaOf(state.position.size()), std::numbers::pi * radius * radius, 2.0 * areaOf(1)) << radius;
        const LiquidShape shape = shapeOf(droplet::frameOf(state, scene), {});
        ASSERT_EQ(shape.liquid.size() + shape.droplets.size(), 1U) << radius;
        const double round = std::sqrt(shape.area() / std::numbers::pi);
        for (const auto* loops : {&shape.liquid, &shape.droplets}) {
            for (const auto& loop : *loops) {
                for (const Vec2 p : loop.points) {
                    EXPECT_NEAR(length(p - middle), round, 0.03 * kSpacing) << radius;
                }
            }
        }
    }
}

TEST(Expression, DropletsAtRestAreRoundAndHaveTheirArea)
{
    for (const LiquidStyle style : {LiquidStyle::Cartoon, LiquidStyle::Wave, LiquidStyle::Paper}) {
        const ExpressionOptions options = expressionOf(style);
        for (const std::size_t count : {1U, 2U, 3U, 5U, 7U, 10U, 19U, 37U, 55U}) {
            const ParticleFrame frame = frameOf(0.0, cluster(count));
            const LiquidShape shape = shapeOf(frame, options);
            ASSERT_EQ(shape.droplets.size(), 1U) << count;
            EXPECT_NEAR(shape.area(), areaOf(count), 0.02 * areaOf(count)) << count;
            if (count == 1 || count == 7 || count == 19 || count == 37) {
                // These clusters have six-fold symmetry: a circle, without corners.
                const double radius = std::sqrt(areaOf(count) / std::numbers::pi);
                for (const Vec2 x : shape.droplets[0].points) {
                    EXPECT_NEAR(length(x), radius, 0.02 * radius) << count;
                }
            }
        }
    }
}

TEST(Expression, RowThatTearsOffKeepsItsFormAndBecomesRound)
{
    std::vector<Vec2> row;
    for (int k = 0; k < 6; ++k) {
        row.push_back({0.0, kSpacing * k});
    }
    const ExpressionOptions options = expressionOf(LiquidStyle::Cartoon);
    const auto lengthOf = [](const LiquidShape& shape) {
        double lower = 1e9;
        double upper = -1e9;
        for (const Vec2 x : shape.droplets.at(0).points) {
            lower = std::min(lower, x.y);
            upper = std::max(upper, x.y);
        }
        return upper - lower;
    };
    ExpressionState state;
    double before = 0.0;
    for (int k = 0; k <= 10; ++k) {
        const ParticleFrame frame = frameOf(k / 24.0, row);
        state = advanceExpression(std::move(state), frame, options);
        const LiquidShape shape = liquidShape(state, frame, options);
        EXPECT_NEAR(shape.area(), areaOf(6), 1e-6 * areaOf(6));
        const double now = lengthOf(shape);
        if (k == 0) {
            EXPECT_NEAR(now, 6.0 * kSpacing, 1.2 * kSpacing);
        } else {
            EXPECT_LE(now, before + 1e-9);
            EXPECT_LT(before - now, 1.2 * kSpacing);
        }
        before = now;
    }
    EXPECT_NEAR(before, 2.0 * std::sqrt(areaOf(6) / std::numbers::pi), 1e-3);
}

TEST(Expression, TeardropsHaveTheirAreaAndNoKink)
{
    for (const double slope : {0.2, 0.7, 1.2}) {
        for (const double length : {0.5, 1.0, 1.2, 2.0, 5.0, 20.0}) {
            const droplet::Teardrop drop = droplet::teardropOf(1.0, length, slope);
            EXPECT_NEAR(drop.area(), std::numbers::pi, 1e-6) << slope << " " << length;
            constexpr int kSteps = 20000;
            const double step = (std::max(drop.length, drop.head) + drop.head) / kSteps;
            double area = 0.0;
            double bend = 0.0;
            for (int k = 0; k < kSteps; ++k) {
                const double x = -drop.head + step * (k + 0.5);
                area += 2.0 * step * drop.halfWidth(x);
                const bool is_middle = k > kSteps / 20 && k < kSteps - kSteps / 20;
                if (is_middle) {
                    const double change = drop.halfWidth(x + step) - 2.0 * drop.halfWidth(x) + drop.halfWidth(x - step);
                    bend = std::max(bend, std::abs(change) / step);
                }
            }
            EXPECT_NEAR(area, std::numbers::pi, 2e-3) << slope << " " << length;
            EXPECT_LT(bend, 0.05) << slope << " " << length;
        }
    }
    // A cone: the disc and its tangents to a point, r²(π − acos(r/L)) + r√(L² − r²).
    const double cone_slope = 0.7 + 0.5 * std::log(0.5) / std::log(10.0 / 3.0);
    const droplet::Teardrop cone = droplet::teardropOf(1.0, 4.0, cone_slope);
    EXPECT_NEAR(cone.exponent, 1.0, 1e-12);
    EXPECT_NEAR(cone.head, 0.625, 0.001);
}

TEST(Expression, SlopesOfTailsAreToldApart)
{
    // Half of the way to the tip, the width over that of the head.
    const auto share = [](double slope) {
        const droplet::Teardrop drop = droplet::teardropOf(1.0, 5.0, slope);
        return drop.halfWidth(0.5 * drop.length) / drop.head;
    };
    EXPECT_GT(share(0.2), 0.6);
    EXPECT_LT(share(0.7), 0.35);
    EXPECT_GT(share(0.7), 0.2);
    EXPECT_LT(share(1.2), 0.05);
    // A thin tail leaves a large head, a thick one takes half of its width.
    EXPECT_LT(droplet::teardropOf(1.0, 5.0, 0.2).head, 0.6);
    EXPECT_GT(droplet::teardropOf(1.0, 5.0, 1.2).head, 0.85);
}

/// Particles that fly to the right for a second.
ExpressionState flown(const std::vector<Vec2>& position, double speed, const ExpressionOptions& options,
                      ParticleFrame& last)
{
    ExpressionState state;
    for (int k = 0; k <= 24; ++k) {
        std::vector<Vec2> now = position;
        for (Vec2& x : now) {
            x.x += speed * k / 24.0;
        }
        last = frameOf(k / 24.0, now, {speed, 0.0});
        state = advanceExpression(std::move(state), last, options);
    }
    return state;
}

TEST(Expression, TailsKeepTheAreaOfTheirDroplets)
{
    for (const double slope : {0.2, 0.7, 1.2}) {
        for (const std::size_t count : {1U, 7U, 19U, 37U}) {
            ExpressionOptions options = expressionOf(LiquidStyle::Cartoon);
            options.tail_slope = slope;
            ParticleFrame frame;
            const ExpressionState state = flown(cluster(count), 2.0, options, frame);
            const LiquidShape shape = liquidShape(state, frame, options);
            ASSERT_EQ(shape.droplets.size(), 1U);
            EXPECT_NEAR(shape.area(), areaOf(count), 1e-6 * areaOf(count)) << slope << count;
            // The tail points backwards, as long as the way of a quarter of a second allows.
            const auto [left, right] =
                std::minmax_element(shape.droplets[0].points.begin(), shape.droplets[0].points.end(),
                                    [](Vec2 a, Vec2 b) { return a.x < b.x; });
            const double radius = std::sqrt(areaOf(count) / std::numbers::pi);
            EXPECT_NEAR(2.0 - left->x, std::min(0.5, 5.0 * radius), 0.05) << slope << count;
            EXPECT_GT(right->x, 2.0 + 0.4 * radius);
            EXPECT_NEAR(left->y, 0.0, 0.02);
        }
    }
}

TEST(Expression, TailsEndBeforeOtherLiquid)
{
    // A droplet leaves a block: its tail grows in the gap between.
    const ExpressionOptions options = expressionOf(LiquidStyle::Cartoon);
    const std::vector<Vec2> block = cluster(2000);
    const double rim = std::sqrt(areaOf(2000) / std::numbers::pi);
    ExpressionState state;
    double longest = 0.0;
    for (int k = 0; k <= 12; ++k) {
        std::vector<Vec2> now = block;
        now.push_back({rim + 0.3 * k, 0.0});
        const ParticleFrame frame = frameOf(k / 24.0, now);
        state = advanceExpression(std::move(state), frame, options);
        const LiquidShape shape = liquidShape(state, frame, options);
        for (const droplet::Loop& drop : shape.droplets) {
            double left = 1e9;
            double right = -1e9;
            for (const Vec2 x : drop.points) {
                left = std::min(left, x.x);
                right = std::max(right, x.x);
            }
            EXPECT_GT(left, rim) << k;
            longest = std::max(longest, right - left);
        }
    }
    EXPECT_GT(longest, 3.0 * kSpacing);
}

TEST(Expression, OneTipForADropletOfManyParticles)
{
    const ExpressionOptions options = expressionOf(LiquidStyle::Cartoon);
    ParticleFrame frame;
    const ExpressionState state = flown(cluster(37), 3.0, options, frame);
    const LiquidShape shape = liquidShape(state, frame, options);
    ASSERT_EQ(shape.droplets.size(), 1U);
    // A vertical line through the tail crosses the outline twice.
    double left = 1e9;
    for (const Vec2 x : shape.droplets[0].points) {
        left = std::min(left, x.x);
    }
    int crossings = 0;
    const auto& points = shape.droplets[0].points;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const double a = points[k].x - left - 0.15;
        const double b = points[(k + 1) % points.size()].x - left - 0.15;
        crossings += (a > 0.0) != (b > 0.0) ? 1 : 0;
    }
    EXPECT_EQ(crossings, 2);
}

TEST(Expression, EraserStaysBelowTheSurfaceAndIsNegativeInTheMiddle)
{
    EXPECT_DOUBLE_EQ(droplet::eraser(0.0, 1.0, 1.5), -1.0);
    EXPECT_DOUBLE_EQ(droplet::eraser(1.5, 1.0, 1.5), 0.0);
    for (int k = 0; k <= 200; ++k) {
        EXPECT_LT(droplet::eraser(0.01 * k, 1.0, 1.5), droplet::kIso);
    }
    // A single particle that holds air is no water.
    ExpressionOptions options = expressionOf(LiquidStyle::Paper);
    const ParticleFrame frame = frameOf(0.0, {{0.0, 0.0}});
    ExpressionState state = advanceExpression({}, frame, options);
    state.air[0] = 1.0;
    EXPECT_EQ(liquidShape(state, frame, options).area(), 0.0);
    // Within liquid it makes a hole, and the hole is foam.
    const ParticleFrame bulk = frameOf(0.0, cluster(400));
    state = advanceExpression({}, bulk, options);
    state.air[0] = 9.0;
    const LiquidShape shape = liquidShape(state, bulk, options);
    ASSERT_EQ(shape.foam.size(), 1U);
    // The water around reaches into the air: it is less than the eraser holds.
    EXPECT_GT(-signedArea(shape.foam[0]), areaOf(1));
    EXPECT_LT(-signedArea(shape.foam[0]), areaOf(9));
}

/// A block of liquid that moves to the right: air enters at its front alone, or, as in the paper, anywhere.
TEST(Expression, AirEntersAtTheFrontOfAWave)
{
    ExpressionOptions options = expressionOf(LiquidStyle::Paper);
    options.eraser_share = 1.0;
    const auto aeration = [&](bool gate) {
        options.crest_gate = gate;
        ParticleFrame frame = frameOf(0.0, cluster(1500), {5.0, 0.0});
        for (std::size_t i = 0; i < frame.velocity.size(); ++i) {
            // Disorder, which the paper's criterion takes for air.
            frame.velocity[i].y = 2.0 * std::sin(37.0 * static_cast<double>(i));
        }
        ExpressionState state = advanceExpression({}, frame, options);
        frame.time = 0.04;
        state = advanceExpression(std::move(state), frame, options);
        double front = 0.0;
        double back = 0.0;
        for (std::size_t i = 0; i < frame.position.size(); ++i) {
            (frame.position[i].x > 0.0 ? front : back) += state.air[i];
        }
        return std::pair{front, back};
    };
    const auto [front, back] = aeration(true);
    EXPECT_GT(front, 1.0);
    EXPECT_LT(back, 0.01 * front);
    const auto [paper_front, paper_back] = aeration(false);
    EXPECT_GT(paper_back, 0.3 * paper_front);
}

/// A step of liquid that moves to the right, with a flat top and a vertical front.
ParticleFrame stepOfLiquid(double time, double speed)
{
    std::vector<Vec2> position;
    for (int row = 0; row < 30; ++row) {
        for (int column = 0; column < 60; ++column) {
            position.push_back({kSpacing * (column + 0.5) + speed * time, kSpacing * (row + 0.5)});
        }
    }
    return frameOf(time, position, {speed, 0.0});
}

TEST(Expression, ClawsGrowAtTheCrestAndCurlForward)
{
    const ExpressionOptions options = expressionOf(LiquidStyle::Wave);
    ExpressionOptions plain = options;
    plain.claws = 0.0;
    for (const double speed : {4.0, -4.0}) {
        ExpressionState state;
        double ahead = 0.0;
        double largest = 0.0;
        for (int k = 0; k <= 12; ++k) {
            ParticleFrame frame = stepOfLiquid(k / 24.0, speed);
            state = advanceExpression(std::move(state), frame, options);
            const LiquidShape with = liquidShape(state, frame, options);
            const LiquidShape without = liquidShape(state, frame, plain);
            const auto reach = [&](const LiquidShape& shape) {
                double farthest = -1e9;
                for (const Vec2 x : shape.liquid.at(0).points) {
                    farthest = std::max(farthest, (speed > 0.0 ? x.x : -x.x));
                }
                return farthest;
            };
            const double grown = reach(with) - reach(without);
            EXPECT_LT(std::abs(grown - ahead), 6.0 * kSpacing) << k;
            ahead = grown;
            largest = std::max(largest, grown);
        }
        // It reaches ahead by several particles, and no farther than its length.
        EXPECT_GT(largest, 3.0 * kSpacing) << speed;
        EXPECT_LT(largest, options.claws * kSpacing) << speed;
    }
    // Liquid at rest has none.
    ExpressionState state;
    for (int k = 0; k <= 12; ++k) {
        state = advanceExpression(std::move(state), stepOfLiquid(k / 24.0, 0.0), options);
    }
    EXPECT_THAT(state.curl, testing::Each(0.0));
}

// Particles that came down from the crest would draw claws that lie in the liquid, and show as nicks.
TEST(Expression, NoClawsOnTheHollowFaceBelowACrest)
{
    const ExpressionOptions options = expressionOf(LiquidStyle::Wave);
    constexpr double kSpeed = 4.0;
    const Vec2 middle{60.0 * kSpacing, 30.0 * kSpacing};
    const auto frame_at = [&](double time) {
        std::vector<Vec2> position;
        for (int row = 0; row < 60; ++row) {
            for (int column = 0; column < 60; ++column) {
                const Vec2 p{kSpacing * (column + 0.5), kSpacing * (row + 0.5)};
                if (length(p - middle) > 15.0 * kSpacing) {
                    position.push_back({p.x + kSpeed * time, p.y});
                }
            }
        }
        return frameOf(time, position, {kSpeed, 0.0});
    };
    ExpressionState state;
    ParticleFrame frame;
    for (int k = 0; k <= 4; ++k) {
        frame = frame_at(k / 24.0);
        state = advanceExpression(std::move(state), frame, options);
    }
    // Claws of all surface particles between two heights, fully grown.
    const auto drawn = [&](double lower, double upper) {
        const Vec2 moved = middle + Vec2{kSpeed * frame.time, 0.0};
        std::fill(state.curl.begin(), state.curl.end(), 0.0);
        for (std::size_t i = 0; i < frame.position.size(); ++i) {
            const Vec2 p = frame.position[i];
            const bool is_surface = length(p - moved) < 16.0 * kSpacing || p.y > 59.0 * kSpacing;
            if (is_surface && p.y > lower * kSpacing && p.y < upper * kSpacing) {
                state.curl[frame.id[i]] = 1.0;
            }
        }
        return liquidShape(state, frame, options).liquid.at(0).points;
    };
    const std::vector<Vec2> without = drawn(0.0, 0.0);
    EXPECT_EQ(drawn(22.0, 38.0), without);
    EXPECT_NE(drawn(59.0, 60.0), without) << "the crest has some";
}

TEST(Expression, OutlineDoesNotPopWhenADropletLandsOrLeaves)
{
    // A droplet of 19 particles falls into a block, slowly enough that every change shows.
    ExpressionOptions options = expressionOf(LiquidStyle::Cartoon);
    const std::vector<Vec2> block = cluster(3000);
    const std::vector<Vec2> drop = cluster(19);
    ExpressionState state;
    double before = 0.0;
    double largest = 0.0;
    for (int k = 0; k <= 60; ++k) {
        std::vector<Vec2> now = block;
        for (const Vec2 x : drop) {
            now.push_back(x + Vec2{0.0, 4.6 - 0.025 * k});
        }
        ParticleFrame frame = frameOf(k / 120.0, now);
        std::fill(frame.velocity.begin() + static_cast<std::ptrdiff_t>(block.size()), frame.velocity.end(),
                  Vec2{0.0, -3.0});
        state = advanceExpression(std::move(state), frame, options);
        const double area = liquidShape(state, frame, options).area();
        if (k > 0) {
            largest = std::max(largest, std::abs(area - before));
        }
        before = area;
    }
    // In a step the droplet goes a quarter of a spacing; the area changes by no more than three particles.
    EXPECT_LT(largest, 3.0 * kSpacing * kSpacing);
}

/// Liquid with a gap around the origin that moves to the right with it.
ParticleFrame withGap(double time, double radius)
{
    constexpr double kSpeed = 1.0;
    std::vector<Vec2> position;
    for (Vec2 x : cluster(1500)) {
        const double away = length(x);
        // Water is pushed aside, evenly: from a disc of radius r to the ring around a hole.
        const double pushed = std::hypot(away, radius);
        x = away > 0.0 ? (pushed / away) * x : Vec2{pushed, 0.0};
        position.push_back(x + Vec2{kSpeed * time, 0.0});
    }
    return frameOf(time, position, {kSpeed, 0.0});
}

/// Frames of a sequence of gaps in which the liquid has a hole.
std::vector<int> framesWithHole(const std::vector<double>& radii)
{
    const ExpressionOptions options;
    ExpressionState state;
    std::vector<int> frames;
    for (std::size_t k = 0; k < radii.size(); ++k) {
        const ParticleFrame frame = withGap(static_cast<double>(k) / 24.0, radii[k]);
        state = advanceExpression(std::move(state), frame, options);
        const LiquidShape shape = liquidShape(state, frame, options);
        const auto hole = [](const droplet::Loop& loop) { return signedArea(loop) < 0.0; };
        if (std::any_of(shape.liquid.begin(), shape.liquid.end(), hole)) {
            frames.push_back(static_cast<int>(k));
        }
        state = remember(std::move(state), shape);
    }
    return frames;
}

TEST(Expression, HolesLastThreeFramesOrDoNotOpen)
{
    using testing::ElementsAre;
    using testing::IsEmpty;
    // Radii of gaps that are drawn as holes of one and a half, and of some ten particles.
    constexpr double kSmall = 1.15 * kSpacing;
    constexpr double kLarge = 2.2 * kSpacing;
    // Small holes of one or two frames never open; one that lasts opens at its third frame and stays for three.
    EXPECT_THAT(framesWithHole({0, 0, kSmall, 0, 0, 0, 0}), IsEmpty());
    EXPECT_THAT(framesWithHole({0, 0, kSmall, kSmall, 0, 0, 0}), IsEmpty());
    EXPECT_THAT(framesWithHole({0, 0, kSmall, kSmall, kSmall, 0, 0, 0, 0}), ElementsAre(4, 5, 6));
    EXPECT_THAT(framesWithHole({0, kSmall, kSmall, kSmall, kSmall, kSmall, kSmall, 0, 0}), ElementsAre(3, 4, 5, 6));
    // A large hole opens at once, and does not close at once.
    EXPECT_THAT(framesWithHole({0, 0, kLarge, 0, 0, 0, 0}), ElementsAre(2, 3, 4));
    EXPECT_THAT(framesWithHole({0, 0, kLarge, kLarge, kLarge, kLarge, 0}), ElementsAre(2, 3, 4, 5));
}

/// Number of holes of each frame of liquid with a gap that goes to the places of a list.
std::vector<std::ptrdiff_t> holesOfMoved(const std::vector<double>& places, double radius)
{
    const ExpressionOptions options;
    ExpressionState state;
    std::vector<std::ptrdiff_t> counts;
    for (std::size_t k = 0; k < places.size(); ++k) {
        ParticleFrame frame = withGap(0.0, k + 1 < places.size() ? radius : 0.0);
        frame.time = static_cast<double>(k) / 24.0;
        for (Vec2& x : frame.position) {
            x.x += places[k];
        }
        state = advanceExpression(std::move(state), frame, options);
        const LiquidShape shape = liquidShape(state, frame, options);
        counts.push_back(std::count_if(shape.liquid.begin(), shape.liquid.end(),
                                       [](const droplet::Loop& loop) { return signedArea(loop) < 0.0; }));
        state = remember(std::move(state), shape);
    }
    return counts;
}

TEST(Expression, HolesGoWhereTheLiquidGoes)
{
    // Liquid that a wall stops, or a gate lets go: no velocity of one frame tells where it is at the next.
    const double way = 15.0 * kSpacing;
    EXPECT_THAT(holesOfMoved({0.0, 0.0, way, way}, 2.2 * kSpacing), testing::ElementsAre(1, 1, 1, 0));
    EXPECT_THAT(holesOfMoved({0.0, way}, 2.2 * kSpacing), testing::ElementsAre(1, 1));
}

TEST(Expression, HolesThatAreHeldOpenCutNoLiquid)
{
    // A slot of 40 spacings by 3 in a bar of 50 by 12.
    std::vector<Vec2> position;
    for (const Vec2 x : cluster(5000)) {
        const double across = std::abs(x.y) / kSpacing;
        const double along = std::abs(x.x) / kSpacing;
        if (along < 25.0 && across < 6.0 && (along > 20.0 || across > 1.5)) {
            position.push_back(x);
        }
    }
    const ExpressionOptions options;
    const ParticleFrame first = frameOf(0.0, position);
    ExpressionState state = advanceExpression({}, first, options);
    const LiquidShape before = liquidShape(state, first, options);
    ASSERT_EQ(before.liquid.size(), 2U);
    state = remember(std::move(state), before);
    const ParticleFrame second = frameOf(1.0 / 24.0, position);
    state = advanceExpression(std::move(state), second, options);
    EXPECT_NEAR(liquidShape(state, second, options).area(), before.area(), areaOf(3));
}

TEST(Expression, BytesDoNotDependOnThreadsAndResumeExactly)
{
    const ExpressionOptions options = expressionOf(LiquidStyle::Wave);
    ParticleFrame frame;
    const ExpressionState state = flown(cluster(3000), 2.0, options, frame);
    const auto run = [&](std::size_t threads, const ExpressionState& from) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        ParticleFrame next = frame;
        next.time += 0.04;
        const ExpressionState after = advanceExpression(from, next, options);
        const LiquidShape shape = liquidShape(after, next, options);
        return std::pair{bytesOf(remember(after, shape)), shape.liquid.at(0).points};
    };
    const auto one = run(1, state);
    EXPECT_TRUE(one == run(2, state));
    EXPECT_TRUE(one == run(2, droplet::expressionFromBytes(bytesOf(state), "state")));
    std::string cut = bytesOf(state);
    cut.pop_back();
    EXPECT_THAT([&] { droplet::expressionFromBytes(cut, "state"); }, ThrowsMessage<Error>(HasSubstr("state")));
}

TEST(Expression, DrawsNothingWithoutParticlesAndRefusesWhatIsOutOfRange)
{
    EXPECT_TRUE(shapeOf(frameOf(0.0, {}), expressionOf(LiquidStyle::Wave)).liquid.empty());
    ExpressionOptions options;
    options.tail_slope = 2.0;
    EXPECT_THAT([&] { options.validate(); }, ThrowsMessage<Error>(HasSubstr("tail_slope is 2, must be")));
    const ExpressionState state = advanceExpression({}, frameOf(1.0, {{0, 0}}), {});
    EXPECT_THAT(
        [&] {
            advanceExpression(state, frameOf(1.0, {{0, 0}}), {});
        },
        ThrowsMessage<Error>(HasSubstr("must be later")));
    EXPECT_THAT(
        [&] {
            shapeOf(frameOf(0.0, {{0, 0}, {1e9, 1e9}}), {});
        },
        ThrowsMessage<Error>(HasSubstr("spread too far")));
}

}  // namespace
