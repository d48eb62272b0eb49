// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/splash.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "droplet/windshield/balance.h"
#include "windshield/windshields.h"

namespace droplet {
namespace {

using testing::after;
using testing::quietGlass;

constexpr double kPi = std::numbers::pi;

TEST(Splash, NeedsAHardImpact)
{
    const Liquid water;
    // K = D^(3/4) U^(5/4) ρ^(3/4) γ^(-1/2) η^(-1/4) is 57.7 at this speed.
    const double diameter = 0.5e-3;
    const double speed = std::pow(57.7 * std::sqrt(water.surface_tension) * std::pow(1.002e-3, 0.25) /
                                      (std::pow(diameter, 0.75) * std::pow(water.density, 0.75)),
                                  0.8);
    EXPECT_FALSE(splashOf(diameter, 0.999 * speed, water));
    EXPECT_TRUE(splashOf(diameter, 1.001 * speed, water));
    EXPECT_FALSE(splashOf(diameter, 0.0, water));
    EXPECT_FALSE(splashOf(diameter, -10.0, water)) << "it moves away from the glass";
    EXPECT_TRUE(splashOf(2e-3, 6.0, water)) << "a raindrop that falls on a car at rest";
    EXPECT_FALSE(splashOf(0.1e-3, 6.0, water)) << "drizzle";
}

TEST(Splash, SpreadsToAFourthRootAndLastsAsADropOscillates)
{
    const Liquid water;
    const Splash slow = splashOf(2e-3, 6.0, water).value();
    const Splash fast = splashOf(2e-3, 12.0, water).value();
    const Splash large = splashOf(4e-3, 12.0, water).value();
    EXPECT_NEAR(slow.radius, 1e-3 * std::pow(998.2 * 2e-3 * 36.0 / 0.0728, 0.25), 1e-12);
    EXPECT_NEAR(fast.radius / slow.radius, std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(large.radius / fast.radius, std::pow(2.0, 1.25), 1e-12);
    EXPECT_EQ(fast.lifetime, slow.lifetime);
    EXPECT_NEAR(large.lifetime / fast.lifetime, std::pow(2.0, 1.5), 1e-12);
    EXPECT_NEAR(fast.lifetime, 2.6 * std::sqrt(998.2 * 1e-9 / 0.0728), 1e-12);
}

TEST(Splash, RingsGrowAsTheRootOfTimeThenRecoil)
{
    Splash splash = splashOf(3e-3, 10.0, Liquid()).value();
    splash.time = 7.0;
    EXPECT_FALSE(ringOf(splash, 6.9999));
    EXPECT_FALSE(ringOf(splash, 7.0 + 1.0001 * splash.lifetime));
    const auto at = [&](double age) { return ringOf(splash, 7.0 + age).value(); };
    EXPECT_EQ(at(0.0).radius, 1.5e-3);
    EXPECT_NEAR(at(1e-3).radius, 1.1 * std::sqrt(10.0 * 3e-3 * 1e-3), 1e-9);
    EXPECT_NEAR(at(1e-3).radius / at(0.25e-3).radius, 2.0, 1e-6);
    double largest = 0.0;
    double before = 0.0;
    bool shrinks = false;
    for (int k = 0; k < 1000; ++k) {
        const SplashRing ring = at(1e-3 * k * splash.lifetime);
        largest = std::max(largest, ring.radius);
        EXPECT_FALSE(shrinks && ring.radius > before) << "it grows once";
        shrinks = shrinks || ring.radius < before;
        before = ring.radius;
        // Its rim, half a disc around the ring, has the raindrop's water.
        EXPECT_NEAR(kPi * kPi * ring.half_width * ring.half_width * ring.radius, kPi / 6.0 * 27e-9, 1e-18);
        EXPECT_NEAR(ring.age, 1e-3 * k, 1e-9);
    }
    EXPECT_LE(largest, splash.radius * (1.0 + 1e-12));
    EXPECT_GT(largest, 0.98 * splash.radius);
    EXPECT_NEAR(before, 1.5e-3, 0.02 * splash.radius) << "as wide as the raindrop in the end";
}

WindshieldParameters downpour()
{
    WindshieldParameters p = quietGlass();
    p.glass = Glass({.width = 0.5, .height = 0.5, .radius = 1e6, .slope = 0.0});
    p.rainfall = 100.0 * kMillimetrePerHour;
    p.splashes = true;
    return p;
}

TEST(Splash, ThatArePresentAreThoseThatLast)
{
    const WindshieldParameters p = downpour();
    // On average there are ∫ f(D) lifetime(D) dD per area, whatever the step: by Little's law.
    const RainImpacts impacts{raindropSizes(p.rainfall), p.raindrops, 0.0};
    double expected = 0.0;
    constexpr double kWidth = 1e-6;
    for (double d = p.raindrops.min + 0.5 * kWidth; d < p.raindrops.max; d += kWidth) {
        if (const std::optional<Splash> splash = splashOf(d, terminalSpeed(d), p.forces.liquid)) {
            expected += 0.25 * kWidth * impacts.density(d, Exposure::ofSlope(0.0)) * splash->lifetime;
        }
    }
    for (const double dt : {1.0 / 30.0, 1.0 / 240.0}) {
        WindshieldState state = startWindshield(p);
        state = after(std::move(state), p, dt, 20);
        double mean = 0.0;
        constexpr int kSteps = 300;
        for (int k = 0; k < kSteps; ++k) {
            state = step(std::move(state), p, dt);
            mean += static_cast<double>(state.splashes.size()) / kSteps;
            double before = 0.0;
            for (const Splash& splash : state.splashes) {
                EXPECT_TRUE(ringOf(splash, state.time)) << "splashes of the past are forgotten";
                EXPECT_TRUE(p.glass.holds(splash.position));
                EXPECT_GE(splash.time, before);
                before = splash.time;
            }
        }
        // Steps of 1/30 s are independent; those of 1/240 s share splashes that last several of them.
        const double independent = kSteps * std::min(1.0, dt / 0.02);
        EXPECT_NEAR(mean, expected, 4.0 * std::sqrt(expected / independent)) << dt;
    }
}

TEST(Splash, TakesNoWater)
{
    WindshieldParameters p = testing::busyGlass();
    const WindshieldState dry = after(startWindshield(p), p, 1.0 / 60.0, 60);
    EXPECT_TRUE(dry.splashes.empty()) << "without the option there are none";
    p.splashes = true;
    WindshieldState wet = after(startWindshield(p), p, 1.0 / 60.0, 60);
    EXPECT_FALSE(wet.splashes.empty());
    EXPECT_LT(std::abs(balanceOf(wet).residual()), 1e-12);
    wet.splashes.clear();
    EXPECT_TRUE(wet == dry) << "all else is the same";
}

TEST(Splash, EndsUnderAWiper)
{
    WindshieldParameters p = downpour();
    p.rainfall = 0.0;
    p.wipers = {{.pivot = {0.25, 0.0}, .inner = 0.0, .outer = 0.4}};
    WindshieldState state = startWindshield(p);
    Splash splash = splashOf(4e-3, 10.0, p.forces.liquid).value();
    splash.lifetime = 10.0;
    for (const Vec2 place : {Vec2{0.25, 0.3}, Vec2{0.25, 0.45}}) {
        splash.position = place;
        state.splashes.push_back(splash);
    }
    state = after(std::move(state), p, 1.0 / 60.0, 36);
    ASSERT_EQ(state.splashes.size(), 1U);
    EXPECT_EQ(state.splashes.front().position, (Vec2{0.25, 0.45})) << "beyond the blade's end";
}

}  // namespace
}  // namespace droplet
