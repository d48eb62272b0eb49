// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind/forces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "droplet/error.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

double between(std::mt19937_64& random, double from, double to)
{
    return from + (to - from) * static_cast<double>(random() >> 11U) * 0x1p-53;
}

TEST(Cap, SizesMatchAtTheMeasuredAngle)
{
    struct Size {
        double volume;          // [µL]
        double contact_radius;  // [mm]
        double height;          // [mm]
        double frontal_area;    // [mm²]
    };
    for (const Size& size : {Size{10, 1.46, 1.90, 4.77}, Size{20, 1.84, 2.40, 7.56}, Size{30, 2.11, 2.75, 9.91},
                             Size{50, 2.50, 3.26, 13.9}, Size{100, 3.15, 4.10, 22.1}}) {
        const CapSize cap = capOf(size.volume * kMicrolitre, 105.0 * kDegree);
        // Half a unit of the last digit printed.
        EXPECT_NEAR(cap.contact_radius / kMillimetre, size.contact_radius, 0.005);
        EXPECT_NEAR(cap.height / kMillimetre, size.height, 0.005);
        EXPECT_NEAR(cap.frontal_area / 1e-6, size.frontal_area, size.frontal_area < 10.0 ? 0.005 : 0.05);
    }
}

TEST(Cap, HemisphereIsHalfASphere)
{
    const double r = 1.3e-3;
    const CapSize cap = capOf(2.0 / 3.0 * kPi * r * r * r, 0.5 * kPi);
    EXPECT_NEAR(cap.radius, r, 1e-15);
    EXPECT_NEAR(cap.contact_radius, r, 1e-15);
    EXPECT_NEAR(cap.height, r, 1e-15);
    EXPECT_NEAR(cap.frontal_area, 0.5 * kPi * r * r, 1e-18);
    EXPECT_NEAR(capVolume(r, 0.5 * kPi), cap.volume, 1e-22);
}

// For a flat cap the frontal area is a difference of nearly equal numbers. It is compared with a quadrature of the
// circular segment, at angles on both sides of the series' limit.
TEST(Cap, FrontalAreaIsExactForFlatCaps)
{
    for (const double theta : {0.02, 0.1, 0.2499, 0.2501, 0.8, 1.6, 2.5, 3.1}) {
        const CapSize cap = capOf(1e-8, theta);
        // ∫ 2 R sin²t dt over t in (0, θ) by the midpoint rule, Richardson-extrapolated.
        const auto segment = [&](int parts) {
            double sum = 0.0;
            for (int i = 0; i < parts; ++i) {
                const double sine = std::sin((i + 0.5) * theta / parts);
                sum += 2.0 * sine * sine;
            }
            return sum * theta / parts * cap.radius * cap.radius;
        };
        const double area = (4.0 * segment(2000) - segment(1000)) / 3.0;
        EXPECT_NEAR(cap.frontal_area / area, 1.0, 1e-11) << theta;
        EXPECT_NEAR(capVolume(cap.contact_radius, theta) / cap.volume, 1.0, 1e-12) << theta;
        EXPECT_NEAR(cap.contact_radius * cap.contact_radius + cap.height * cap.height, 2.0 * cap.radius * cap.height,
                    1e-14 * cap.radius * cap.radius);
    }
}

TEST(Wind, IsSlowerOnlyInTheBoundaryLayer)
{
    Air air;
    air.boundary_layer = 8e-3;
    EXPECT_DOUBLE_EQ(windAt(air, 10.0, 2e-3), 5.0);  // (1/4)^½
    EXPECT_DOUBLE_EQ(windAt(air, -10.0, 2e-3), -5.0);
    EXPECT_DOUBLE_EQ(windAt(air, 10.0, 8e-3), 10.0);
    EXPECT_DOUBLE_EQ(windAt(air, 10.0, 9e-3), 10.0);
    EXPECT_DOUBLE_EQ(windAt(air, 10.0, 0.0), 0.0);
    air.profile_exponent = 1.0 / 7.0;
    EXPECT_NEAR(windAt(air, 10.0, 8e-3 / 128.0), 5.0, 1e-14);
    air.boundary_layer = 0.0;
    EXPECT_DOUBLE_EQ(windAt(air, 10.0, 0.0), 10.0);
}

