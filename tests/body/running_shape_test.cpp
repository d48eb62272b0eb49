// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/body/running_shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/wind/forces.h"

namespace droplet {
namespace {

/// Volume within the radius of the axis and above the glass, by slices along the axis.
double slicedVolume(const RunningShape& shape, int slices)
{
    const auto segment = [&](double radius) {  // area of a circle above the glass, in closed form
        const double h = std::clamp(-shape.centre_height, -radius, radius);
        return radius * radius * std::acos(h / radius) - h * std::sqrt(radius * radius - h * h);
    };
    double ends = 0.0;
    for (int i = 0; i < slices; ++i) {
        const double x = shape.radius * (2.0 * (i + 0.5) / slices - 1.0);
        const double r = std::sqrt(shape.radius * shape.radius - x * x);
        ends += segment(r) * 2.0 * shape.radius / slices;
    }
    return ends + 2.0 * shape.half_length * segment(shape.radius);
}

TEST(RunningShape, KeepsTheVolumeAtEverySpeed)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int k = 0; k < 200; ++k) {
        const double volume = std::pow(10.0, -11.0 + 4.0 * uniform(random));
        const double speed = 3.0 * uniform(random);
        const ShapeOptions options{.contact_angle = (20.0 + 140.0 * uniform(random)) * kDegree,
                                   .largest_stretch = 4.0 * uniform(random)};
        const RunningShape shape = runningShape(volume, speed, options);
        EXPECT_NEAR(shape.volume() / volume, 1.0, 1e-12);
        // The error of slices at the rim of a circle is their number to the power of −3/2.
        EXPECT_NEAR(slicedVolume(shape, 4000) / volume, 1.0, 2e-5) << volume << " " << speed;
    }
}

TEST(RunningShape, AtRestIsTheSphericalCapOfTheForces)
{
    for (const double angle : {30.0, 60.0, 90.0, 105.0, 150.0}) {
        const CapSize cap = capOf(30e-9, angle * kDegree);
        const RunningShape shape = runningShape(30e-9, 0.0, {.contact_angle = angle * kDegree});
        EXPECT_EQ(shape.half_length, 0.0);
        EXPECT_NEAR(shape.contact_radius, cap.contact_radius, 1e-12);
        EXPECT_NEAR(shape.radius, cap.radius, 1e-12);
        EXPECT_NEAR(shape.height(), cap.height, 1e-12);
    }
}

TEST(RunningShape, FasterDropletsAreLongerAndNarrower)
{
    RunningShape slower = runningShape(10e-9, 0.0);
    for (double speed = 0.05; speed < 5.0; speed *= 1.5) {
        const RunningShape faster = runningShape(10e-9, speed);
        EXPECT_GT(faster.half_length + faster.contact_radius, slower.half_length + slower.contact_radius);
        EXPECT_LT(faster.contact_radius, slower.contact_radius);
        EXPECT_LT(faster.half_length, ShapeOptions().largest_stretch * faster.contact_radius);
        slower = faster;
    }
    const ShapeOptions options;
    const RunningShape half = runningShape(10e-9, options.stretch_speed, options);
    EXPECT_NEAR(half.half_length, 0.5 * options.largest_stretch * half.contact_radius, 1e-15);
}

TEST(RunningShape, RejectsInvalidArguments)
{
    EXPECT_THROW(runningShape(0.0, 0.0), Error);
    EXPECT_THROW(runningShape(1e-9, -0.1), Error);
    EXPECT_THROW(runningShape(1e-9, 0.0, {.contact_angle = 0.0}), Error);
    EXPECT_THROW(runningShape(1e-9, 0.0, {.largest_stretch = -1.0}), Error);
    EXPECT_THROW(runningShape(1e-9, 0.0, {.stretch_speed = 0.0}), Error);
    EXPECT_THROW(runningShape(std::nan(""), 0.0), Error);
}

}  // namespace
}  // namespace droplet
