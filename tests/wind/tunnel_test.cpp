// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind/tunnel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "droplet/error.h"

namespace droplet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr double kPi = std::numbers::pi;

double between(std::mt19937_64& random, double from, double to)
{
    return from + (to - from) * static_cast<double>(random() >> 11U) * 0x1p-53;
}

double anyOf(std::mt19937_64& random, double from, double to)
{
    return std::exp(between(random, std::log(from), std::log(to)));
}

/// Hemispheres in a deep boundary layer with n = ½.
ForceModel hemispheres(double hysteresis)
{
    ForceModel model;
    model.wetting.contact_angle = 0.5 * kPi;
    model.wetting.hysteresis = hysteresis;
    model.air.boundary_layer = 10e-3;
    return model;
}

double hemisphere(double radius)
{
    return 2.0 / 3.0 * kPi * radius * radius * radius;
}

// A hemisphere slides when r > λ √(3Δ/(4 sin α)), λ the capillary length.
TEST(CriticalVolume, OfHemispheresMatchesTheClosedForm)
{
    EXPECT_NEAR(*criticalVolume(hemispheres(0.5), 0.5 * kPi), 9.75e-9, 0.01e-9);
    EXPECT_NEAR(*criticalVolume(hemispheres(0.05), 0.5 * kPi), 0.31e-9, 0.005e-9);
    EXPECT_NEAR(std::cbrt(*criticalVolume(hemispheres(0.5), 0.5 * kPi) / (2.0 / 3.0 * kPi)), 1.67e-3, 0.005e-3);
    std::mt19937_64 random(1);
    for (int k = 0; k < 100; ++k) {
        const double hysteresis = between(random, 0.01, 1.5);
        const double slope = between(random, 1.0, 90.0) * kDegree;
        const double radius = *capillaryLength({}, 9.81) * std::sqrt(0.75 * hysteresis / std::sin(slope));
        EXPECT_NEAR(*criticalVolume(hemispheres(hysteresis), slope) / hemisphere(radius), 1.0, 1e-13);
    }
    EXPECT_FALSE(criticalVolume(hemispheres(0.5), 0.0).has_value()) << "on the level nothing runs";
    EXPECT_FALSE(criticalVolume(hemispheres(0.0), 1.0).has_value()) << "without hysteresis everything does";
    ForceModel model = hemispheres(0.0);
    model.wetting.sliding_angle = 10.0 * kDegree;
    EXPECT_FALSE(criticalVolume(model, 20.0 * kDegree).has_value()) << "every volume begins at one slope";
}

// U₀² = (8/3) (ρ/ρ_a) g δ sin α / C_D and U±² = U₀² (1 ± (r_c/r)²).
TEST(Thresholds, OfHemispheresMatchTheClosedForm)
{
    std::mt19937_64 random(2);
    for (int k = 0; k < 200; ++k) {
        ForceModel model = hemispheres(between(random, 0.01, 0.6));
        model.air.drag_coefficient = between(random, 0.3, 2.0);
        const double slope = between(random, 5.0, 90.0) * kDegree;
        const double radius = between(random, 0.5e-3, 9e-3);
        const double neutral = 8.0 / 3.0 * model.liquid.density / model.air.density * 9.81 * model.air.boundary_layer *
                               std::sin(slope) / model.air.drag_coefficient;
        const double ratio = *capillaryLength({}, 9.81) / radius;
        const double held = 0.75 * model.wetting.hysteresis / std::sin(slope) * ratio * ratio;
        const Thresholds found = thresholdsOf(forcesOn(model, hemisphere(radius)), slope);
        EXPECT_NEAR(*found.upper, std::sqrt(neutral * (1.0 + held)), 1e-12 * *found.upper);
        ASSERT_EQ(found.lower.has_value(), held < 1.0);
        if (found.lower) {
            EXPECT_NEAR(*found.lower, std::sqrt(neutral * (1.0 - held)), 1e-9 * *found.upper);
        }
    }
}

