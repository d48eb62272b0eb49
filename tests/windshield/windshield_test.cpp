// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/windshield.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/wind/tunnel.h"
#include "droplet/windshield/presets.h"
#include "droplet/windshield/state_bytes.h"
#include "windshield/windshields.h"

namespace droplet {
namespace {

using testing::addRunning;
using testing::addStill;
using testing::after;
using ::testing::AllOf;
using testing::busyGlass;
using ::testing::HasSubstr;
using testing::quietGlass;
using testing::uniform;

constexpr double kDt = 1.0 / 60.0;

double reachOf(const WindshieldParameters& p, double volume)
{
    const CapSize cap = capOf(volume, p.forces.wetting.contact_angle);
    return p.forces.wetting.contact_angle > 0.5 * std::numbers::pi ? cap.radius : cap.contact_radius;
}

template <class Visit>
void visitStill(const WindshieldState& state, const Visit& visit)
{
    const StillCells& still = StillCells::of(state.still);
    for (std::size_t cell = 0; cell < still.counts.size(); ++cell) {
        for (const StillDroplet& d : still.droplets(cell)) {
            visit(cell, d);
        }
    }
}

// ---- forces -------------------------------------------------------------------------------------------------------

TEST(Windshield, LeavesDropletsAtRestExactlyWhereTheyAre)
{
    WindshieldParameters p = quietGlass();
    p.forces.wetting.hysteresis = 0.5;
    p.fluctuation = {};
    WindshieldState state = startWindshield(p);
    std::vector<Vec2> places;
    for (int k = 0; k < 6; ++k) {
        places.push_back({0.02 + 0.03 * k + 1e-4 / 3.0, 0.1});
        addRunning(state, places.back(), (1.0 + k) * kMicrolitre);
    }
    state = after(std::move(state), p, kDt, 300);
    ASSERT_EQ(state.droplets.size(), places.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
        EXPECT_EQ(state.droplets[k].position, places[k]);
        EXPECT_EQ(state.droplets[k].velocity, Vec2{});
    }
    EXPECT_TRUE(state.tracks.empty());
}

// Constant forces along a line have a closed form, which steps of any length reproduce.
TEST(Windshield, MovesExactlyUnderConstantForces)
{
    for (const double factor : {0.0, 1e-4, 0.05, 0.5}) {
        SCOPED_TRACE(factor);
        WindshieldParameters p = quietGlass();
        p.forces.wetting.hysteresis = 0.1;
        p.forces.wetting.viscosity_factor = factor;
        p.forces.wetting.kinetic_fraction = 0.7;
        constexpr double kVolume = 30.0 * kMicrolitre;
        const DropletForces forces = forcesOn(p.forces, kVolume);
        const double driving = forces.weight * std::sin(45.0 * kDegree) - forces.sliding_friction;
        constexpr double kTime = 0.12;
        double speed = driving / forces.mass * kTime;
        double way = 0.5 * speed * kTime;
        if (factor > 0.0) {
            const double rate = forces.viscous / forces.mass;
            const double terminal = driving / forces.viscous;
            speed = -terminal * std::expm1(-rate * kTime);
            way = terminal * kTime - speed / rate;
        }
        for (const int steps : {1, 7, 60}) {
            WindshieldState state = startWindshield(p);
            addRunning(state, {0.1, 0.19}, kVolume);
            state = after(std::move(state), p, kTime / steps, steps);
            ASSERT_EQ(state.droplets.size(), 1U);
            EXPECT_NEAR(state.droplets[0].velocity.y, -speed, 1e-9 * speed);
            EXPECT_NEAR(0.19 - state.droplets[0].position.y, way, 1e-7 * way);
            EXPECT_NEAR(state.droplets[0].position.x, 0.1, 1e-15);
        }
    }
}

TEST(Windshield, DropletsApproachTheirTerminalSpeed)
{
    WindshieldParameters p = quietGlass();
    p.glass = Glass({.width = 0.2, .height = 2.0, .radius = 1e9});
    p.forces.wetting.hysteresis = 0.1;
    WindshieldState state = startWindshield(p);
    addRunning(state, {0.1, 1.9}, 30.0 * kMicrolitre);
    state = after(std::move(state), p, kDt, 60);
    const DropletForces forces = forcesOn(p.forces, 30.0 * kMicrolitre);
    const double terminal = terminalVelocity(forces, -forces.weight * std::sin(45.0 * kDegree)).value();
    EXPECT_NEAR(state.droplets[0].velocity.y, terminal, 1e-9);
}

TEST(Windshield, FrictionStopsDropletsPermanently)
{
    WindshieldParameters p = quietGlass();
    p.forces.wetting.hysteresis = 0.5;
    p.forces.wetting.viscosity_factor = 0.05;
    constexpr double kVolume = 3.0 * kMicrolitre;
    const DropletForces forces = forcesOn(p.forces, kVolume);
    const double slowing = (forces.sliding_friction + forces.weight * std::sin(45.0 * kDegree)) / forces.mass;
    const double rate = forces.viscous / forces.mass;
    const double begins = 0.3;
    // v = (v₀ + a/k) e^(−kt) − a/k until it is 0.
    const double time = std::log1p(begins * rate / slowing) / rate;
    const double way = begins / rate - slowing / rate * time;
    double last = 0.0;
    for (const double dt : {1.0 / 30.0, 1.0 / 300.0, 1.0 / 3000.0}) {
        WindshieldState state = startWindshield(p);
        addRunning(state, {0.1, 0.1}, kVolume, {0.0, begins});
        for (double t = 0.0; t < time + 0.1; t += dt) {
            state = step(std::move(state), p, dt);
            ASSERT_GE(state.droplets[0].velocity.y, 0.0);
        }
        EXPECT_EQ(state.droplets[0].velocity, Vec2{});
        last = state.droplets[0].position.y - 0.1;
        EXPECT_NEAR(last, way, 0.5 * begins * dt);
    }
    EXPECT_NEAR(last, way, 1e-3 * way);
}

// Retention holds a droplet up to the wind of the closed form; above it the droplet climbs.
TEST(Windshield, DropletsStartAtTheirThreshold)
{
    WindshieldParameters p = quietGlass();
    p.forces.wetting.hysteresis = 0.2;
    constexpr double kVolume = 20.0 * kMicrolitre;
    const DropletForces forces = forcesOn(p.forces, kVolume);
    const double weight = forces.weight * std::sin(45.0 * kDegree);
    const double lower = std::sqrt((weight - forces.retention) / forces.drag);
    const double upper = std::sqrt((weight + forces.retention) / forces.drag);
    const auto velocityAt = [&](double wind) {
        p.vehicle = constantSpeed(wind);
        WindshieldState state = startWindshield(p);
        addRunning(state, {0.1, 0.1}, kVolume);
        return step(std::move(state), p, kDt).droplets[0].velocity.y;
    };
    EXPECT_LT(velocityAt(0.999 * lower), 0.0);
    EXPECT_EQ(velocityAt(1.001 * lower), 0.0);
    EXPECT_EQ(velocityAt(0.999 * upper), 0.0);
    EXPECT_GT(velocityAt(1.001 * upper), 0.0);
    // On a glass at 45° a projected wind must be √2 times as fast.
    p.wind = WindAlongGlass::Projected;
    EXPECT_EQ(velocityAt(0.999 * std::numbers::sqrt2 * upper), 0.0);
    EXPECT_GT(velocityAt(1.001 * std::numbers::sqrt2 * upper), 0.0);
}

TEST(Windshield, FollowsTheDriveCycle)
{
    WindshieldParameters p = quietGlass();
    p.forces.wetting.hysteresis = 0.2;
    constexpr double kVolume = 20.0 * kMicrolitre;
    const DropletForces forces = forcesOn(p.forces, kVolume);
    // The wind first holds it and then rises by 0.5 m/s every second; the acceleration, too, drives it up.
    const double hold = forces.weight * std::sin(45.0 * kDegree) + forces.retention;
    const double upper = std::sqrt((hold - forces.mass * 0.5 * std::cos(45.0 * kDegree)) / forces.drag);
    p.vehicle = {{0.0, 8.0}, {upper - 2.0, upper + 2.0}};
    WindshieldState state = startWindshield(p);
    addRunning(state, {0.1, 0.05}, kVolume);
    while (state.droplets[0].velocity == Vec2{} && state.time < 8.0) {
        state = step(std::move(state), p, kDt);
    }
    EXPECT_NEAR(state.time, 4.0, 1.5 * kDt);
}

// Without air and friction, water slides by gravity and by the deceleration of the car.
TEST(Windshield, ThrowsWaterForwardWhenTheCarBrakes)
{
    WindshieldParameters p = quietGlass();
    p.glass = Glass({.width = 0.2, .height = 4.0, .radius = std::numeric_limits<double>::infinity()});
    p.forces.air.density = 0.0;
    p.forces.wetting.hysteresis = 0.0;
    p.forces.wetting.viscosity_factor = 0.0;
    p.vehicle = {{0.0, 0.5, 1.0}, {6.0, 6.0, 2.0}};
    WindshieldState state = startWindshield(p);
    addRunning(state, {0.1, 3.9}, 5.0 * kMicrolitre);
    state = after(std::move(state), p, 0.025, 10);
    const double down = kStandardGravity * std::sin(45.0 * kDegree);
    EXPECT_NEAR(state.droplets[0].velocity.y, -0.25 * down, 1e-12);
    state = after(std::move(state), p, 0.025, 20);
    EXPECT_NEAR(state.droplets[0].velocity.y, -0.75 * down - 0.25 * 8.0 * std::cos(45.0 * kDegree), 1e-12);
    EXPECT_NEAR(state.droplets[0].velocity.x, 0.0, 1e-15);
}

// ---- breaking up --------------------------------------------------------------------------------------------------

TEST(Windshield, WindBreaksUpDropletsThatAreTooHigh)
{
    WindshieldParameters p = quietGlass();
    constexpr double kWind = 11.3;
    p.vehicle = constantSpeed(kWind);
    p.forces.wetting.contact_angle = 90.0 * kDegree;
    p.forces.wetting.hysteresis = 2.0;  // nothing moves
    const double highest = tearOffHeight(p.forces, kWind);
    const double largest = 2.0 / 3.0 * std::numbers::pi * std::pow(highest, 3);
    for (const double volumes : {0.99, 1.01, 4.5}) {
        SCOPED_TRACE(volumes);
        WindshieldState state = startWindshield(p);
        addRunning(state, {0.1, 0.02}, volumes * largest);
        state = after(std::move(state), p, kDt, 3);
        EXPECT_EQ(state.counts.torn, state.droplets.size() - 1);
        EXPECT_GE(state.droplets.size(), static_cast<std::size_t>(std::ceil(volumes)));
        EXPECT_LE(state.droplets.size(), static_cast<std::size_t>(std::ceil(2.0 * volumes)));
        EXPECT_EQ(state.droplets[0].position, (Vec2{0.1, 0.02}));
        double sum = 0.0;
        for (std::size_t k = 0; k < state.droplets.size(); ++k) {
            const RunningDroplet& d = state.droplets[k];
            sum += d.volume;
            EXPECT_LE(d.volume, largest);
            EXPECT_TRUE(k == 0 || d.volume >= 0.5 * largest || volumes < 1.5);
            EXPECT_TRUE(k == 0 || d.position.y > state.droplets[k - 1].position.y) << "up, as the wind";
            EXPECT_LE(std::abs(d.position.x - 0.1), 0.6 * (d.position.y - 0.02));
        }
        EXPECT_NEAR(sum, volumes * largest, 1e-12 * sum);
        EXPECT_NEAR(balanceOf(state).residual(), 0.0, 1e-15);
        p.tear_off_weber = std::numeric_limits<double>::infinity();
        WindshieldState whole = startWindshield(p);
        addRunning(whole, {0.1, 0.02}, volumes * largest);
        EXPECT_EQ(step(std::move(whole), p, kDt).droplets.size(), 1U);
        p.tear_off_weber = kTearOffWeber;
    }
}

// Rows of equal droplets on a line are seen as such.
TEST(Windshield, TornPartsDifferInSizeAndPlace)
{
    WindshieldParameters p = quietGlass();
    p.vehicle = constantSpeed(20.0);
    p.forces.wetting.hysteresis = 2.0;
    const double largest = 2.0 / 3.0 * std::numbers::pi * std::pow(tearOffHeight(p.forces, 20.0), 3);
    const auto torn = [&](std::uint64_t seed) {
        p.seed = seed;
        WindshieldState state = startWindshield(p);
        for (int k = 0; k < 4; ++k) {
            addRunning(state, {0.04 + 0.04 * k, 0.02}, 5.5 * largest);
        }
        return step(std::move(state), p, kDt);
    };
    const WindshieldState state = torn(1);
    ASSERT_GE(state.droplets.size(), 20U);
    std::vector<double> volumes;
    std::vector<double> places;
    for (const RunningDroplet& d : state.droplets) {
        volumes.push_back(d.volume);
        places.push_back(d.position.x);
    }
    const auto distinct = [](std::vector<double> values, double apart) {
        std::sort(values.begin(), values.end());
        return std::count_if(values.begin() + 1, values.end(), [&, last = values.front()](double v) mutable {
            return v - std::exchange(last, v) > apart;
        });
    };
    EXPECT_GT(distinct(volumes, 1e-4 * largest), static_cast<std::ptrdiff_t>(volumes.size()) - 4);
    EXPECT_GT(distinct(places, 1e-6), static_cast<std::ptrdiff_t>(places.size()) - 4);
    EXPECT_EQ(torn(1), state) << "the seed decides";
    EXPECT_NE(torn(2), state);
}

// The wind on a droplet is that in the boundary layer at its height, relative to the droplet, as for its drag.
TEST(Windshield, DropletsInTheBoundaryLayerAreSheltered)
{
    WindshieldParameters p = quietGlass();
    p.forces.wetting.hysteresis = 2.0;
    p.forces.air.drag_coefficient = 0.0;  // nothing moves
    p.forces.air.boundary_layer = 6.8e-3;
    constexpr double kCar = 100.0 / 3.6;
    p.vehicle = constantSpeed(kCar);
    EXPECT_NEAR(tearOffHeight(p.forces, kCar), 2.0e-3, 0.05e-3);
    for (const double exponent : {1.0 / 7.0, 0.3, 0.5}) {
        p.forces.air.profile_exponent = exponent;
        const double highest = tearOffHeight(p.forces, kCar);
        const double wind = windAt(p.forces.air, kCar, highest);
        EXPECT_NEAR(p.forces.air.density * wind * wind * highest / p.forces.liquid.surface_tension, kTearOffWeber,
                    1e-9);
        for (const double share : {0.98, 1.02}) {
            WindshieldState state = startWindshield(p);
            addRunning(state, {0.1, 0.02}, 2.0 / 3.0 * std::numbers::pi * std::pow(share * highest, 3));
            EXPECT_EQ(step(std::move(state), p, kDt).counts.torn, share > 1.0 ? 1U : 0U) << exponent;
        }
    }
    // One that runs with the wind feels less of it.
    p.forces.wetting.hysteresis = 0.0;
    p.forces.wetting.viscosity_factor = 0.0;
    p.forces.gravity = 0.0;
    const double volume = 2.0 / 3.0 * std::numbers::pi * std::pow(1.05 * tearOffHeight(p.forces, kCar), 3);
    for (const double speed : {0.0, 2.0, 5.0}) {
        WindshieldState state = startWindshield(p);
        addRunning(state, {0.1, 0.02}, volume, {0.0, speed});
        EXPECT_EQ(step(std::move(state), p, kDt).counts.torn, speed < 1.0 ? 1U : 0U) << speed;
    }
}

// Two droplets that meet and are torn apart at once: none of them leaps.
TEST(Windshield, DropletsThatMeetAndPartStayWhereTheyAre)
{
    WindshieldParameters p = quietGlass();
    p.vehicle = constantSpeed(22.0);
    p.forces.wetting.hysteresis = 2.0;
    p.forces.wetting.viscosity_factor = 0.0;
    p.forces.air.drag_coefficient = 0.0;
    p.forces.gravity = 0.0;
    const double volume = 2.0 / 3.0 * std::numbers::pi * std::pow(0.95 * tearOffHeight(p.forces, 22.0), 3);
    const double reach = reachOf(p, volume);
    WindshieldState state = startWindshield(p);
    addRunning(state, {0.1, 0.05}, volume, {0.0, 0.05});
    addRunning(state, {0.1, 0.05 + 2.0001 * reach}, volume);
    const double speed = 0.05;
    state = step(std::move(state), p, kDt);
    ASSERT_EQ(state.counts.merged, 1U);
    ASSERT_GE(state.counts.torn, 1U);
    EXPECT_EQ(state.droplets[0].id, 1U);
    EXPECT_LE(length(state.droplets[0].position - Vec2{0.1, 0.05}), speed * kDt);
    EXPECT_GT(length(state.droplets[0].position - state.droplets[1].position),
              reachOf(p, state.droplets[0].volume) + reachOf(p, state.droplets[1].volume));
}

// Without tear-off, a wind that holds droplets of every size lets them merge to hemispheres of two millilitres.
TEST(Windshield, DropletsDoNotOutgrowTheTearOffLimit)
{
    WindshieldParameters p = quietGlass();
    p.vehicle = constantSpeed(9.2);
    p.rainfall = 200.0 * kMillimetrePerHour;
    p.tear_off_weber = 4.0;  // so low that droplets reach it in half a minute
    const double highest = tearOffHeight(p.forces, 9.2, p.tear_off_weber);
    const auto largest_after = [&](int steps) {
        double largest = 0.0;
        for (const RunningDroplet& d : after(startWindshield(p), p, 1.0 / 30.0, steps).droplets) {
            largest = std::max(largest, capOf(d.volume, p.forces.wetting.contact_angle).height);
        }
        return largest / highest;
    };
    EXPECT_LT(largest_after(900), 1.02);  // tolerance for water that the last step added
    p.tear_off_weber = std::numeric_limits<double>::infinity();
    EXPECT_GT(largest_after(900), 1.3);
}

TEST(Windshield, RelativeWindDecreasesWithTheDropletsSpeed)
{
    WindshieldParameters p = quietGlass();
    p.forces.wetting.hysteresis = 0.0;
    p.forces.wetting.viscosity_factor = 0.0;
    p.glass = Glass({.width = 0.1, .height = 30.0, .radius = 1e9});
    p.vehicle = constantSpeed(15.0);
    p.relative_wind = true;
    constexpr double kVolume = 20.0 * kMicrolitre;
    WindshieldState state = startWindshield(p);
    addRunning(state, {0.05, 1.0}, kVolume);
    state = after(std::move(state), p, kDt, 600);
    // When the relative wind just holds it, the force is zero.
    const DropletForces forces = forcesOn(p.forces, kVolume);
    const double neutral = std::sqrt(forces.weight * std::sin(45.0 * kDegree) / forces.drag);
    EXPECT_NEAR(state.droplets[0].velocity.y, 15.0 - neutral, 1e-3);
}

// A mirrored glass gives the mirrored result.
TEST(Windshield, TreatsLeftAndRightAlike)
{
    WindshieldParameters p = quietGlass();
    p.glass = Glass({.width = 0.6, .height = 0.3, .radius = 1.0});
    p.forces.wetting.hysteresis = 0.02;
    p.vehicle = constantSpeed(12.0);
    WindshieldState a = startWindshield(p);
    WindshieldState b = startWindshield(p);
    for (int k = 0; k < 5; ++k) {
        const Vec2 place{0.31 + 0.05 * k, 0.1 + 0.02 * k};
        addRunning(a, place, (5.0 + 3.0 * k) * kMicrolitre);
        addRunning(b, {0.6 - place.x, place.y}, (5.0 + 3.0 * k) * kMicrolitre);
    }
    a = after(std::move(a), p, kDt, 30);
    b = after(std::move(b), p, kDt, 30);
    ASSERT_EQ(a.droplets.size(), 5U);
    ASSERT_EQ(b.droplets.size(), 5U);
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_NEAR(a.droplets[k].position.x + b.droplets[k].position.x, 0.6, 1e-12);
        EXPECT_NEAR(a.droplets[k].position.y, b.droplets[k].position.y, 1e-12);
        EXPECT_GT(a.droplets[k].velocity.x, 0.0);  // outward
    }
}

// ---- merging ------------------------------------------------------------------------------------------------------

TEST(Windshield, MergesEqualDropletsAtTheirCentre)
{
    WindshieldParameters p = quietGlass();
    p.forces.gravity = 0.0;
    p.forces.wetting.hysteresis = 0.0;
    p.forces.wetting.viscosity_factor = 0.0;
    WindshieldState state = startWindshield(p);
    addRunning(state, {0.09, 0.1}, 5.0 * kMicrolitre, {0.4, 0.0});
    addRunning(state, {0.11, 0.1}, 5.0 * kMicrolitre, {-0.4, 0.1});
    state = after(std::move(state), p, kDt, 2);
    ASSERT_EQ(state.droplets.size(), 1U);
    EXPECT_EQ(state.droplets[0].id, 1U);
    EXPECT_DOUBLE_EQ(state.droplets[0].volume, 10.0 * kMicrolitre);
    EXPECT_NEAR(state.droplets[0].velocity.x, 0.0, 1e-15);
    EXPECT_NEAR(state.droplets[0].velocity.y, 0.05, 1e-15);
    EXPECT_NEAR(state.droplets[0].position.x, 0.1, 1e-15);
    EXPECT_NEAR(state.droplets[0].position.y, 0.1 + 0.1 * kDt, 1e-15);
    EXPECT_EQ(state.counts.merged, 1U);
    EXPECT_DOUBLE_EQ(balanceOf(state).merged, 5.0 * kMicrolitre);
}

TEST(Windshield, LargerDropletsAbsorbSmallerOnes)
{
    WindshieldParameters p = quietGlass();
    p.forces.wetting.hysteresis = 2.0;
    WindshieldState state = startWindshield(p);
    addRunning(state, {0.1, 0.1}, 2.0 * kMicrolitre);
    addRunning(state, {0.101, 0.1}, 6.0 * kMicrolitre);
    state = step(std::move(state), p, kDt);
    ASSERT_EQ(state.droplets.size(), 1U);
    EXPECT_EQ(state.droplets[0].id, 2U);
    EXPECT_NEAR(state.droplets[0].position.x, 0.1 + 0.75e-3, 1e-15);
    EXPECT_EQ(state.droplets[0].velocity, Vec2{});
}

TEST(Windshield, MergesOnlyDropletsThatTouch)
{
    WindshieldParameters p = quietGlass();
    p.forces.wetting.hysteresis = 2.0;
    const double touching = reachOf(p, 2.0 * kMicrolitre) + reachOf(p, 6.0 * kMicrolitre);
    for (const double share : {0.999, 1.001}) {
        for (double angle = 0.1; angle < 6.0; angle += 0.7) {
            WindshieldState state = startWindshield(p);
            const Vec2 aside{std::cos(angle), std::sin(angle)};
            addRunning(state, {0.1, 0.1}, 2.0 * kMicrolitre);
            addRunning(state, Vec2{0.1, 0.1} + share * touching * aside, 6.0 * kMicrolitre);
            EXPECT_EQ(step(std::move(state), p, kDt).droplets.size(), share < 1.0 ? 1U : 2U) << angle;
        }
    }
}

TEST(Windshield, MergesChainsWithinOneStep)
{
    WindshieldParameters p = quietGlass();
    p.forces.wetting.hysteresis = 2.0;
    const double step_apart = 1.9 * reachOf(p, 3.0 * kMicrolitre);
    WindshieldState state = startWindshield(p);
    for (const int k : {3, 0, 4, 1, 2}) {
        addRunning(state, {0.05 + step_apart * k, 0.1}, (k == 1 ? 3.5 : 3.0) * kMicrolitre);
    }
    state = step(std::move(state), p, kDt);
    ASSERT_EQ(state.droplets.size(), 1U);
    EXPECT_EQ(state.droplets[0].id, 4U);  // the largest
    EXPECT_NEAR(state.droplets[0].volume, 15.5 * kMicrolitre, 1e-22);
    EXPECT_EQ(state.counts.merged, 4U);
}

// Steps of ten times their width: they meet droplets in their way, and none beside it.
TEST(Windshield, FastDropletsDoNotPassThroughOthers)
{
    WindshieldParameters p = quietGlass();
    p.forces.gravity = 0.0;
    p.forces.wetting.hysteresis = 0.1;
    p.forces.wetting.viscosity_factor = 0.0;
    const double reach = reachOf(p, 5.0 * kMicrolitre);
    for (const double aside : {0.0, 1.9, -1.9, 2.1, -2.1}) {
        WindshieldState state = startWindshield(p);
        addRunning(state, {0.02, 0.1}, 5.0 * kMicrolitre, {3.0, 0.0});
        addRunning(state, {0.08, 0.1 + aside * reach}, 5.0 * kMicrolitre);
        state = step(std::move(state), p, 1.0 / 30.0);
        EXPECT_EQ(state.droplets.size(), std::abs(aside) < 2.0 ? 1U : 2U) << aside;
        EXPECT_GT(state.droplets[0].position.x, 0.06);
    }
}

TEST(Windshield, DoesNotMergeDropletsWhoseTracksCrossAtOtherTimes)
{
    WindshieldParameters p = quietGlass();
    p.forces.gravity = 0.0;
    p.forces.wetting.hysteresis = 0.0;
    p.forces.wetting.viscosity_factor = 0.0;
    const auto countAfter = [&](double late) {
        WindshieldState state = startWindshield(p);
        addRunning(state, {0.05, 0.1}, 2.0 * kMicrolitre, {3.0, 0.0});
        addRunning(state, {0.1, 0.05 - late}, 2.0 * kMicrolitre, {0.0, 3.0});
        return step(std::move(state), p, 1.0 / 30.0).droplets.size();
    };
    EXPECT_EQ(countAfter(0.0), 1U);
    EXPECT_EQ(countAfter(0.03), 2U);
}

// ---- still droplets -----------------------------------------------------------------------------------------------

TEST(Windshield, SweepsStillDropletsAlongTheTrack)
{
    WindshieldParameters p = quietGlass();
    p.forces.wetting.hysteresis = 0.1;
    p.forces.wetting.viscosity_factor = 0.0;
    constexpr double kVolume = 8.0 * kMicrolitre;
    constexpr double kSmall = 0.02 * kMicrolitre;
    const Vec2 from{0.05, 0.05};
    WindshieldState state = startWindshield(p);
    std::size_t all = 0;
    for (double x = 0.001; x < 0.2; x += 0.0021) {
        for (double y = 0.001; y < 0.2; y += 0.0023) {
            addStill(state, {x, y}, kSmall);
            ++all;
        }
    }
    addRunning(state, from, kVolume, {2.0, 1.5});
    const WindshieldState later = step(state, p, 1.0 / 30.0);
    ASSERT_EQ(later.tracks.size(), 1U);
    const TrackPiece track = later.tracks[0];
    EXPECT_EQ(track.from, from);
    EXPECT_EQ(track.to, later.droplets[0].position);
    EXPECT_GT(length(track.to - track.from), 0.06);
    const double before = reachOf(p, kVolume) + reachOf(p, kSmall);
    const double max = reachOf(p, later.droplets[0].volume) + reachOf(p, kSmall);
    const auto apart = [&](Vec2 q) {
        const Vec2 way = track.to - track.from;
        const double t = std::clamp(dot(q - track.from, way) / dot(way, way), 0.0, 1.0);
        return length(q - track.from - t * way);
    };
    std::size_t kept = 0;
    visitStill(later, [&](std::size_t, const StillDroplet& d) {
        EXPECT_GT(apart(d.position), before);
        ++kept;
    });
    std::size_t untouched = 0;
    visitStill(state, [&](std::size_t, const StillDroplet& d) { untouched += apart(d.position) > max ? 1U : 0U; });
    EXPECT_GE(kept, untouched);  // between the two are only those that the droplet touches after it has grown
    EXPECT_GT(all - kept, 40U);
    EXPECT_EQ(later.counts.swept, all - kept);
    EXPECT_EQ(later.still.count(), kept);
    EXPECT_NEAR(later.droplets[0].volume, kVolume + static_cast<double>(all - kept) * kSmall, 1e-18);
    // Momentum is conserved: water at rest slows it down.
    WindshieldState alone = startWindshield(p);
    addRunning(alone, from, kVolume, {2.0, 1.5});
    alone = step(std::move(alone), p, 1.0 / 30.0);
    EXPECT_NEAR(later.droplets[0].velocity.x * later.droplets[0].volume, alone.droplets[0].velocity.x * kVolume,
                1e-12 * kVolume);
}

TEST(Windshield, RaisesTheRevisionsOfCellsThatChange)
{
    const WindshieldParameters p = busyGlass();
    WindshieldState state = after(startWindshield(p), p, kDt, 60);
    for (int k = 0; k < 30; ++k) {
        const WindshieldState later = step(state, p, kDt);
        const StillCells& before = StillCells::of(state.still);
        const StillCells& now = StillCells::of(later.still);
        std::size_t changed = 0;
        for (std::size_t cell = 0; cell < before.counts.size(); ++cell) {
            const auto a = before.droplets(cell);
            const auto b = now.droplets(cell);
            if (!std::equal(a.begin(), a.end(), b.begin(), b.end())) {
                EXPECT_GT(now.revisions[cell], before.revisions[cell]);
                ++changed;
            }
        }
        EXPECT_GT(changed, 0U);
        state = later;
    }
}

TEST(Windshield, StillDropletsGrowUntilTheyRun)
{
    WindshieldParameters p = quietGlass();
    p.rainfall = 100.0 * kMillimetrePerHour;
    p.glass = Glass({.width = 0.02, .height = 0.02});
    p.raindrops = {0.5e-3, 0.9e-3};  // each is too small to run
    p.forces.wetting.hysteresis = 2.0;
    const WindshieldState state = after(startWindshield(p), p, 1.0, 600);
    EXPECT_GT(state.counts.grown, 10U);
    ASSERT_FALSE(state.droplets.empty());
    for (const RunningDroplet& d : state.droplets) {
        EXPECT_GE(d.volume, std::numbers::pi / 6.0 * 1e-9);
    }
    EXPECT_NEAR(balanceOf(state).residual(), 0.0, 1e-12);
}

// Rain and large droplets, running and at rest, act on the still ones.
class StillAmong : public ::testing::TestWithParam<double> {};

TEST_P(StillAmong, KeepApartAndInTheirCells)
{
    WindshieldParameters p = busyGlass();
    p.glass = Glass({.width = 0.1, .height = 0.1});
    p.forces.wetting.hysteresis = GetParam();
    WindshieldState state = startWindshield(p);
    const double limit = std::numbers::pi / 6.0 * 1e-9;
    for (int k = 0; k < 8; ++k) {
        state = after(std::move(state), p, kDt, 15);
        std::vector<StillDroplet> all;
        const StillCells& still = StillCells::of(state.still);
        visitStill(state, [&](std::size_t cell, const StillDroplet& d) {
            const auto column = static_cast<std::size_t>(d.position.x / still.cell);
            const auto row = static_cast<std::size_t>(d.position.y / still.cell);
            EXPECT_EQ(cell, row * still.columns + column);
            EXPECT_GT(d.volume, 0.0);
            EXPECT_LT(d.volume, limit);
            all.push_back(d);
        });
        EXPECT_GT(all.size(), 50U);
        std::sort(all.begin(), all.end(), [](auto& a, auto& b) { return a.position.x < b.position.x; });
        const double widest = 2.0 * reachOf(p, limit);
        for (std::size_t a = 0; a < all.size(); ++a) {
            for (std::size_t b = a + 1; b < all.size() && all[b].position.x < all[a].position.x + widest; ++b) {
                EXPECT_GT(length(all[a].position - all[b].position),
                          (1.0 - 1e-12) * (reachOf(p, all[a].volume) + reachOf(p, all[b].volume)));
            }
            for (const RunningDroplet& d : state.droplets) {
                // A moving droplet absorbs those that it touches by growing only in the next step.
                const double grown = d.velocity == Vec2{} ? 1e-12 : 0.05;
                EXPECT_GT(length(all[a].position - d.position),
                          (1.0 - grown) * (reachOf(p, all[a].volume) + reachOf(p, d.volume)));
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Hysteresis, StillAmong, ::testing::Values(0.05, 2.0));

TEST(Windshield, StreaksHaveTheVolumeOfTheFilm)
{
    WindshieldParameters p = quietGlass();
    p.forces.wetting.hysteresis = 0.0;
    p.forces.wetting.viscosity_factor = 0.0;
    p.forces.gravity = 0.0;
    p.streaks = {.film = 10e-6, .spacing = 2e-3};
    constexpr double kVolume = 20.0 * kMicrolitre;
    WindshieldState state = startWindshield(p);
    addRunning(state, {0.02, 0.1}, kVolume, {0.3, 0.0});
    state = after(std::move(state), p, kDt, 30);
    ASSERT_EQ(state.droplets.size(), 1U);
    const double way = state.droplets[0].position.x - 0.02;
    const double expected = p.streaks.film * 2.0 * reachOf(p, kVolume) * way;
    const WaterBalance balance = balanceOf(state);
    EXPECT_NEAR(balance.shed, expected,
                0.06 * expected);  // tolerance: one spacing of about 75, and a droplet that shrinks
    EXPECT_DOUBLE_EQ(balance.on_glass_still, balance.shed);
    EXPECT_NEAR(state.droplets[0].volume, kVolume - balance.shed, 1e-20);
    EXPECT_NEAR(static_cast<double>(state.still.count()), way / p.streaks.spacing, 8.0);
    EXPECT_NEAR(state.droplets[0].velocity.x, 0.3, 1e-12);
    EXPECT_EQ(state.counts.swept, 0U);
    // They lie within the track, beside its middle.
    double aside = 0.0;
    visitStill(state, [&](std::size_t, const StillDroplet& d) {
        EXPECT_NEAR(d.position.y, 0.1, 0.4 * reachOf(p, kVolume));
        aside = std::max(aside, std::abs(d.position.y - 0.1));
    });
    EXPECT_GT(aside, 0.2 * reachOf(p, kVolume));
}

TEST(Windshield, StreaksLeaveEnoughWaterToRun)
{
    WindshieldParameters p = busyGlass();
    p.streaks = {.film = 1e-3, .spacing = 1e-3};
    const WindshieldState state = after(startWindshield(p), p, kDt, 120);
    EXPECT_GT(balanceOf(state).shed, 0.0);
    for (const RunningDroplet& d : state.droplets) {
        EXPECT_GE(d.volume, (1.0 - 1e-12) * std::numbers::pi / 6.0 * 1e-9);
    }
    EXPECT_NEAR(balanceOf(state).residual(), 0.0, 1e-12);
}

// ---- rain ---------------------------------------------------------------------------------------------------------

TEST(Windshield, RainArrivesAtTheRateOfTheSlope)
{
    WindshieldParameters p = quietGlass();
    p.vehicle = constantSpeed(9.0);
    p.rainfall = 8.0 * kMillimetrePerHour;
    p.forces.wetting.hysteresis = 2.0;
    p.wipers = {
        {.pivot = {0.1, 0.1}, .inner = 0.0, .outer = 0.3, .first = 0.0, .last = 6.28, .stroke = 0.1, .period = 0.1}};
    const RainImpacts impacts{raindropSizes(p.rainfall), p.raindrops, 9.0};
    const double expected = impacts.rate(0.0, Exposure::ofSlope(45.0 * kDegree)) * 0.04 * 2.0;
    const WindshieldState state = after(startWindshield(p), p, 0.1, 20);
    EXPECT_NEAR(static_cast<double>(state.counts.raindrops), expected, 4.0 * std::sqrt(expected));
}

// The variance of the number of raindrops in an interval is its mean.
TEST(Windshield, RainIsAPoissonProcess)
{
    WindshieldParameters p = quietGlass();
    p.glass = Glass({.width = 0.05, .height = 0.05});
    p.vehicle = constantSpeed(10.0);
    p.rainfall = 5.0 * kMillimetrePerHour;
    p.raindrops = {1e-3, 8e-3};
    WindshieldState state = startWindshield(p);
    constexpr int kIntervals = 4000;
    double sum = 0.0;
    double squares = 0.0;
    for (int k = 0; k < kIntervals; ++k) {
        const auto before = static_cast<double>(state.counts.raindrops);
        state.droplets.clear();
        state = step(std::move(state), p, 1.0);
        const double here = static_cast<double>(state.counts.raindrops) - before;
        sum += here;
        squares += here * here;
    }
    const double mean = sum / kIntervals;
    const double variance = squares / kIntervals - mean * mean;
    const RainImpacts impacts{raindropSizes(p.rainfall), p.raindrops, 10.0};
    const double expected = impacts.rate(0.0, Exposure::ofSlope(45.0 * kDegree)) * 0.0025;
    EXPECT_NEAR(mean, expected, 4.0 * std::sqrt(expected / kIntervals));
    EXPECT_NEAR(variance / mean, 1.0, 4.0 * std::sqrt(2.0 / kIntervals));
}

TEST(Windshield, RainIsTheSameInStepsOfAnyLength)
{
    WindshieldParameters p = busyGlass();
    p.seed = 5;
    const WindshieldState a = after(startWindshield(p), p, 1.0 / 32.0, 32);
    const WindshieldState b = after(startWindshield(p), p, 1.0 / 256.0, 256);
    EXPECT_GT(a.counts.raindrops, 100U);
    EXPECT_EQ(a.counts.raindrops, b.counts.raindrops);
    EXPECT_EQ(a.rained.value(), b.rained.value());
    EXPECT_EQ(a.next_raindrop, b.next_raindrop);
    p.seed = 6;
    EXPECT_NE(after(startWindshield(p), p, 1.0 / 32.0, 32).rained.value(), a.rained.value());
}

TEST(Windshield, RainFallsOnlyOnTheMesh)
{
    // A triangle: half of its bounding box is not glass.
    const double half = std::sqrt(0.5);
    TexturedMesh mesh;
    mesh.vertices = {{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.0, 0.1 * half, 0.1 * half}};
    mesh.normals.assign(3, {0.0, -half, half});
    mesh.uvs = {{0.0, 1.0}, {1.0, 1.0}, {0.0, 0.0}};
    mesh.triangles = {{0, 1, 2}};
    WindshieldParameters p = busyGlass();
    p.glass = Glass(mesh, {});
    ASSERT_NEAR(p.glass.width(), 0.1, 1e-12);
    const WindshieldState state = after(startWindshield(p), p, kDt, 200);
    for (const RunningDroplet& d : state.droplets) {
        EXPECT_TRUE(p.glass.holds(d.position));
    }
    EXPECT_GT(state.counts.left, 0U);
    EXPECT_GT(state.counts.swept, 0U);
    EXPECT_NEAR(balanceOf(state).residual(), 0.0, 1e-12);
}

// ---- water --------------------------------------------------------------------------------------------------------

TEST(Windshield, ConservesAllWater)
{
    std::mt19937_64 bits(11);
    for (int k = 0; k < 6; ++k) {
        SCOPED_TRACE(k);
        WindshieldParameters p = busyGlass();
        p.glass = Glass({.width = uniform(bits, 0.03, 0.2),
                         .height = uniform(bits, 0.03, 0.2),
                         .radius = 0.5,
                         .slope = uniform(bits, 0.0, 1.5)});
        p.forces.wetting.hysteresis = uniform(bits, 0.0, 0.6);
        p.forces.wetting.contact_angle = uniform(bits, 0.5, 2.2);
        p.forces.wetting.viscosity_factor = uniform(bits, 0.0, 0.3);
        p.vehicle = {{0.0, 1.0, 2.0}, {0.0, uniform(bits, 0.0, 40.0), 5.0}};
        p.rainfall = uniform(bits, 0.0, 200.0) * kMillimetrePerHour;
        p.relative_wind = bits() % 2 == 0;
        p.streaks.film = bits() % 2 == 0 ? 2e-5 : 0.0;
        p.wipers = tandemWipers(p.glass, uniform(bits, 1.2, 2.0));
        p.seed = bits();
        WindshieldState state = startWindshield(p);
        for (int s = 0; s < 60; ++s) {
            state = step(std::move(state), p, uniform(bits, 1e-3, 0.05));
            const WaterBalance balance = balanceOf(state);
            ASSERT_NEAR(balance.residual(), 0.0, 1e-13);
            ASSERT_GE(balance.merged, balance.swept);
        }
        std::uint64_t before = 0;
        for (const RunningDroplet& d : state.droplets) {
            EXPECT_GT(d.id, before);
            EXPECT_LT(d.id, state.next_id);
            EXPECT_TRUE(p.glass.holds(d.position));
            before = d.id;
        }
        EXPECT_GT(state.counts.wiped, 0U);
    }
}

// In ten minutes of heavy rain the balance does not drift, and the number of droplets does not grow.
TEST(Windshield, BalanceHoldsForTenMinutes)
{
    WindshieldParameters p = busyGlass();
    p.glass = Glass({.width = 0.06, .height = 0.06});
    p.rainfall = 25.0 * kMillimetrePerHour;
    p.forces.wetting.hysteresis = 0.3;
    p.streaks.film = 5e-6;
    p.wipers = {{.pivot = {0.03, -0.01}, .inner = 0.01, .outer = 0.06, .first = 0.3, .last = 2.5, .period = 20.0}};
    WindshieldState state = startWindshield(p);
    const double smallest = reachOf(p, std::numbers::pi / 6.0 * 1e-9);
    const auto bound = static_cast<std::size_t>(0.065 * 0.065 / (2.0 * std::sqrt(3.0) * smallest * smallest));
    for (int s = 0; s < 6000; ++s) {
        state = step(std::move(state), p, 0.1);
        ASSERT_LT(state.droplets.size(), bound) << "more than can lie side by side";
    }
    const WaterBalance balance = balanceOf(state);
    EXPECT_NEAR(balance.residual(), 0.0, 1e-13);
    EXPECT_GT(balance.left, 0.3 * balance.rained);
    EXPECT_GT(balance.wiped, 0.01 * balance.rained);
    EXPECT_GT(state.counts.raindrops, 50'000U);
    EXPECT_EQ(StillCells::of(state.still).slots.size(), StillCells::of(startWindshield(p).still).slots.size());
}

TEST(Windshield, CountsDropletsThatLeaveOverEachEdge)
{
    WindshieldParameters p = quietGlass();
    p.forces.gravity = 0.0;
    p.forces.wetting.hysteresis = 0.0;
    WindshieldState state = startWindshield(p);
    addRunning(state, {0.001, 0.1}, 1.0 * kMicrolitre, {-1.0, 0.0});
    addRunning(state, {0.199, 0.1}, 2.0 * kMicrolitre, {1.0, 0.0});
    addRunning(state, {0.1, 0.001}, 3.0 * kMicrolitre, {0.0, -1.0});
    addRunning(state, {0.1, 0.199}, 4.0 * kMicrolitre, {0.0, 1.0});
    state = step(std::move(state), p, kDt);
    EXPECT_TRUE(state.droplets.empty());
    EXPECT_EQ(state.counts.left, 4U);
    EXPECT_NEAR(balanceOf(state).left, 10.0 * kMicrolitre, 1e-22);
    EXPECT_EQ(state.tracks.size(), 4U);
}

TEST(CompensatedSum, LosesNoSmallTerms)
{
    CompensatedSum sum;
    sum.add(1.0);
    for (int k = 0; k < 1'000'000; ++k) {
        sum.add(1e-17);
    }
    EXPECT_DOUBLE_EQ(sum.value(), 1.0 + 1e-11);
    sum.add(-1.0);
    EXPECT_NEAR(sum.value(), 1e-11, 1e-20);
}

// ---- independence --------------------------------------------------------------------------------------------------

/// Whether each of some equal droplets, which only the fluctuation can start, moves at each of some times.
std::vector<std::vector<double>> motions(std::size_t count, int times, double dt)
{
    WindshieldParameters p = quietGlass();
    p.glass = Glass({.width = 0.4, .height = 0.4, .radius = 1e9, .slope = 0.0});
    p.fluctuation = {.acceleration = 2.0, .interval = 0.05};
    constexpr double kVolume = 5.0 * kMicrolitre;
    p.forces.wetting.sliding_angle = std::asin(2.5 / kStandardGravity);
    WindshieldState state = startWindshield(p);
    std::vector<std::vector<double>> series(count);
    const auto row = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    for (std::size_t k = 0; k < count; ++k) {
        const double apart = 0.4 / static_cast<double>(row + 1);
        addRunning(state, {apart * static_cast<double>(k % row + 1), apart * static_cast<double>(k / row + 1)},
                   kVolume);
    }
    const std::vector<RunningDroplet> places = state.droplets;
    for (int t = 0; t < times; ++t) {
        state = step(std::move(state), p, dt);
        for (std::size_t k = 0; k < count; ++k) {
            series[k].push_back(state.droplets[k].velocity == Vec2{} ? 0.0 : 1.0);
            state.droplets[k].position = places[k].position;  // back to its place, so that none leaves or merges
        }
    }
    return series;
}

double correlation(const std::vector<double>& a, std::size_t a_from, const std::vector<double>& b, std::size_t b_from)
{
    const std::size_t count = std::min(a.size() - a_from, b.size() - b_from);
    double sa = 0.0;
    double sb = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    double ab = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = a[a_from + k];
        const double y = b[b_from + k];
        sa += x;
        sb += y;
        aa += x * x;
        bb += y * y;
        ab += x * y;
    }
    const auto n = static_cast<double>(count);
    return (n * ab - sa * sb) / std::sqrt((n * aa - sa * sa) * (n * bb - sb * sb));
}

// If all moved together, the variance of the number that moves would be `count` times that of independent ones.
TEST(Windshield, DropletsMoveIndependently)
{
    constexpr std::size_t kCount = 100;
    const auto series = motions(kCount, 2000, 0.02);
    std::vector<double> together(series[0].size());
    double separate = 0.0;
    const auto variance = [](const std::vector<double>& a) {
        const double mean = std::accumulate(a.begin(), a.end(), 0.0) / static_cast<double>(a.size());
        double sum = 0.0;
        for (const double v : a) {
            sum += (v - mean) * (v - mean);
        }
        return sum / static_cast<double>(a.size());
    };
    for (const auto& one : series) {
        separate += variance(one);
        for (std::size_t t = 0; t < one.size(); ++t) {
            together[t] += one[t];
        }
    }
    EXPECT_GT(separate, 0.05 * kCount) << "some move, some do not";
    EXPECT_NEAR(variance(together) / separate, 1.0, 0.25);
    // Motions do not repeat: after the fluctuation has changed, no time is similar to an earlier one.
    for (std::size_t lag = 10; lag < 1000; lag += 7) {
        EXPECT_LT(std::abs(correlation(together, 0, together, lag)), 0.2) << lag;
    }
}

// After long rain, water leaves over the edges without a rhythm.
TEST(Windshield, DropletsLeaveWithoutARhythm)
{
    WindshieldParameters p = busyGlass();
    p.glass = Glass({.width = 0.08, .height = 0.05});
    WindshieldState state = after(startWindshield(p), p, 1.0 / 30.0, 300);
    std::vector<double> leaving;
    for (int k = 0; k < 3000; ++k) {
        const std::uint64_t before = state.counts.left;
        state = step(std::move(state), p, 1.0 / 30.0);
        leaving.push_back(static_cast<double>(state.counts.left - before));
    }
    EXPECT_GT(std::accumulate(leaving.begin(), leaving.end(), 0.0), 300.0);
    // The standard deviation for independent numbers is 1/√N; the largest of 300 rarely exceeds four of it.
    const double chance = 4.5 / std::sqrt(static_cast<double>(leaving.size()));
    for (std::size_t lag = 15; lag < 315; ++lag) {
        EXPECT_LT(std::abs(correlation(leaving, 0, leaving, lag)), chance) << lag;
    }
}

TEST(Windshield, FluctuationHasItsRootMeanSquare)
{
    // Without friction and forces, the gain of speed in a step is the fluctuation itself.
    WindshieldParameters p = quietGlass();
    p.glass = Glass({.width = 0.2, .height = 0.2, .radius = 1e9, .slope = 0.0});
    p.forces.wetting.hysteresis = 0.0;
    p.forces.wetting.viscosity_factor = 0.0;
    p.fluctuation = {.acceleration = 0.7, .interval = 0.1};
    WindshieldState state = startWindshield(p);
    addRunning(state, {0.1, 0.1}, 5.0 * kMicrolitre);
    double sum_x = 0.0;
    double squares_x = 0.0;
    double squares_y = 0.0;
    double product = 0.0;
    double max = 0.0;
    constexpr int kTimes = 20'000;
    for (int k = 0; k < kTimes; ++k) {
        state = step(std::move(state), p, 0.013);
        const Vec2 push = (1.0 / 0.013) * state.droplets[0].velocity;
        sum_x += push.x;
        squares_x += push.x * push.x;
        squares_y += push.y * push.y;
        product += push.x * push.y;
        max = std::max({max, std::abs(push.x), std::abs(push.y)});
        state.droplets[0].velocity = {};
        state.droplets[0].position = {0.1, 0.1};
    }
    // About eight steps are correlated, so 20 000 steps count as 2500 independent ones.
    EXPECT_NEAR(sum_x / kTimes, 0.0, 0.7 * 4.0 / 50.0);
    EXPECT_NEAR(std::sqrt(squares_x / kTimes), 0.7, 0.7 * 0.05);
    EXPECT_NEAR(std::sqrt(squares_y / kTimes), 0.7, 0.7 * 0.05);
    EXPECT_NEAR(product / kTimes, 0.0, 0.49 * 4.0 / 50.0);
    EXPECT_LT(max, std::sqrt(6.0) * 0.7);
    EXPECT_GT(max, 0.85 * std::sqrt(6.0) * 0.7);
}

// ---- the same bytes -----------------------------------------------------------------------------------------------

WindshieldParameters everything()
{
    WindshieldParameters p = busyGlass();
    p.glass = Glass({.width = 0.5, .height = 0.3});
    p.forces.wetting.hysteresis = 0.25;
    p.rainfall = 100.0 * kMillimetrePerHour;
    p.streaks.film = 1e-5;
    p.wipers = tandemWipers(p.glass, 1.5);
    p.splashes = true;
    return p;
}

TEST(Windshield, GivesTheSameBytesAtAnyNumberOfThreads)
{
    const WindshieldParameters p = everything();
    std::vector<std::string> bytes;
    for (const std::size_t threads : {1U, 2U, 4U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const WindshieldState state = after(startWindshield(p), p, 1.0 / 30.0, 33);
        EXPECT_GT(state.droplets.size(), 256U) << "too few to be shared among threads";
        bytes.push_back(bytesOf(state));
    }
    EXPECT_TRUE(bytes[0] == bytes[1]);
    EXPECT_TRUE(bytes[0] == bytes[2]);
}

TEST(Windshield, ContinuesExactlyFromItsBytes)
{
    const WindshieldParameters p = everything();
    const WindshieldState half = after(startWindshield(p), p, kDt, 40);
    EXPECT_GT(half.counts.wiped, 0U);
    EXPECT_GT(half.still.count(), 0U);
    EXPECT_FALSE(half.splashes.empty());
    const std::string bytes = bytesOf(half);
    const WindshieldState again = stateFromBytes(bytes, "state");
    EXPECT_TRUE(again == half);
    EXPECT_TRUE(bytesOf(again) == bytes);
    EXPECT_TRUE(bytesOf(after(again, p, kDt, 40)) == bytesOf(after(startWindshield(p), p, kDt, 80)));
}

TEST(Windshield, RejectsBytesThatAreNotAState)
{
    WindshieldParameters p = busyGlass();
    p.glass = Glass({.width = 0.03, .height = 0.03});
    WindshieldState rained = after(startWindshield(p), p, kDt, 30);
    rained.splashes.push_back(splashOf(2e-3, 10.0, p.forces.liquid).value());
    const std::string bytes = bytesOf(rained);
    const auto refuses = [](const std::string& text) {
        try {
            (void)stateFromBytes(text, "run.state");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            EXPECT_THAT(error.what(), AllOf(HasSubstr("run.state"), ::testing::Not(HasSubstr("\n"))));
            return true;
        }
        return false;
    };
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        ASSERT_TRUE(refuses(bytes.substr(0, size))) << size;
    }
    EXPECT_TRUE(refuses(bytes + "more"));
    // With any wrong byte, the state is either rejected or read.
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        std::string damaged = bytes;
        damaged[k] = static_cast<char>(damaged[k] ^ 0x5A);
        (void)refuses(damaged);
    }
}

// ---- arguments ----------------------------------------------------------------------------------------------------

TEST(Windshield, RejectsInvalidArguments)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](const auto& change) {
        WindshieldParameters p = quietGlass();
        change(p);
        try {
            (void)startWindshield(p);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            return std::string(error.what());
        }
        return std::string("no refusal");
    };
    using P = WindshieldParameters;
    EXPECT_THAT(refused([](P& p) { p.rainfall = -kMillimetrePerHour; }), AllOf(HasSubstr("rainfall"), HasSubstr("-1")));
    EXPECT_THAT(refused([&](P& p) { p.rainfall = nan; }), HasSubstr("rainfall"));
    EXPECT_THAT(refused([](P& p) { p.vehicle = constantSpeed(-1.0); }), HasSubstr("vehicle"));
    EXPECT_THAT(refused([](P& p) { p.still_diameter = 0.0; }), HasSubstr("still_diameter"));
    EXPECT_THAT(refused([](P& p) { p.still_diameter = 3e-3; }), HasSubstr("still_diameter"));
    EXPECT_THAT(refused([](P& p) { p.fluctuation.interval = 0.0; }), HasSubstr("fluctuation.interval"));
    EXPECT_THAT(refused([&](P& p) { p.fluctuation.acceleration = nan; }), HasSubstr("fluctuation.acceleration"));
    EXPECT_THAT(refused([](P& p) { p.streaks.film = -1e-6; }), HasSubstr("streaks.film"));
    EXPECT_THAT(refused([](P& p) { p.streaks.spacing = 0.0; }), HasSubstr("streaks.spacing"));
    EXPECT_THAT(refused([](P& p) { p.raindrops.min = 0.0; }), HasSubstr("raindrops"));
    EXPECT_THAT(refused([](P& p) { p.forces.wetting.hysteresis = 3.0; }), HasSubstr("hysteresis"));
    EXPECT_THAT(refused([](P& p) { p.glass = Glass({.width = 20.0, .height = 20.0, .radius = 50.0}); }),
                HasSubstr("area"));
    EXPECT_THAT(refused([](P& p) { p.wipers = {{.outer = 0.05}}; }), HasSubstr("wiper.outer"));
    const WindshieldParameters p = quietGlass();
    for (const double dt : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW((void)step(startWindshield(p), p, dt), Error);
    }
    WindshieldParameters other = p;
    other.glass = Glass();
    EXPECT_THROW((void)step(startWindshield(p), other, kDt), Error);
}

}  // namespace
}  // namespace droplet
