// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "support/usda.h"

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

using Frames = std::vector<std::vector<FlowPoint>>;

const DropletBodies& bodies()
{
    static const DropletBodies made(BodyShape::Capillary);
    return made;
}

std::string usdOf(const Frames& frames, const UsdPointsOptions& options = {}, Format format = Format::Usda)
{
    std::ostringstream out;
    const std::uint64_t bytes = writePointsAsUsd(frames, bodies(), options, out, format);
    EXPECT_EQ(bytes, out.str().size());
    return out.str();
}

/// Values of an attribute of the instancer in a frame.
std::vector<double> at(const testing::UsdPrim& instancer, const std::string& attribute, std::size_t frame)
{
    return testing::numbersIn(instancer.properties.at(attribute).samples.at(static_cast<double>(frame)));
}

/// Droplets that run on a roof, rest on level ground, and fall onto it.
Frames roof()
{
    const FlowTerrain terrain(flowSurface(
        {{-0.1, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.1, 0.1, 0.1}, {-0.1, 0.1, 0.1}, {0.1, -0.1, 0.0}, {-0.1, -0.1, 0.0}},
        {{0, 1, 2}, {0, 2, 3}, {5, 4, 1}, {5, 1, 0}}));
    FlowParameters parameters;
    parameters.forces.wetting.hysteresis = 0.05;
    parameters.pinning.spread = 0.0;
    FlowState state =
        startFlow(terrain, parameters,
                  {{{0.01, 0.09, 0.09}, 30e-9, {}}, {{-0.05, 0.05, 0.08}, 10e-9, {}}, {{0.03, -0.05, 0.0}, 5e-9, {}}});
    Frames frames;
    for (int k = 0; k < 8; ++k) {
        state = advanceFlow(std::move(state), terrain, parameters, k / 30.0);
        frames.push_back(flowPoints(sampleFlow(state, terrain, parameters), terrain, bodies(), parameters.gravity));
    }
    frames.emplace_back();  // none is left
    return frames;
}

TEST(UsdPoints, SamplesOfAFrameAreItsPoints)
{
    const Frames frames = roof();
    const testing::UsdPrim root = testing::UsdaReader(usdOf(frames)).read();
    EXPECT_EQ(root.metadata.at("startTimeCode"), "0");
    EXPECT_EQ(root.metadata.at("endTimeCode"), "8");
    EXPECT_EQ(root.metadata.at("timeCodesPerSecond"), "30");
    const testing::UsdPrim& instancer = root.child("droplet").child("droplets");
    EXPECT_EQ(instancer.type, "PointInstancer");
    const std::vector<std::pair<const char*, std::size_t>> widths{{"ids", 1},
                                                                  {"protoIndices", 1},
                                                                  {"positions", 3},
                                                                  {"velocities", 3},
                                                                  {"orientations", 4},
                                                                  {"angularVelocities", 3},
                                                                  {"scales", 3},
                                                                  {"primvars:age", 1},
                                                                  {"primvars:radius", 1},
                                                                  {"primvars:elongation", 1},
                                                                  {"primvars:volume", 1}};
    for (const auto& [name, width] : widths) {
        EXPECT_EQ(instancer.properties.at(name).samples.size(), frames.size()) << name;
        for (std::size_t k = 0; k < frames.size(); ++k) {
            EXPECT_EQ(at(instancer, name, k).size(), width * frames[k].size()) << name << " of frame " << k;
        }
    }
    EXPECT_EQ(instancer.properties.at("orientations").type, "quath[]");
    EXPECT_EQ(instancer.properties.at("ids").type, "int64[]");
    std::set<double> kinds;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const std::vector<double> ids = at(instancer, "ids", k);
        EXPECT_EQ(std::set(ids.begin(), ids.end()).size(), ids.size());
        for (std::size_t i = 0; i < ids.size(); ++i) {
            const FlowPoint& point = frames[k][i];
            const auto three = [&](const char* name) {
                const std::vector<double> all = at(instancer, name, k);
                return Vec3{all[3 * i], all[3 * i + 1], all[3 * i + 2]};
            };
            EXPECT_EQ(ids[i], static_cast<double>(point.id));
            EXPECT_LT(length(three("positions") - Vec3{point.place.x, point.place.z, -point.place.y}), 1e-8);
            EXPECT_LT(length(three("velocities") - Vec3{point.velocity.x, point.velocity.z, -point.velocity.y}), 1e-7);
            EXPECT_NEAR(at(instancer, "primvars:volume", k)[i] / point.volume, 1.0, 1e-6);
            EXPECT_NEAR(at(instancer, "primvars:radius", k)[i] / point.radius, 1.0, 1e-6);
            EXPECT_NEAR(at(instancer, "primvars:elongation", k)[i] / point.elongation, 1.0, 1e-6);
            EXPECT_NEAR(at(instancer, "primvars:age", k)[i], point.age, 1e-6);
            const double kind = at(instancer, "protoIndices", k)[i];
            EXPECT_EQ(kind, !point.face ? 2.0 : point.velocity == Vec3{} ? 0.0 : 1.0);
            kinds.insert(kind);
        }
    }
    EXPECT_EQ(kinds.size(), 3U) << "some rest, run and fall";
}

