// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "droplet/error.h"
#include "droplet/windshield/windshield.h"
#include "windshield/windshields.h"

namespace droplet {
namespace {

using testing::addRunning;
using testing::addStill;
using testing::after;
using testing::quietGlass;

const Wiper kWiper{.pivot = {0.1, -0.01},
                   .inner = 0.03,
                   .outer = 0.16,
                   .first = 20.0 * kDegree,
                   .last = 130.0 * kDegree,
                   .stroke = 1.0,
                   .period = 3.0,
                   .start = 0.5};

/// Distance of a place from the edges of the wiped area, negative outside [m].
double within(Vec2 p)
{
    const Vec2 from = p - kWiper.pivot;
    const double radius = length(from);
    const double angle = std::atan2(from.y, from.x);
    return std::min({radius - kWiper.inner, kWiper.outer - radius, radius * (angle - kWiper.first),
                     radius * (kWiper.last - angle)});
}

/// Small droplets all over a glass that retains them.
struct Field {
    WindshieldParameters parameters = quietGlass();
    WindshieldState state;
    std::size_t inside = 0;
    std::size_t outside = 0;

    Field()
    {
        parameters.forces.wetting.hysteresis = 2.0;
        parameters.wipers = {kWiper};
        state = startWindshield(parameters);
        for (int i = 0; i < 38; ++i) {
            for (int j = 0; j < 38; ++j) {
                const Vec2 place{0.003 + 0.0051 * i, 0.003 + 0.0051 * j};
                if (std::abs(within(place)) < 1e-9) {
                    continue;
                }
                ++(within(place) > 0.0 ? inside : outside);
                if ((i + j) % 2 == 0) {
                    addStill(state, place, 0.1 * kMicrolitre);
                } else {
                    addRunning(state, place, 1.0 * kMicrolitre);
                }
            }
        }
    }
};

std::size_t countOf(const WindshieldState& state)
{
    return state.droplets.size() + state.still.count();
}

TEST(Wiper, MovesForwardAndBackAndRests)
{
    EXPECT_EQ(kWiper.angleAt(-1.0), kWiper.first);
    EXPECT_EQ(kWiper.angleAt(0.5), kWiper.first);
    EXPECT_NEAR(kWiper.angleAt(0.75), 75.0 * kDegree, 1e-12);
    EXPECT_NEAR(kWiper.angleAt(1.0), kWiper.last, 1e-12);
    EXPECT_NEAR(kWiper.angleAt(1.25), 75.0 * kDegree, 1e-12);
    EXPECT_NEAR(kWiper.angleAt(1.5), kWiper.first, 1e-12);
    EXPECT_EQ(kWiper.angleAt(2.5), kWiper.first);
    EXPECT_NEAR(kWiper.angleAt(4.0), kWiper.last, 1e-12);
    EXPECT_NEAR(kWiper.angleAt(301.0), kWiper.last, 1e-9);
}

// One stroke removes exactly the water in its area, in steps of any length, even longer than the stroke.
TEST(Wiper, WipesExactlyWhatItCovers)
{
    for (const double dt : {0.011, 0.1, 0.5, 1.0, 2.0}) {
        SCOPED_TRACE(dt);
        const Field field;
        ASSERT_GT(field.inside, 400U);
        WindshieldState state = after(field.state, field.parameters, dt, static_cast<int>(std::ceil(1.5 / dt)));
        EXPECT_EQ(countOf(state), field.outside);
        EXPECT_EQ(state.counts.wiped, field.inside);
        for (const RunningDroplet& d : state.droplets) {
            EXPECT_LT(within(d.position), 0.0);
        }
        const WaterBalance balance = balanceOf(state);
        EXPECT_GT(balance.wiped, 0.0);
        EXPECT_NEAR(balance.residual(), 0.0, 1e-14);
    }
}

// Half way it has removed the water on its way; at rest it removes nothing.
TEST(Wiper, RemovesWaterAsItMoves)
{
    const Field field;
    EXPECT_EQ(after(field.state, field.parameters, 0.05, 10).counts.wiped, 0U);  // not yet begun
    const WindshieldState half = after(field.state, field.parameters, 0.05, 15);
    for (const RunningDroplet& d : half.droplets) {
        const Vec2 from = d.position - kWiper.pivot;
        EXPECT_TRUE(within(d.position) < 0.0 || std::atan2(from.y, from.x) > (75.0 - 1e-6) * kDegree);
    }
    EXPECT_GT(half.counts.wiped, 100U);
    EXPECT_LT(half.counts.wiped, field.inside);
    WindshieldState rested = after(half, field.parameters, 0.05, 20);
    EXPECT_EQ(rested.counts.wiped, field.inside);
    addRunning(rested, {0.1, 0.1}, 1.0 * kMicrolitre);
    rested = after(std::move(rested), field.parameters, 0.05, 30);  // until 3.25 s; the next stroke begins at 3.5 s
    EXPECT_EQ(rested.counts.wiped, field.inside);
    rested = after(std::move(rested), field.parameters, 0.05, 20);
    EXPECT_EQ(rested.counts.wiped, field.inside + 1);
}

// A droplet that passes through the blade is wiped, wherever it is at the end of the step.
TEST(Wiper, WipesDropletsThatPassThroughIt)
{
    WindshieldParameters p = quietGlass();
    p.forces.gravity = 0.0;
    p.forces.wetting.hysteresis = 0.0;
    p.forces.wetting.viscosity_factor = 0.0;
    p.wipers = {kWiper};
    WindshieldState state = startWindshield(p);
    state.time = 0.74;  // the blade at about 72°, going up
    constexpr double kDt = 0.01;
    const double before = kWiper.angleAt(0.74);
    const auto at = [](double angle) { return kWiper.pivot + 0.1 * Vec2{std::cos(angle), std::sin(angle)}; };
    const double after_step = kWiper.angleAt(0.75);
    // It moves from ahead of the blade to behind its start, so at the end it is not in the swept area.
    const Vec2 ahead = at(after_step + 0.02);
    const Vec2 behind = at(before - 0.05);
    addRunning(state, ahead, 1.0 * kMicrolitre, (1.0 / kDt) * (behind - ahead));
    // This one runs away from the blade, faster than the blade.
    const Vec2 away = at(after_step + 0.2);
    addRunning(state, at(before + 0.1), 1.0 * kMicrolitre, (1.0 / kDt) * (away - at(before + 0.1)));
    state = step(std::move(state), p, kDt);
    EXPECT_EQ(state.counts.wiped, 1U);
    ASSERT_EQ(state.droplets.size(), 1U);
    EXPECT_EQ(state.droplets[0].id, 2U);
}

TEST(Wiper, TandemReachesMostOfTheGlass)
{
    WindshieldParameters p = quietGlass();
    p.glass = Glass();
    p.forces.wetting.hysteresis = 2.0;
    p.wipers = tandemWipers(p.glass, 1.2);
    ASSERT_EQ(p.wipers.size(), 2U);
    WindshieldState state = startWindshield(p);
    int all = 0;
    for (double x = 0.01; x < 1.4; x += 0.02) {
        for (double y = 0.01; y < 0.8; y += 0.02) {
            addStill(state, {x, y}, 0.1 * kMicrolitre);
            ++all;
        }
    }
    state = after(std::move(state), p, 0.1, 12);
    const double share = static_cast<double>(state.counts.wiped) / all;
    EXPECT_GT(share, 0.55);
    EXPECT_LT(share, 0.95);
    // In front of the driver, and of the passenger.
    for (const StillDroplet& d : state.still.all()) {
        EXPECT_GT(std::hypot(d.position.x - 0.35, d.position.y - 0.35), 0.2);
        EXPECT_GT(std::hypot(d.position.x - 1.05, d.position.y - 0.3), 0.15);
    }
    // Nothing stays wet between the two: only the upper edge and the pillars do.
    bool has_corner = false;
    for (const StillDroplet& d : state.still.all()) {
        EXPECT_FALSE(d.position.x > 0.2 && d.position.x < 1.1 && d.position.y > 0.05 && d.position.y < 0.5)
            << d.position.x << " " << d.position.y;
        has_corner = has_corner || (d.position.x > 1.3 && d.position.y > 0.3 && d.position.y < 0.5);
    }
    EXPECT_TRUE(has_corner);
    EXPECT_THROW(tandemWipers(p.glass, 1.0).front().validate(), Error);
}

TEST(Wiper, RejectsInvalidFields)
{
    EXPECT_NO_THROW(kWiper.validate());
    EXPECT_NO_THROW(Wiper{}.validate());
    const auto refuses = [](const auto& change) {
        Wiper wiper = kWiper;
        change(wiper);
        EXPECT_THROW(wiper.validate(), Error);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    refuses([&](Wiper& w) { w.pivot.x = nan; });
    refuses([](Wiper& w) { w.inner = -0.1; });
    refuses([](Wiper& w) { w.outer = w.inner; });
    refuses([&](Wiper& w) { w.first = nan; });
    refuses([](Wiper& w) { w.last = w.first; });
    refuses([](Wiper& w) { w.last = w.first + 6.5; });
    refuses([](Wiper& w) { w.stroke = 0.0; });
    refuses([](Wiper& w) { w.period = 0.9; });
    refuses([&](Wiper& w) { w.start = nan; });
}

}  // namespace
}  // namespace droplet
