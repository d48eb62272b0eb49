// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/units.h"

namespace droplet {
namespace {

TEST(FlowPoints, HaveTheSizeOfTheBodiesAndTheGroundsAxes)
{
    // A slope of 45° down to −y.
    const FlowTerrain terrain(
        flowSurface({{-0.1, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.1, 0.1, 0.1}, {-0.1, 0.1, 0.1}}, {{0, 1, 2}, {0, 2, 3}}));
    FlowParameters parameters;
    parameters.forces.wetting.hysteresis = 0.05;
    parameters.pinning.spread = 0.0;
    const DropletBodies bodies(BodyShape::Capillary, parameters.forces);
    FlowState state =
        startFlow(terrain, parameters, {{{0.01, 0.09, 0.09}, 30e-9, {}}, {{-0.05, 0.05, 0.3}, 10e-9, {}}});
    state = advanceFlow(std::move(state), terrain, parameters, 0.1);
    const std::vector<FlowSample> samples = sampleFlow(state, terrain, parameters);
    const std::vector<FlowPoint> points = flowPoints(samples, terrain, bodies, parameters.gravity);
    ASSERT_EQ(points.size(), 2U);
    const double half = std::sqrt(0.5);
    EXPECT_NEAR(length(points[0].axes[2] - Vec3{0.0, -half, half}), 0.0, 1e-12);
    EXPECT_NEAR(length(points[0].axes[0] - Vec3{0.0, -half, -half}), 0.0, 1e-9) << "ahead is down";
    EXPECT_GT(points[0].elongation, 1.0) << "it runs";
    const double flat = capOf(30e-9, parameters.forces.wetting.contact_angle).contact_radius;
    EXPECT_NEAR(points[0].radius / flat, 1.0, 0.3);
    EXPECT_NEAR(points[0].age, 0.1, 1e-12);
    EXPECT_TRUE(points[0].face);
    EXPECT_FALSE(points[1].face);
    EXPECT_NEAR(4.0 / 3.0 * std::numbers::pi * std::pow(points[1].radius, 3.0), 10e-9, 1e-18);
    EXPECT_EQ(points[1].elongation, 1.0);
}

TEST(FlowPoints, RotationsTurnTheAxes)
{
    FlowPoint point;
    point.axes = {Vec3{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
    const auto turn = rotationOf(point);
    for (const double part : turn) {
        EXPECT_NEAR(part, 0.5, 1e-15);
    }
    point.axes = {Vec3{-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}};
    EXPECT_NEAR(std::abs(rotationOf(point)[2]), 1.0, 1e-15) << "half a turn";
}

TEST(FlowPoints, PlyHasAllColumns)
{
    FlowPoint point;
    point.id = (1ULL << 32U) + 7;
    point.place = {1.0, 2.0, 3.0};
    point.axes = {Vec3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    point.velocity = {4.0, 5.0, 6.0};
    point.radius = 0.5;
    point.elongation = 1.5;
    point.volume = 0.25;
    point.age = 8.0;
    std::ostringstream out;
    const std::uint64_t bytes = writePointsAsPly(std::vector{point, point}, out);
    const std::string text = out.str();
    EXPECT_EQ(bytes, text.size());
    const std::string end = "end_header\n";
    const std::size_t head = text.find(end) + end.size();
    EXPECT_THAT(text.substr(0, head), ::testing::HasSubstr("element vertex 2\nproperty float x\n"));
    ASSERT_EQ(text.size() - head, 2U * 19U * 4U);
    const auto number = [&](std::size_t column) {
        float value = 0.0F;
        std::memcpy(&value, text.data() + head + 4 * column, 4);
        return value;
    };
    const std::vector<float> expected{1, 2, 3, 0, 0, 1, 4, 5, 6, 0, 0, 0, 1, 0.5F, 1.5F, 0.25F, 8};
    for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_EQ(number(k), expected[k]) << k;
        EXPECT_EQ(number(19 + k), expected[k]) << k;
    }
    EXPECT_EQ(std::bit_cast<std::uint32_t>(number(17)), 7U);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(number(18)), 0xFFFFFFFFU) << "-1: in the air";
}

}  // namespace
}  // namespace droplet