TEST(UsdPoints, PrototypesHaveTheVolumeAndDirectionOfTheDroplets)
{
    const Frames frames = roof();
    const testing::UsdPrim root = testing::UsdaReader(usdOf(frames)).read();
    const testing::UsdPrim& instancer = root.child("droplet").child("droplets");
    const testing::UsdPrim& prototypes = instancer.child("Prototypes");
    ASSERT_EQ(prototypes.order.size(), 3U);
    std::string targets;
    std::vector<double> volumes;
    std::vector<std::vector<double>> vertices;
    for (const std::string& name : prototypes.order) {
        targets += (targets.empty() ? "[/droplet/droplets/Prototypes/" : ", /droplet/droplets/Prototypes/") + name;
        const testing::UsdPrim& mesh = prototypes.child(name);
        EXPECT_TRUE(root.child("droplet").children.contains(mesh.value("material:binding").substr(9)));
        const std::vector<double> points = testing::numbersIn(mesh.value("points"));
        const std::vector<double> corners = testing::numbersIn(mesh.value("faceVertexIndices"));
        const auto corner = [&](std::size_t c) {
            const auto p = 3 * static_cast<std::size_t>(corners[c]);
            return Vec3{points.at(p), points.at(p + 1), points.at(p + 2)};
        };
        double volume = 0.0;
        for (std::size_t c = 0; c < corners.size(); c += 3) {
            volume += dot(corner(c), cross(corner(c + 1), corner(c + 2))) / 6.0;
        }
        volumes.push_back(volume);
        vertices.push_back(points);
    }
    EXPECT_EQ(instancer.value("prototypes"), targets + "]");
    const std::vector<double> extent = testing::numbersIn(instancer.value("extent"));
    ASSERT_EQ(extent.size(), 6U);
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const std::vector<double> scales = at(instancer, "scales", k);
        const std::vector<double> turns = at(instancer, "orientations", k);
        for (std::size_t i = 0; i < frames[k].size(); ++i) {
            const FlowPoint& point = frames[k][i];
            const auto kind = static_cast<std::size_t>(at(instancer, "protoIndices", k)[i]);
            const Vec3 scale{scales[3 * i], scales[3 * i + 1], scales[3 * i + 2]};
            EXPECT_NEAR(volumes[kind] * scale.x * scale.y * scale.z / point.volume, 1.0, 1e-5);
            if (point.face) {
                EXPECT_NEAR(scale.z / point.radius, 1.0, 1e-6) << "half the width of a prototype is 1";
                EXPECT_NEAR(scale.x / scale.z / point.elongation, 1.0, 1e-6);
            }
            const Vec3 axis{turns[4 * i + 1], turns[4 * i + 2], turns[4 * i + 3]};
            const double real = turns[4 * i];
            const auto turned = [&](Vec3 v) {
                const Vec3 twice = 2.0 * cross(axis, v);
                return v + real * twice + cross(axis, twice);
            };
            const auto y_up = [](Vec3 v) { return Vec3{v.x, v.z, -v.y}; };
            EXPECT_LT(length(turned({1.0, 0.0, 0.0}) - y_up(point.axes[0])), 1e-3) << "ahead";
            EXPECT_LT(length(turned({0.0, 1.0, 0.0}) - y_up(point.axes[2])), 1e-3) << "off the ground";
            for (std::size_t v = 0; v < vertices[kind].size(); v += 3) {
                const Vec3 p{vertices[kind][v], vertices[kind][v + 1], vertices[kind][v + 2]};
                const Vec3 shown = y_up(point.place) + turned({scale.x * p.x, scale.y * p.y, scale.z * p.z});
                EXPECT_TRUE(shown.x >= extent[0] && shown.y >= extent[1] && shown.z >= extent[2]);
                EXPECT_TRUE(shown.x <= extent[3] && shown.y <= extent[4] && shown.z <= extent[5]);
            }
        }
    }
}