TEST(Thresholds, OfTheMeasuredPlaneAreNearTheMeasuredBand)
{
    const ForcePreset& preset = forcePresetNamed("hashimoto");
    const Thresholds found = thresholdsOf(forcesOn(preset.model, preset.reference_volume), preset.slope);
    EXPECT_NEAR(*found.upper / *found.lower, 1.37, 0.005);
    const double held = std::sin(10.0 * kDegree) / std::sin(35.0 * kDegree);
    EXPECT_NEAR(*found.lower, std::sqrt(85.0 * (1.0 - held)), 1e-12);
    EXPECT_NEAR(*found.upper, std::sqrt(85.0 * (1.0 + held)), 1e-12);
    // All volumes are within 15 % of the measured band.
    for (const double volume : preset.volumes) {
        const auto distance =
            distanceFrom(kMeasuredStillBand, thresholdsOf(forcesOn(preset.model, volume), preset.slope));
        EXPECT_LT(std::abs(distance->lower), 0.15) << volume;
        EXPECT_LT(std::abs(distance->upper), 0.15) << volume;
    }
    // With the sliding angle for every volume, all have the same band.
    ForceModel model = preset.model;
    model.wetting.sliding_angle = 10.0 * kDegree;
    for (const double volume : preset.volumes) {
        const Thresholds same = thresholdsOf(forcesOn(model, volume), preset.slope);
        EXPECT_NEAR(*same.lower, *found.lower, 1e-12);
        EXPECT_NEAR(*same.upper, *found.upper, 1e-12);
    }
}

TEST(Thresholds, OfTheThesisAreFittedToTheMeasuredBand)
{
    const ForcePreset& preset = forcePresetNamed("thesis");
    const Thresholds found = thresholdsOf(forcesOn(preset.model, preset.reference_volume), preset.slope);
    EXPECT_NEAR(*found.lower, 7.0, 1e-12);
    EXPECT_NEAR(*found.upper, 11.0, 1e-12);
    const DropletForces forces = forcesOn(preset.model, preset.reference_volume);
    const double weight = forces.weight * std::sin(preset.slope);
    EXPECT_NEAR(std::sqrt(weight / forces.drag), 9.2, 0.05) << "neutral wind";
    EXPECT_NEAR(forces.retention / weight, 0.42, 0.005) << "(r_c/r)²";
    const auto distance = distanceFrom(kMeasuredStillBand, found);
    EXPECT_NEAR(distance->lower, 0.0, 1e-13);
    EXPECT_NEAR(distance->upper, 0.0, 1e-13);
    EXPECT_FALSE(distanceFrom(kMeasuredStillBand, {}).has_value());
}

TEST(Thresholds, AreMissingWhereNothingMoves)
{
    ForceModel model = hemispheres(0.5);
    const Thresholds level = thresholdsOf(forcesOn(model, 30e-9), 0.0);
    EXPECT_FALSE(level.lower.has_value());
    EXPECT_TRUE(level.upper.has_value());
    model.air.density = 0.0;
    EXPECT_FALSE(thresholdsOf(forcesOn(model, 30e-9), 0.5 * kPi).upper.has_value());
    EXPECT_FALSE(thresholdsOf(forcesOn(model, 30e-9), 0.5 * kPi).lower.has_value());
    EXPECT_FALSE(tearOffWind(model, capOf(30e-9, 1.0)).has_value());
}

TEST(SheddingWind, HasTheCriticalWeberNumber)
{
    const ForceModel model;
    for (const auto& [height, wind] : {std::pair(2.5e-3, 13.5), std::pair(3e-3, 12.3), std::pair(4e-3, 10.6)}) {
        CapSize cap;
        cap.height = height;
        EXPECT_NEAR(*tearOffWind(model, cap), wind, 0.1) << height;
    }
}

// The regimes on both sides of a threshold match the threshold.
TEST(Thresholds, SeparateTheRegimes)
{
    std::mt19937_64 random(3);
    for (int k = 0; k < 300; ++k) {
        ForceModel model;
        model.wetting.contact_angle = between(random, 20.0, 160.0) * kDegree;
        model.wetting.hysteresis = between(random, 0.01, 1.0);
        model.air.profile_exponent = between(random, 0.0, 1.0);
        model.air.boundary_layer = anyOf(random, 1e-4, 1e-1);
        const double slope = between(random, 0.0, 90.0) * kDegree;
        const DropletForces forces = forcesOn(model, anyOf(random, 1e-10, 1e-6));
        const Thresholds found = thresholdsOf(forces, slope);
        const auto at = [&](double wind) { return regimeOf(forces, drivingForce(forces, slope, wind)); };
        EXPECT_EQ(at(*found.upper * (1.0 + 1e-9)), Regime::Climbs);
        EXPECT_EQ(at(*found.upper * (1.0 - 1e-9)), Regime::Still);
        if (found.lower) {
            EXPECT_EQ(at(*found.lower * (1.0 - 1e-9)), Regime::RunsDown);
            EXPECT_EQ(at(*found.lower + 1e-9 * *found.upper), Regime::Still);
            EXPECT_EQ(at(0.0), Regime::RunsDown);
        } else {
            EXPECT_EQ(at(0.0), Regime::Still);
        }
    }
}

