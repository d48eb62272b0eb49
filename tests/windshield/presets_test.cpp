// SPDX-License-Identifier: GPL-3.0-or-later
//
// Statements of the thesis on figures 3.10 to 3.12, section 3.2.3.
#include "droplet/windshield/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "droplet/error.h"
#include "windshield/windshields.h"

namespace droplet {
namespace {

constexpr double kDt = 1.0 / 30.0;

/// Preset on a part of its glass beside the middle, so that droplets can run sideways.
WindshieldParameters partOf(const char* name)
{
    WindshieldParameters p = windshieldPresetNamed(name).parameters;
    const Glass::Cylinder whole = p.glass.cylinder().value();
    EXPECT_EQ(whole.radius, 5.0);
    EXPECT_DOUBLE_EQ(whole.slope, 45.0 * kDegree);
    p.glass = Glass({.width = 0.3, .height = 0.25, .radius = whole.radius, .slope = whole.slope});
    return p;
}

/// Largest volume of a hemisphere that retention holds against an acceleration [m³].
double heldVolume(const WindshieldParameters& p, double push)
{
    // ½π r γ Δ = ρ ⅔π r³ a
    const double r = std::sqrt(0.75 * p.forces.liquid.surface_tension * p.forces.wetting.hysteresis /
                               (p.forces.liquid.density * std::abs(push)));
    return 2.0 / 3.0 * std::numbers::pi * r * r * r;
}

/// Acceleration of hemispheres up the middle of the glass; the same for all sizes lower than the layer [m/s²].
double pushUp(const WindshieldParameters& p)
{
    const Air& air = p.forces.air;
    const double gravity = p.forces.gravity * std::sin(45.0 * kDegree);
    const double neutral =
        8.0 / 3.0 * p.forces.liquid.density / air.density * gravity * air.boundary_layer / air.drag_coefficient;
    const double wind = p.vehicle.speedAt(0.0);
    return gravity * (wind * wind / neutral - 1.0);
}

TEST(WindshieldPresets, HaveTheFiguresParameters)
{
    const auto expect = [](const char* name, double wind, double hysteresis) {
        const WindshieldParameters& p = windshieldPresetNamed(name).parameters;
        EXPECT_EQ(p.vehicle.speedAt(0.0), wind);
        EXPECT_EQ(p.forces.wetting.hysteresis, hysteresis);
        EXPECT_EQ(p.forces.wetting.viscosity_factor, 0.5);
        EXPECT_NO_THROW(p.validate());
    };
    expect("figure-3.10", 11.3, 0.5);
    expect("figure-3.11", 11.3, 0.05);
    expect("figure-3.12", 15.0, 0.5);
    EXPECT_EQ(windshieldPresets().size(), 3U);
    try {
        (void)windshieldPresetNamed("figure-3.9");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("figure-3.10, figure-3.11, figure-3.12"));
    }
}

// "the droplets do not move at all"
TEST(WindshieldPresets, Figure310StaysStill)
{
    const WindshieldParameters p = partOf("figure-3.10");
    WindshieldState state = startWindshield(p);
    for (int k = 0; k < 300; ++k) {
        state = step(std::move(state), p, kDt);
        for (const RunningDroplet& d : state.droplets) {
            ASSERT_EQ(d.velocity, Vec2{}) << 1e9 * d.volume << " uL at " << state.time << " s";
        }
    }
    EXPECT_GT(state.droplets.size(), 500U);
    EXPECT_EQ(state.counts.left, 0U);
}

// "the adherence is smaller and the droplets move along the windshield curve"
TEST(WindshieldPresets, Figure311RunsAlongTheGlass)
{
    const WindshieldParameters p = partOf("figure-3.11");
    const WindshieldState state = testing::after(startWindshield(p), p, kDt, 300);
    std::size_t large = 0;
    std::size_t running = 0;
    double aside = 0.0;
    for (const RunningDroplet& d : state.droplets) {
        if (d.volume > 1.5 * heldVolume(p, pushUp(p))) {
            ++large;
            running += d.velocity.y > 0.0 ? 1U : 0U;
            aside += d.velocity.x * (d.position.x - 0.5 * p.glass.width());
        }
    }
    EXPECT_GT(large, 30U);
    EXPECT_GT(static_cast<double>(running), 0.9 * static_cast<double>(large));
    EXPECT_GT(state.counts.left, 0U);
    EXPECT_GT(state.counts.swept, 1000U);
    EXPECT_GT(aside, 0.0);  // outward, where the glass bends
}

// "the large droplets climb straight up the windshield. Since the adherence is strong and the boundary layer is set to
// be thick, the small droplets are made still."
TEST(WindshieldPresets, Figure312LargeDropletsClimbAndSmallOnesStay)
{
    WindshieldParameters p = partOf("figure-3.12");
    p.tear_off_weber = std::numeric_limits<double>::infinity();  // the thesis's droplets do not break up
    const double held = heldVolume(p, pushUp(p));
    const double shaken = std::sqrt(6.0) * p.fluctuation.acceleration;
    const double always_held = heldVolume(p, pushUp(p) + 2.0 * shaken);
    EXPECT_GT(p.forces.air.boundary_layer, capOf(held, 90.0 * kDegree).height);
    WindshieldState state = startWindshield(p);
    std::size_t climbing = 0;
    std::size_t staying = 0;
    for (int k = 0; k < 300; ++k) {
        state = step(std::move(state), p, kDt);
        for (const RunningDroplet& d : state.droplets) {
            if (d.volume > 2.0 * held) {
                ASSERT_GT(d.velocity.y, 0.0) << 1e9 * d.volume << " uL at " << state.time << " s";
                ASSERT_LT(std::abs(d.velocity.x), d.velocity.y);
                ++climbing;
            } else if (d.volume < always_held) {
                ASSERT_EQ(d.velocity, Vec2{}) << 1e9 * d.volume << " uL at " << state.time << " s";
                ++staying;
            }
        }
    }
    EXPECT_GT(climbing, 30U);
    EXPECT_GT(staying, 50'000U);
}

}  // namespace
}  // namespace droplet