// Eqs. 3.2 to 3.5 for a hemisphere of 2 mm, calculated by hand.
TEST(Forces, OfAHemisphereMatchTheEquations)
{
    ForceModel model;
    model.wetting = {0.5 * kPi, 0.5, {}, 0.25, 0.3};
    model.air = {1.2, 0.8, 8e-3, 0.5};
    const double r = 2e-3;
    const DropletForces forces = forcesOn(model, 2.0 / 3.0 * kPi * r * r * r);
    EXPECT_NEAR(forces.mass, 998.2 * 2.0 / 3.0 * kPi * 8e-9, 1e-17);
    EXPECT_NEAR(forces.weight, 9.81 * forces.mass, 1e-17);
    EXPECT_NEAR(forces.retention, 0.5 * kPi * r * 0.0728 * 0.5, 1e-17);
    EXPECT_NEAR(forces.sliding_friction, 0.25 * forces.retention, 1e-18);
    EXPECT_NEAR(forces.drag, 0.5 * 1.2 * 0.8 * (0.5 * kPi * r * r) * 0.25, 1e-18);
    EXPECT_NEAR(forces.viscous, 0.3 * r, 1e-17);
    EXPECT_NEAR(drivingForce(forces, 30.0 * kDegree, 10.0), 100.0 * forces.drag - 0.5 * forces.weight, 1e-17);
    EXPECT_NEAR(drivingForce(forces, 30.0 * kDegree, -10.0), -100.0 * forces.drag - 0.5 * forces.weight, 1e-17);
}

TEST(Forces, FallingAngleGivesRetentionOverWeight)
{
    ForceModel model;
    model.wetting.sliding_angle = 10.0 * kDegree;
    for (const double volume : {1e-9, 30e-9, 200e-9}) {
        const DropletForces forces = forcesOn(model, volume);
        EXPECT_NEAR(forces.retention, forces.weight * std::sin(10.0 * kDegree), 1e-15 * forces.weight);
    }
}

TEST(Forces, HysteresisOfAFallingAngleHoldsItsVolume)
{
    std::mt19937_64 random(11);
    for (int k = 0; k < 100; ++k) {
        ForceModel model;
        model.wetting.contact_angle = between(random, 30.0, 150.0) * kDegree;
        model.liquid.surface_tension = between(random, 0.02, 0.5);
        const double volume = std::exp(between(random, std::log(1e-10), std::log(2e-8)));
        const double angle = between(random, 1.0, 60.0) * kDegree;
        model.wetting.hysteresis = hysteresisOf(model, angle, volume);
        const DropletForces forces = forcesOn(model, volume);
        EXPECT_NEAR(forces.retention / (forces.weight * std::sin(angle)), 1.0, 1e-13);
    }
}

// Figure 3.4: no wind, slope 35°, sliding angle 10°.
TEST(Forces, WithoutWindAccelerationFollowsFromTheAngles)
{
    const ForcePreset& preset = forcePresetNamed("hashimoto");
    const double bound = 9.81 * (std::sin(35.0 * kDegree) - std::sin(10.0 * kDegree));
    EXPECT_NEAR(bound, 3.92, 0.005);
    for (const double volume : preset.volumes) {
        const DropletForces forces = forcesOn(preset.model, volume);
        const double rate = acceleration(forces, drivingForce(forces, preset.slope, 0.0), 0.0);
        EXPECT_LE(-rate, bound * (1.0 + 1e-12)) << volume;
        EXPECT_LT(rate, 0.0);
    }
    const DropletForces reference = forcesOn(preset.model, preset.reference_volume);
    EXPECT_NEAR(acceleration(reference, drivingForce(reference, preset.slope, 0.0), 0.0), -bound, 1e-12);
}

