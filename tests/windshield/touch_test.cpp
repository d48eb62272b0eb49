// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/touch.h"

#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/windshield/balance.h"
#include "droplet/windshield/presets.h"
#include "droplet/windshield/state_bytes.h"

namespace droplet {
namespace {

using testing::Each;

WindshieldParameters dryGlass()
{
    WindshieldParameters parameters = windshieldPresetNamed("figure-3.12").parameters;
    parameters.rainfall = 0.0;
    parameters.vehicle = constantSpeed(0.0);
    parameters.fluctuation.acceleration = 0.0;
    return parameters;
}

double mistAt(const Mist& mist, Vec2 place)
{
    const auto column = static_cast<std::size_t>(place.x / mist.cell);
    const auto row = static_cast<std::size_t>(place.y / mist.cell);
    return mist.thickness[row * mist.columns + column];
}

WindshieldState after(WindshieldState state, const WindshieldParameters& parameters, double time, double dt = 0.02)
{
    for (int k = 0; k < std::lround(time / dt); ++k) {
        state = step(std::move(state), parameters, dt);
    }
    return state;
}

/// Glass with mist that grows no more.
WindshieldState misted(WindshieldParameters parameters, double thickness)
{
    parameters.mist = 1e-6;
    return after(startWindshield(parameters), parameters, thickness / parameters.mist);
}

TEST(Mist, GrowsWithTimeUntilItIsDense)
{
    const WindshieldParameters parameters = dryGlass();
    const Mist thin = misted(parameters, 4e-6).mist;
    EXPECT_THAT(thin.thickness, Each(testing::FloatNear(4e-6F, 1e-10F)));
    const WindshieldState dense = misted(parameters, 12e-6);
    EXPECT_THAT(dense.mist.thickness, Each(static_cast<float>(kDenseMist)));
    const WaterBalance balance = balanceOf(dense);
    EXPECT_NEAR(balance.condensed, balance.on_glass_mist, 1e-12 * balance.condensed);
    EXPECT_TRUE(startWindshield(parameters).mist.thickness.empty());
}

TEST(Mist, IsTakenAlongByDropletsThatRun)
{
    WindshieldParameters parameters = dryGlass();
    WindshieldState state = misted(parameters, 8e-6);
    constexpr double kVolume = 60.0 * kMicrolitre;
    state.droplets.push_back({state.next_id++, {0.7, 0.6}, {}, kVolume, 0.0, 0});
    state.sprayed.add(kVolume);
    state = after(std::move(state), parameters, 2.0);
    EXPECT_LT(mistAt(state.mist, {0.7, 0.55}), 1e-7);
    EXPECT_FLOAT_EQ(static_cast<float>(mistAt(state.mist, {0.75, 0.55})),
                    static_cast<float>(mistAt(state.mist, {0.1, 0.1})));
    EXPECT_NEAR(balanceOf(state).residual(), 0.0, 1e-12);
}

TEST(Mist, IsTakenByWipers)
{
    WindshieldParameters parameters = dryGlass();
    WindshieldState state = misted(parameters, 8e-6);
    parameters.wipers = tandemWipers(parameters.glass, 1.2);
    for (Wiper& wiper : parameters.wipers) {
        wiper.start = state.time;
    }
    state = after(std::move(state), parameters, 1.2);
    EXPECT_EQ(mistAt(state.mist, {0.5, 0.3}), 0.0);
    EXPECT_GT(mistAt(state.mist, {0.01, 0.79}), 7e-6);
    EXPECT_NEAR(balanceOf(state).residual(), 0.0, 1e-12);
}

TEST(Finger, ClearsItsPathAndLeavesTheWaterAsBeadsBesideIt)
{
    const WindshieldParameters parameters = dryGlass();
    WindshieldState state = misted(parameters, 8e-6);
    const double before = state.mist.volume();
    const FingerStroke stroke{{0.4, 0.4}, {0.8, 0.4}, 0.02};
    state = stroked(std::move(state), parameters, stroke);
    // The area of the stroke: a rectangle and two half discs; its edge is that of cells, within their width.
    const double area = 0.4 * 0.02 + std::numbers::pi * 0.01 * 0.01;
    EXPECT_NEAR((before - state.mist.volume()) / (8e-6 * area), 1.0, 0.002);
    EXPECT_EQ(mistAt(state.mist, {0.6, 0.4}), 0.0);
    EXPECT_GT(mistAt(state.mist, {0.6, 0.412}), 7.9e-6);
    double beads = 0.0;
    for (const StillDroplet& bead : state.arriving) {
        beads += bead.volume;
        const double away = std::abs(bead.position.y - 0.4);
        EXPECT_TRUE(away >= 0.01 || bead.position.x >= 0.81) << bead.position.x << ", " << bead.position.y;
    }
    EXPECT_NEAR(beads, before - state.mist.volume(), 1e-12 * before);
    EXPECT_GT(state.arriving.size(), 100U);
    state = after(std::move(state), parameters, 0.5);
    EXPECT_TRUE(state.arriving.empty());
    EXPECT_GT(state.still.count() + state.droplets.size(), 50U);
    EXPECT_NEAR(balanceOf(state).residual(), 0.0, 1e-12);
}

TEST(Finger, CarriesWaterAhead)
{
    // Beads ahead are taken along: after many short strokes the last one has more than a short stroke's own water.
    const WindshieldParameters parameters = dryGlass();
    WindshieldState state = misted(parameters, 8e-6);
    for (int k = 0; k < 40; ++k) {
        state = stroked(std::move(state), parameters, {{0.4 + 0.01 * k, 0.4}, {0.41 + 0.01 * k, 0.4}, 0.02});
        state = step(std::move(state), parameters, 1.0 / 60.0);
    }
    const double own = 8e-6 * 0.01 * 0.02;
    double ahead = 0.0;
    for (const StillDroplet& droplet : state.still.all()) {
        ahead = droplet.position.x > 0.805 ? std::max(ahead, droplet.volume) : ahead;
    }
    for (const RunningDroplet& droplet : state.droplets) {
        ahead = droplet.position.x > 0.805 ? std::max(ahead, droplet.volume) : ahead;
    }
    EXPECT_GT(ahead, 0.4 * own);
    EXPECT_NEAR(balanceOf(state).residual(), 0.0, 1e-12);
}

TEST(Finger, LeavesDryGlassAlone)
{
    const WindshieldParameters parameters = dryGlass();
    const WindshieldState state = startWindshield(parameters);
    EXPECT_EQ(stroked(state, parameters, {{0.1, 0.1}, {0.1, 0.1}}), state);
    EXPECT_EQ(stroked(state, parameters, {{-5.0, 0.1}, {9.0, 0.1}}), state);
}

TEST(Spray, GivesItsVolumeAtItsPlace)
{
    const WindshieldParameters parameters = dryGlass();
    WindshieldState state = sprayed(startWindshield(parameters), parameters, {{0.7, 0.4}, 0.1, 2000.0 * kMicrolitre});
    double volume = 0.0;
    Vec2 moment;
    double squares = 0.0;
    for (const StillDroplet& drop : state.arriving) {
        volume += drop.volume;
        moment = moment + drop.position;
        squares += (drop.position.x - 0.7) * (drop.position.x - 0.7);
        EXPECT_LT(drop.volume, 4.2 * kMicrolitre);
    }
    const auto count = static_cast<double>(state.arriving.size());
    EXPECT_NEAR(volume, 2000.0 * kMicrolitre, 1e-9 * kMicrolitre);
    // Means of many: within five standard errors.
    EXPECT_NEAR(moment.x / count, 0.7, 5.0 * 0.05 / std::sqrt(count));
    EXPECT_NEAR(moment.y / count, 0.4, 5.0 * 0.05 / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(squares / count), 0.05, 5.0 * 0.05 / std::sqrt(2.0 * count));
    state = step(std::move(state), parameters, 0.01);
    EXPECT_GT(state.droplets.size(), 10U);
    EXPECT_NEAR(balanceOf(state).residual(), 0.0, 1e-12);
}

TEST(Spray, BesideTheGlassIsLost)
{
    const WindshieldParameters parameters = dryGlass();
    WindshieldState state = sprayed(startWindshield(parameters), parameters, {{-3.0, 0.4}, 0.1, kMicrolitre});
    state = step(std::move(state), parameters, 0.01);
    EXPECT_DOUBLE_EQ(balanceOf(state).left, kMicrolitre);
    EXPECT_NEAR(balanceOf(state).residual(), 0.0, 1e-15);
}

TEST(Touch, IsRepeatedByItsBytes)
{
    const WindshieldParameters parameters = dryGlass();
    const auto touched = [&](WindshieldState state) {
        state = sprayed(std::move(state), parameters, {{0.7, 0.4}, 0.1, 100.0 * kMicrolitre});
        return stroked(std::move(state), parameters, {{0.6, 0.3}, {0.8, 0.5}});
    };
    const WindshieldState state = touched(misted(parameters, 5e-6));
    const WindshieldState read = stateFromBytes(bytesOf(state), "state");
    EXPECT_EQ(read, state);
    EXPECT_EQ(step(touched(read), parameters, 0.02), step(touched(state), parameters, 0.02));
}

TEST(Touch, RefusesValuesOutOfRange)
{
    const WindshieldParameters parameters = dryGlass();
    const WindshieldState state = startWindshield(parameters);
    EXPECT_THROW((void)sprayed(state, parameters, {{0.7, 0.4}, 0.0, kMicrolitre}), Error);
    EXPECT_THROW((void)sprayed(state, parameters, {{0.7, 0.4}, 0.1, 1.0}), Error);
    EXPECT_THROW((void)stroked(state, parameters, {{0.7, 0.4}, {NAN, 0.1}}), Error);
    EXPECT_THROW((void)stroked(state, parameters, {{0.7, 0.4}, {0.7, 0.1}, 1.0}), Error);
    WindshieldParameters wrong = parameters;
    wrong.mist = 1.0;
    EXPECT_THROW((void)startWindshield(wrong), Error);
}

}  // namespace
}  // namespace droplet