// regimeChanges() is compared with the regimes of many volumes.
TEST(RegimeChanges, AreCompleteOnAnyProfile)
{
    std::mt19937_64 random(4);
    std::size_t max = 0;
    for (int k = 0; k < 300; ++k) {
        ForceModel model;
        model.wetting.contact_angle = between(random, 20.0, 160.0) * kDegree;
        model.wetting.hysteresis = between(random, 0.01, 1.0);
        if (k % 4 == 0) {
            model.wetting.sliding_angle = between(random, 1.0, 60.0) * kDegree;
        }
        model.air.profile_exponent = k % 5 == 0 ? 0.5 : between(random, 0.0, 1.5);
        model.air.boundary_layer = k % 7 == 0 ? 0.0 : anyOf(random, 1e-4, 1e-1);
        const TunnelSetting setting{between(random, 5.0, 90.0) * kDegree, anyOf(random, 1.0, 50.0)};
        const VolumeRange range{1e-12, 1e-4};
        const auto changes = regimeChanges(model, setting, range);
        max = std::max(max, changes.size());
        const auto at = [&](double volume) {
            const DropletForces forces = forcesOn(model, volume);
            return regimeOf(forces, drivingForce(forces, setting.slope, setting.wind));
        };
        for (const RegimeChange& change : changes) {
            EXPECT_EQ(at(change.volume * (1.0 - 1e-7)), change.below) << k;
            EXPECT_EQ(at(change.volume * (1.0 + 1e-7)), change.above) << k;
        }
        Regime now = at(range.min);
        std::size_t next = 0;
        constexpr int kVolumes = 2000;
        for (int i = 0; i <= kVolumes; ++i) {
            const double volume = range.min * std::pow(range.max / range.min, static_cast<double>(i) / kVolumes);
            while (next < changes.size() && changes[next].volume < volume) {
                EXPECT_EQ(changes[next].below, now) << k;
                now = changes[next++].above;
            }
            const double apart = next > 0 ? volume / changes[next - 1].volume : 2.0;
            const double before = next < changes.size() ? changes[next].volume / volume : 2.0;
            if (apart > 1.0 + 1e-7 && before > 1.0 + 1e-7) {
                ASSERT_EQ(at(volume), now) << k << " " << volume;
            }
        }
    }
    EXPECT_GE(max, 3U) << "parameters in which all regimes occur";
}

// Hooshanginejad and Lee (2022): at one wind the tiniest stick, small ones go up, medium ones stay, large ones go down.
//
// In this model this holds at every slope α > 0, wind V > 0 and hysteresis Δ > 0 if n < ½. Proof, with x = V_d^(2/3):
// - The downward force over V_d is W/V_d − D/V_d − F/V_d: W/V_d is constant, D/V_d ∝ V_d^((2n−1)/3) or V_d^(−1/3),
//   F/V_d ∝ V_d^(−2/3). So it rises from −∞ to a positive limit: droplets run down from one volume on.
// - The upward force over V_d^(1/3) is D/V_d^(1/3) − w x − f. D/V_d^(1/3) is the smaller of terms ∝ x^(½+n) and ∝
// x^(½),
//   which meet at the edge of the boundary layer: it is concave. So is the sum, which is negative at x = 0 and at large
//   x: the volumes that climb, if there are any, are an interval.
// - No droplet both climbs and runs down. So the interval lies below that volume, with still droplets between.
// - D rises with V at every volume. So the interval grows, and the volume from which droplets run down rises.
// With n ≥ ½ it does not hold: drag is then ∝ V_d or grows faster, and a wind that lifts small droplets lifts all that
// are lower than the layer.
TEST(Regimes, AreInOrderOfVolume)
{
    std::mt19937_64 random(5);
    int with_all = 0;
    for (int k = 0; k < 300; ++k) {
        ForceModel model;
        model.wetting.contact_angle = between(random, 20.0, 160.0) * kDegree;
        model.wetting.hysteresis = between(random, 0.005, 0.8);
        model.air.profile_exponent = between(random, 0.0, 0.45);
        model.air.boundary_layer = anyOf(random, 1e-4, 1e-2);
        model.liquid.surface_tension = between(random, 0.02, 0.5);
        model.liquid.density = between(random, 500.0, 14000.0);
        const double slope = between(random, 3.0, 90.0) * kDegree;
        const double slow = anyOf(random, 3.0, 60.0);
        constexpr VolumeRange kAll{1e-24, 1e12};
        double largest_climbing = 0.0;
        double min_running = 0.0;
        for (const double wind : {slow, 1.1 * slow, 1.5 * slow}) {
            const auto changes = regimeChanges(model, {slope, wind}, kAll);
            ASSERT_TRUE(changes.size() == 1 || changes.size() == 3) << changes.size();
            EXPECT_EQ(changes.front().below, Regime::Still) << "the tiniest stick";
            EXPECT_EQ(changes.back().below, Regime::Still);
            EXPECT_EQ(changes.back().above, Regime::RunsDown) << "large ones run down";
            EXPECT_GT(changes.back().volume, min_running);
            min_running = changes.back().volume;
            if (changes.size() == 3) {
                ++with_all;
                EXPECT_EQ(changes[0].above, Regime::Climbs);
                EXPECT_EQ(changes[1].above, Regime::Still);
                EXPECT_GT(changes[1].volume, largest_climbing) << "a faster wind lifts larger ones";
                largest_climbing = changes[1].volume;
            } else {
                EXPECT_EQ(largest_climbing, 0.0) << "what climbed in a slower wind climbs";
            }
        }
    }
    EXPECT_GT(with_all, 100) << "parameters in which all regimes occur";
}

