// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/runoff.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>
#include <optional>

#include "droplet/error.h"
#include "droplet/windshield/state_bytes.h"
#include "droplet/windshield/touch.h"
#include "windshield/runoff_cells.h"
#include "windshields.h"

namespace droplet {
namespace {

using testing::after;
using testing::busyGlass;
using testing::quietGlass;

constexpr double kStep = 1.0 / 60.0;

WindshieldParameters pouring(double rainfall)
{
    WindshieldParameters p = busyGlass();
    p.rainfall = rainfall * kMillimetrePerHour;
    p.runoff = 1.0;
    return p;
}

double totalOf(const Runoff& film)
{
    return static_cast<double>(std::accumulate(film.thickness.begin(), film.thickness.end(), std::int64_t{0}));
}

/// Height of the middle of all water [m].
double heightOf(const Runoff& film)
{
    double moment = 0.0;
    for (std::size_t k = 0; k < film.thickness.size(); ++k) {
        moment += film.thickness[k] * (static_cast<double>(k / film.columns) + 0.5) * film.cell;
    }
    return moment / totalOf(film);
}

/// Film with a puddle in its middle.
Runoff puddle()
{
    Runoff film;
    layOut(film, {0.4, 0.4});
    pour(film, {0.2, 0.2}, 0.03, 3e-6);
    return film;
}

TEST(Runoff, KeepsAllWater)
{
    WindshieldParameters p = pouring(49.0);
    p.wipers = tandemWipers(p.glass, 2.0);
    const WindshieldState state = after(startWindshield(p), p, kStep, 600);
    const WaterBalance balance = balanceOf(state);
    EXPECT_GT(balance.on_glass_film, 0.02 * balance.rained);
    EXPECT_GT(balance.wiped, 0.0);
    EXPECT_GT(balance.left, 0.0);
    EXPECT_LT(std::abs(balance.residual()), 1e-14);
}

TEST(Runoff, PouredWaterIsThereToTheLastBit)
{
    Runoff film;
    layOut(film, {0.1, 0.1});
    double poured = 0.0;
    for (int k = 0; k < 1000; ++k) {
        const double volume = 1e-12 * (k + 0.3);
        pour(film, {0.0001 * k, 0.05}, 1e-5 * k, volume);
        poured += volume;
    }
    EXPECT_NEAR(film.volume() / poured, 1.0, 1e-12);
    EXPECT_LT(film.rest, Runoff::kThickness * film.cell * film.cell);
}

TEST(Runoff, RunsDownWithoutWindAndIsConserved)
{
    Runoff film = puddle();
    const double volume = film.volume();
    const double height = heightOf(film);
    double left = 0.0;
    for (int k = 0; k < 30; ++k) {
        left += flow(film, {}, kStep, [](Vec2) { return Vec2{0.0, -7.0}; });
    }
    EXPECT_EQ(left, 0.0);
    EXPECT_NEAR(film.volume() / volume, 1.0, 1e-15);
    EXPECT_LT(heightOf(film), height - 0.01);
    EXPECT_THAT(film.thickness, ::testing::Each(::testing::Ge(0)));
    for (int k = 0; k < 600; ++k) {
        left += flow(film, {}, kStep, [](Vec2) { return Vec2{0.0, -7.0}; });
    }
    EXPECT_GT(left, 0.3 * volume);
    EXPECT_NEAR((film.volume() + left) / volume, 1.0, 1e-12);
}

TEST(Runoff, MirrorsWithTheForceOnAverage)
{
    Runoff up = puddle();
    Runoff down = puddle();
    const double height = heightOf(up);
    for (int k = 0; k < 20; ++k) {
        flow(up, {}, kStep, [](Vec2) { return Vec2{0.0, 7.0}; });
        flow(down, {}, kStep, [](Vec2) { return Vec2{0.0, -7.0}; });
    }
    EXPECT_NEAR((heightOf(up) - height) / (height - heightOf(down)), 1.0, 0.3);
}

// Three times as fast as the water of a film of 80 um, and no faster than frames show.
TEST(Runoff, WavesRunWithTheForce)
{
    const auto drift = [](Vec2 force) {
        Runoff film = puddle();
        for (int k = 0; k < 30; ++k) {
            flow(film, {}, kStep, [force](Vec2) { return force; });
        }
        return film.drift;
    };
    const double per_force = 0.5 * 80e-6 * 80e-6 * Liquid{}.density / 1.0e-3;
    EXPECT_EQ(drift({}), (Vec2{}));
    const Vec2 slow = drift({1.0, -2.0});
    EXPECT_NEAR(slow.x, per_force, 1e-12);
    EXPECT_NEAR(slow.y, -2.0 * per_force, 1e-12);
    EXPECT_NEAR(drift({0.0, 90.0}).y, 0.5 * 36e-3, 1e-12);
}

TEST(Runoff, StaysWithoutAForce)
{
    Runoff film;
    layOut(film, {0.1, 0.1});
    pour(film, {0.05, 0.05}, 1.0, 0.1 * 0.1 * 60e-6);  // as thick everywhere
    const Runoff before = film;
    EXPECT_EQ(flow(film, {}, kStep, [](Vec2) { return Vec2{}; }), 0.0);
    EXPECT_NEAR(totalOf(film), totalOf(before), 0.0);
    for (std::size_t k = 0; k < film.thickness.size(); ++k) {
        EXPECT_NEAR(film.thickness[k], before.thickness[k], 2.0);
    }
}

TEST(Runoff, LeavesWhereThereIsNoGlass)
{
    Runoff film = puddle();
    const double volume = film.volume();
    const double left = flow(film, {}, kStep, [](Vec2) { return std::optional<Vec2>(); });
    EXPECT_NEAR((left + film.rest) / volume, 1.0, 1e-15);
    EXPECT_EQ(totalOf(film), 0.0);
}

TEST(Runoff, IsThickerInHeavierRain)
{
    const auto film_of = [](double rainfall) {
        const WindshieldParameters p = pouring(rainfall);
        return balanceOf(after(startWindshield(p), p, kStep, 900)).on_glass_film;
    };
    const double light = film_of(5.0);
    const double heavy = film_of(25.0);
    const double heaviest = film_of(50.0);
    EXPECT_LT(2.0 * light, heavy);
    EXPECT_LT(heavy, heaviest);
}

TEST(Runoff, LosesInSteadyRainWhatRainsOnIt)
{
    const WindshieldParameters p = pouring(50.0);
    WindshieldState state = after(startWindshield(p), p, kStep, 1800);
    const WaterBalance before = balanceOf(state);
    const WaterBalance later = balanceOf(after(std::move(state), p, kStep, 1800));
    EXPECT_NEAR((later.left - before.left) / (later.rained - before.rained), 1.0, 0.1);
}

TEST(Runoff, BreaksUpIntoDropletsAfterTheRain)
{
    WindshieldParameters p = pouring(50.0);
    WindshieldState state = after(startWindshield(p), p, kStep, 300);
    p.rainfall = 0.0;
    p.vehicle = constantSpeed(0.0);
    const double film = balanceOf(state).on_glass_film;
    state = after(std::move(state), p, kStep, 1800);
    const WaterBalance dry = balanceOf(state);
    EXPECT_LT(dry.on_glass_film, 0.5 * film);
    EXPECT_GT(dry.on_glass_still, 0.0);
    EXPECT_LT(std::abs(dry.residual()), 1e-14);
}

TEST(Runoff, FingersTakeItAndKeepItsWater)
{
    const WindshieldParameters p = pouring(100.0);
    WindshieldState state = after(startWindshield(p), p, kStep, 600);
    const double before = state.film.volume();
    ASSERT_GT(thicknessAt(state.film, {0.1, 0.075}) + thicknessAt(state.film, {0.104, 0.075}), 0.0);
    state = stroked(std::move(state), p, {{0.03, 0.075}, {0.17, 0.075}, 0.02});
    EXPECT_LT(state.film.volume(), before);
    EXPECT_EQ(thicknessAt(state.film, {0.1, 0.075}), 0.0);
    EXPECT_LT(std::abs(balanceOf(state).residual()), 1e-14);
}

TEST(Runoff, IsNotThereUnlessItIsAskedFor)
{
    WindshieldParameters p = pouring(50.0);
    p.runoff = 0.0;
    EXPECT_TRUE(after(startWindshield(p), p, kStep, 60).film.thickness.empty());
    p.runoff = -1.0;
    EXPECT_THROW(startWindshield(p), Error);
}

TEST(Runoff, GoesThroughBytes)
{
    const WindshieldParameters p = pouring(50.0);
    const WindshieldState state = after(startWindshield(p), p, kStep, 120);
    ASSERT_GT(state.film.volume(), 0.0);
    const WindshieldState read = stateFromBytes(bytesOf(state), "state");
    EXPECT_EQ(read, state);
    EXPECT_EQ(after(read, p, kStep, 10), after(state, p, kStep, 10));
}

}  // namespace
}  // namespace droplet