TEST(Forces, TerminalSpeedOf30MicrolitresMatches)
{
    ForceModel model;
    model.wetting.sliding_angle = 10.0 * kDegree;
    const auto speed = [&](double factor) {
        model.wetting.viscosity_factor = factor;
        const DropletForces forces = forcesOn(model, 30e-9);
        return -*terminalVelocity(forces, drivingForce(forces, 35.0 * kDegree, 0.0));
    };
    EXPECT_NEAR(speed(kArtisticViscosityFactor), 0.11, 0.005);
    EXPECT_NEAR(speed(0.045), 1.2, 0.05);
}

TEST(Forces, WedgeTheoryGivesTheViscosityFactor)
{
    // At 90° the formula is 2π ln(R/λ) / (π/2) = 4 ln(R/λ).
    EXPECT_NEAR(wedgeViscosityFactor(1e-3, 0.5 * kPi, kMolecularCutOff * std::exp(10.0)), 0.04, 1e-15);
    for (const double degrees : {90.0, 105.0}) {
        const double radius = capOf(30e-9, degrees * kDegree).radius;
        const double factor = wedgeViscosityFactor(kWaterViscosity, degrees * kDegree, radius);
        EXPECT_GT(factor, 0.04) << degrees;
        EXPECT_LT(factor, 0.06) << degrees;
    }
}

TEST(Friction, CancelsUpToItsLimitAtRest)
{
    const DropletForces forces{1e-5, 1e-4, 1e-7, 3e-5, 2e-5, 1e-3};
    EXPECT_EQ(acceleration(forces, 3e-5, 0.0), 0.0);
    EXPECT_EQ(acceleration(forces, -3e-5, 0.0), 0.0);
    // Above the limit, sliding friction acts: 4e-5 − 2e-5 on 1e-5 kg.
    EXPECT_NEAR(acceleration(forces, 4e-5, 0.0), 2.0, 1e-12);
    EXPECT_NEAR(acceleration(forces, -4e-5, 0.0), -2.0, 1e-12);
    // Friction opposes the motion, in any direction of the driving force.
    EXPECT_NEAR(acceleration(forces, 0.0, 0.01), -3.0, 1e-12);
    EXPECT_NEAR(acceleration(forces, 0.0, -0.01), 3.0, 1e-12);
    EXPECT_NEAR(acceleration(forces, 2e-5, -0.01), 5.0, 1e-12);
}

TEST(Friction, IsTheSameInEveryDirectionOfThePlane)
{
    std::mt19937_64 random(7);
    for (int k = 0; k < 300; ++k) {
        const DropletForces forces{
            between(random, 1e-6, 1e-4), 0.0, 0.0, between(random, 0.0, 1e-4), between(random, 0.0, 1e-4),
            between(random, 0.0, 1e-2)};
        const double turn = between(random, 0.0, 2.0 * kPi);
        const Vec2 along{std::cos(turn), std::sin(turn)};
        const double driving = between(random, -3e-4, 3e-4);
        const double velocity = k % 3 == 0 ? 0.0 : between(random, -1.0, 1.0);
        const Vec2 plane = acceleration(forces, driving * along, velocity * along);
        const double line = acceleration(forces, driving, velocity);
        EXPECT_NEAR(dot(plane, along), line, 1e-9 * (1.0 + std::abs(line)));
        EXPECT_NEAR(cross(plane, along), 0.0, 1e-9 * (1.0 + std::abs(line)));
    }
}

// Without a driving force, friction only removes energy.
TEST(Friction, NeverDrives)
{
    std::mt19937_64 random(3);
    for (int k = 0; k < 300; ++k) {
        const DropletForces forces{1e-5, 0.0, 0.0, 3e-5, between(random, 0.0, 3e-5), between(random, 0.0, 1e-2)};
        const Vec2 velocity{between(random, -1.0, 1.0), between(random, -1.0, 1.0)};
        EXPECT_LE(dot(acceleration(forces, {}, velocity), velocity), 0.0);
    }
}