// Figure 3.3: in a slow wind droplets run down, larger ones faster; in a fast one they climb, larger ones faster.
//
// In this model this holds for droplets lower than the boundary layer if n = ½ and hysteresis follows eq. 3.2. Proof:
// accelerations from rest are W/m − D/m − F/m and D/m − W/m − F/m. W/m does not depend on the volume, nor does D/m as
// S y ∝ V_d, and F/m ∝ V_d^(−2/3) falls. The first part alone needs only n ≤ ½, so that D/m does not rise; the second
// alone needs n ≥ ½ and the limit of the height. Terminal speeds, m a/c with m/c ∝ V_d^(2/3), follow.
TEST(Regimes, LargerDropletsAreFasterInBothDirections)
{
    std::mt19937_64 random(6);
    int down = 0;
    int up = 0;
    for (int k = 0; k < 400; ++k) {
        ForceModel model;
        model.wetting.contact_angle = between(random, 20.0, 160.0) * kDegree;
        model.wetting.hysteresis = between(random, 0.005, 0.5);
        model.wetting.viscosity_factor = between(random, 0.01, 1.0);
        model.air.boundary_layer = anyOf(random, 2e-3, 2e-2);
        model.air.profile_exponent = k % 3 == 0   ? 0.5
                                     : k % 3 == 1 ? between(random, 0.0, 0.5)
                                                  : between(random, 0.5, 1.0);
        const double slope = between(random, 10.0, 90.0) * kDegree;
        const double small = anyOf(random, 1e-10, 1e-7);
        const double large = small * between(random, 1.01, 5.0);
        const bool is_low = capOf(large, model.wetting.contact_angle).height < model.air.boundary_layer;
        const double n = model.air.profile_exponent;
        for (const double wind : {0.0, 2.0, 5.0, 10.0, 15.0, 25.0, 40.0}) {
            const DropletForces a = forcesOn(model, small);
            const DropletForces b = forcesOn(model, large);
            const double drive_a = drivingForce(a, slope, wind);
            const double drive_b = drivingForce(b, slope, wind);
            const double rate_a = acceleration(a, drive_a, 0.0);
            const double rate_b = acceleration(b, drive_b, 0.0);
            if (n <= 0.5 && rate_a < 0.0) {
                ++down;
                EXPECT_LT(rate_b, rate_a) << k << " " << wind;
                EXPECT_LT(*terminalVelocity(b, drive_b), *terminalVelocity(a, drive_a));
            }
            if (n >= 0.5 && is_low && rate_a > 0.0) {
                ++up;
                EXPECT_GT(rate_b, rate_a) << k << " " << wind;
                EXPECT_GT(*terminalVelocity(b, drive_b), *terminalVelocity(a, drive_a));
            }
        }
    }
    EXPECT_GT(down, 100);
    EXPECT_GT(up, 100);
}

TunnelSweep smallSweep()
{
    TunnelSweep what;
    what.volumes = {10e-9, 30e-9};
    what.winds = {0.0, 9.0, 16.0};
    what.slopes = {20.0 * kDegree, 35.0 * kDegree};
    what.hystereses = {0.05, 0.3};
    return what;
}

