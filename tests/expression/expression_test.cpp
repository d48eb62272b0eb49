// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/expression/expression.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "droplet/error.h"
#include "expression/field.h"
#include "expression/isoline.h"
#include "expression/tails.h"

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

TEST(Expression, TaperFallsFromOneToZeroAndSteeperOnesAreThinner)
{
    for (const double slope : {0.2, 0.7, 1.2}) {
        EXPECT_DOUBLE_EQ(droplet::taper(0.0, slope), 1.0);
        EXPECT_DOUBLE_EQ(droplet::taper(1.0, slope), 0.0);
        for (int k = 0; k < 20; ++k) {
            EXPECT_GT(droplet::taper(k / 20.0, slope), droplet::taper((k + 1) / 20.0, slope));
        }
    }
    EXPECT_GT(droplet::taper(0.5, 0.2), droplet::taper(0.5, 1.2));
}

TEST(Expression, HeadsOfCapsulesAndConesHaveTheirExactRadii)
{
    const auto capsule = [](double) { return 1.0; };
    const auto cone = [](double along) { return 1.0 - along; };
    for (const double length : {0.0, 1.0, 2.0, 4.0, 8.0}) {
        // Equation 1, mended: πr² + 2Lr = πR².
        const double pi = std::numbers::pi;
        EXPECT_NEAR(droplet::headRadius(length, capsule), (std::hypot(length, pi) - length) / pi, 0.005) << length;
        if (length > 1.0) {
            // The disc and its tangents to a point: r²(π − acos(r/L)) + r√(L² − r²) = πR².
            const double r = droplet::headRadius(length, cone);
            const double area = r * r * (pi - std::acos(r / length)) + r * std::sqrt(length * length - r * r);
            EXPECT_NEAR(area / pi, 1.0, 0.01) << length;
        }
        for (const double slope : {0.2, 1.2}) {
            const double r = droplet::headRadius(length, [=](double u) { return droplet::taper(u, slope); });
            EXPECT_GE(r + 0.005, droplet::headRadius(length, capsule));
        }
    }
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
        for (const std::size_t count : {1U, 7U, 19U}) {
            ExpressionOptions options = expressionOf(LiquidStyle::Cartoon);
            options.tail_slope = slope;
            options.fairing = 0.0;
            options.resolution = 0.2;
            ParticleFrame frame;
            const ExpressionState state = flown(cluster(count), 2.0, options, frame);
            const LiquidShape shape = liquidShape(state, frame, options);
            ASSERT_EQ(shape.droplets.size(), 1U);
            // The tail of a single particle is hardly wider than the cells of the grid; those of several overlap.
            EXPECT_NEAR(shape.area(), areaOf(count), (count == 1 ? 0.3 : 0.15) * areaOf(count)) << slope << count;
            // The tail is as long as the way of a quarter of a second, and points backwards.
            const auto [left, right] =
                std::minmax_element(shape.droplets[0].points.begin(), shape.droplets[0].points.end(),
                                    [](Vec2 a, Vec2 b) { return a.x < b.x; });
            EXPECT_GT(right->x - left->x, 0.4);
            EXPECT_NEAR(left->y, 0.0, 0.02);
        }
    }
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
    ExpressionOptions options = expressionOf(LiquidStyle::Wave);
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
    ExpressionOptions options = expressionOf(LiquidStyle::Wave);
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
        return std::pair{bytesOf(after), shape.liquid.at(0).points};
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