TEST(Forces, AccelerationIsZeroAtTerminalVelocity)
{
    std::mt19937_64 random(5);
    for (int k = 0; k < 300; ++k) {
        const DropletForces forces{1e-5, 0.0, 0.0, 3e-5, between(random, 0.0, 3e-5), between(random, 1e-4, 1e-2)};
        const double driving = between(random, -1e-4, 1e-4);
        const double velocity = terminalVelocity(forces, driving).value();
        EXPECT_NEAR(acceleration(forces, driving, velocity), 0.0, 1e-9);
        EXPECT_EQ(velocity == 0.0, std::abs(driving) <= forces.retention);
        EXPECT_GE(velocity * driving, 0.0);
    }
    EXPECT_FALSE(terminalVelocity({1e-5, 0.0, 0.0, 3e-5, 3e-5, 0.0}, 1e-4).has_value());
    EXPECT_EQ(terminalVelocity({1e-5, 0.0, 0.0, 3e-5, 3e-5, 0.0}, 1e-5), 0.0);
}

TEST(Presets, AreValidAndKnownByName)
{
    for (const ForcePreset& preset : forcePresets()) {
        EXPECT_NO_THROW(preset.model.validate()) << preset.name;
        EXPECT_EQ(&forcePresetNamed(preset.name), &preset);
        // The fit holds for all default volumes: they are lower than the boundary layer.
        for (const double volume : preset.volumes) {
            EXPECT_LT(capOf(volume, preset.model.wetting.contact_angle).height, preset.model.air.boundary_layer);
        }
    }
    // The thesis' hemispheres need δ/C_D = 6.8 mm for the measured band.
    const Air& air = forcePresetNamed("thesis").model.air;
    EXPECT_NEAR(air.boundary_layer / air.drag_coefficient, 6.8e-3, 0.05e-3);
    try {
        forcePresetNamed("kaneda");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
        EXPECT_THAT(error.what(), HasSubstr("'kaneda'"));
        EXPECT_THAT(error.what(), HasSubstr("thesis, hashimoto"));
    }
}

TEST(ForceModel, RejectsFieldsOutOfRange)
{
    const auto expect_refused = [](const std::string& field, const std::function<void(ForceModel&)>& spoil) {
        ForceModel model;
        spoil(model);
        try {
            model.validate();
            ADD_FAILURE() << field;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_THAT(error.what(), HasSubstr(field));
        }
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NO_THROW(ForceModel{}.validate());
    expect_refused("air.density", [](ForceModel& m) { m.air.density = -1.0; });
    expect_refused("air.density", [&](ForceModel& m) { m.air.density = nan; });
    expect_refused("air.drag_coefficient", [](ForceModel& m) { m.air.drag_coefficient = -0.1; });
    expect_refused("air.boundary_layer", [](ForceModel& m) { m.air.boundary_layer = -1e-3; });
    expect_refused("air.profile_exponent", [](ForceModel& m) { m.air.profile_exponent = 2.1; });
    expect_refused("wetting.contact_angle", [](ForceModel& m) { m.wetting.contact_angle = 0.0; });
    expect_refused("wetting.contact_angle", [](ForceModel& m) { m.wetting.contact_angle = kPi; });
    expect_refused("wetting.hysteresis", [](ForceModel& m) { m.wetting.hysteresis = 2.01; });
    expect_refused("wetting.sliding_angle", [&](ForceModel& m) { m.wetting.sliding_angle = nan; });
    expect_refused("wetting.kinetic_fraction", [](ForceModel& m) { m.wetting.kinetic_fraction = 1.1; });
    expect_refused("wetting.viscosity_factor", [](ForceModel& m) { m.wetting.viscosity_factor = -1.0; });
    expect_refused("liquid.density", [](ForceModel& m) { m.liquid.density = 0.0; });
    expect_refused("gravity", [&](ForceModel& m) { m.gravity = nan; });
}

}  // namespace
}  // namespace droplet