TEST(UsdPoints, AngularVelocitiesLeadToTheNextFrame)
{
    FlowPoint point;
    point.id = ~std::uint64_t{0};
    point.volume = 1e-9;
    point.radius = 1e-3;
    point.face = 0;
    point.axes = {Vec3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    FlowPoint turned = point;
    turned.axes = {Vec3{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};  // a quarter to the left
    FlowPoint other = point;
    other.id = 5;
    FlowPoint flying = turned;
    flying.face.reset();
    UsdPointsOptions options;
    options.frames_per_second = 10.0;
    const testing::UsdPrim root =
        testing::UsdaReader(usdOf({{other, point}, {turned}, {flying}, {turned}}, options)).read();
    const testing::UsdPrim& instancer = root.child("droplet").child("droplets");
    EXPECT_THAT(at(instancer, "angularVelocities", 0), ::testing::ElementsAre(0, 0, 0, 0, 900, 0));
    for (const std::size_t frame : {1U, 2U, 3U}) {
        EXPECT_THAT(at(instancer, "angularVelocities", frame), ::testing::Each(0)) << frame;
    }
    EXPECT_THAT(at(instancer, "ids", 0), ::testing::ElementsAre(5, -1)) << "signed";
    EXPECT_EQ(root.metadata.at("framesPerSecond"), "10");
}

TEST(UsdPoints, MayBeNone)
{
    const testing::UsdPrim root = testing::UsdaReader(usdOf({{}, {}})).read();
    const testing::UsdPrim& instancer = root.child("droplet").child("droplets");
    EXPECT_EQ(instancer.properties.at("positions").samples.at(1.0), "[]");
    EXPECT_FALSE(instancer.properties.contains("extent"));
    const std::string package = usdOf({{}, {}}, {}, Format::Usdz);
    EXPECT_EQ(package.substr(0, 2), "PK");
    EXPECT_THAT(package, ::testing::HasSubstr(usdOf({{}, {}})));
}

TEST(UsdPoints, RefuseWhatNoFileHolds)
{
    const auto message = [](const Frames& frames, const UsdPointsOptions& options, Format format) -> std::string {
        std::ostringstream out;
        try {
            writePointsAsUsd(frames, bodies(), options, out, format);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_EQ(out.str(), "");
            return error.what();
        }
        return "";
    };
    using ::testing::HasSubstr;
    EXPECT_THAT(message({}, {}, Format::Usda), HasSubstr("at least one frame"));
    EXPECT_THAT(message({{}}, {}, Format::Glb), HasSubstr("glb holds no points over time"));
    UsdPointsOptions options;
    options.frames_per_second = 0.0;
    EXPECT_THAT(message({{}}, options, Format::Usda), HasSubstr("frames_per_second is 0"));
    options = {};
    options.gravity = -1.0;
    EXPECT_THAT(message({{}}, options, Format::Usda), HasSubstr("gravity is -1"));
}

}  // namespace
}  // namespace droplet