TEST(Sweep, HasEveryCombinationInOrder)
{
    const TunnelSweep what = smallSweep();
    const Tunnel tunnel = sweep(what);
    ASSERT_THAT(tunnel.cases, SizeIs(8));
    ASSERT_THAT(tunnel.rows, SizeIs(24));
    std::size_t c = 0;
    for (const double hysteresis : what.hystereses) {
        for (const double slope : what.slopes) {
            for (const double volume : what.volumes) {
                const TunnelCase& found = tunnel.cases[c];
                EXPECT_EQ(found.hysteresis, hysteresis);
                EXPECT_EQ(found.slope, slope);
                EXPECT_EQ(found.cap.volume, volume);
                ForceModel model = what.model;
                model.wetting.hysteresis = hysteresis;
                const DropletForces forces = forcesOn(model, volume);
                for (std::size_t w = 0; w < what.winds.size(); ++w) {
                    const TunnelRow& row = tunnel.rows[c * what.winds.size() + w];
                    const double driving = drivingForce(forces, slope, what.winds[w]);
                    EXPECT_EQ(row.driving, driving);
                    EXPECT_EQ(row.acceleration, acceleration(forces, driving, 0.0));
                    EXPECT_EQ(row.terminal_velocity, terminalVelocity(forces, driving));
                    EXPECT_EQ(row.regime, regimeOf(forces, driving));
                    EXPECT_NEAR(row.drag - found.forces.weight * std::sin(slope), driving, 1e-18);
                }
                EXPECT_EQ(found.critical_volume, criticalVolume(model, slope));
                ++c;
            }
        }
    }
}

TEST(Sweep, ReportsTheHysteresisOfAFallingAngle)
{
    TunnelSweep what = smallSweep();
    what.hystereses.clear();
    what.model.wetting.sliding_angle = 10.0 * kDegree;
    for (const TunnelCase& found : sweep(what).cases) {
        EXPECT_NEAR(0.5 * kPi * found.cap.contact_radius * what.model.liquid.surface_tension * found.hysteresis,
                    found.forces.retention, 1e-15 * found.forces.retention);
    }
}

TEST(Sweep, IsTheSameWithAnyNumberOfThreads)
{
    TunnelSweep what = smallSweep();
    what.winds.clear();
    for (int k = 0; k < 10'000; ++k) {
        what.winds.push_back(0.002 * k);
    }
    const auto on = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return sweep(what);
    };
    const Tunnel a = on(1);
    const Tunnel b = on(4);
    ASSERT_EQ(a.rows.size(), b.rows.size());
    for (std::size_t i = 0; i < a.rows.size(); ++i) {
        ASSERT_EQ(std::memcmp(&a.rows[i].acceleration, &b.rows[i].acceleration, sizeof(double)), 0);
        ASSERT_EQ(a.rows[i].terminal_velocity, b.rows[i].terminal_velocity);
        ASSERT_EQ(a.rows[i].regime, b.rows[i].regime);
    }
}

TEST(Sweep, RejectsFieldsOutOfRange)
{
    const auto expect_refused = [](const std::string& words, const std::function<void(TunnelSweep&)>& spoil) {
        TunnelSweep what = smallSweep();
        spoil(what);
        try {
            sweep(what);
            ADD_FAILURE() << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_refused("volumes must hold", [](TunnelSweep& s) { s.volumes.clear(); });
    expect_refused("winds must hold", [](TunnelSweep& s) { s.winds.clear(); });
    expect_refused("slopes must hold", [](TunnelSweep& s) { s.slopes.clear(); });
    expect_refused("volumes[1]", [](TunnelSweep& s) { s.volumes[1] = 0.0; });
    expect_refused("winds[2]", [&](TunnelSweep& s) { s.winds[2] = nan; });
    expect_refused("slopes[0]", [](TunnelSweep& s) { s.slopes[0] = -0.1; });
    expect_refused("hystereses[1]", [](TunnelSweep& s) { s.hystereses[1] = 2.5; });
    expect_refused("exclude each other", [](TunnelSweep& s) { s.model.wetting.sliding_angle = 0.1; });
    expect_refused("at most 10000000", [](TunnelSweep& s) {
        s.winds.assign(10'000, 1.0);
        s.volumes.assign(1000, 1e-9);
    });
    expect_refused("gravity", [](TunnelSweep& s) { s.model.gravity = -1.0; });
}

}  // namespace
}  // namespace droplet
