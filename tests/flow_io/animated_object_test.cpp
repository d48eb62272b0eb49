// SPDX-License-Identifier: GPL-3.0-or-later
// Objects that an animation of glTF deforms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/flow/flow.h"
#include "droplet/flow/flow_shapes.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/units.h"
#include "support/command.h"
#include "support/gltf_draft.h"

namespace droplet {
namespace {

using testing::Draft;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A place of the file, +Y up, in the library.
Vec3 ofFile(double x, double y, double z)
{
    return {x, -z, y};
}

void expectNear(Vec3 a, Vec3 b, double tolerance, const std::string& where)
{
    EXPECT_NEAR(a.x, b.x, tolerance) << where;
    EXPECT_NEAR(a.y, b.y, tolerance) << where;
    EXPECT_NEAR(a.z, b.z, tolerance) << where;
}

struct Channel {
    std::size_t node = 0;
    std::string path;
    std::size_t times = 0;
    std::size_t values = 0;
    std::string interpolation = "LINEAR";
};

std::string animation(const std::vector<Channel>& channels, const std::string& name = "act")
{
    std::string targets;
    std::string samplers;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const auto& [node, path, times, values, interpolation] = channels[i];
        const std::string comma = i > 0 ? "," : "";
        targets += comma + R"({"sampler":)" + std::to_string(i) + R"(,"target":{"node":)" + std::to_string(node) +
                   R"(,"path":")" + path + R"("}})";
        samplers += comma + R"({"input":)" + std::to_string(times) + R"(,"output":)" + std::to_string(values) +
                    R"(,"interpolation":")" + interpolation + R"("})";
    }
    return R"({"name":")" + name + R"(","channels":[)" + targets + R"(],"samplers":[)" + samplers + "]}";
}

std::string animations(const std::vector<Channel>& channels)
{
    return R"(,"animations":[)" + animation(channels) + "]";
}

class AnimatedObject : public ::testing::Test {
protected:
    [[nodiscard]] std::filesystem::path write(const std::string& bytes) const
    {
        testing::writeFile(scratch_.path() / "a.glb", bytes);
        return scratch_.path() / "a.glb";
    }

    [[nodiscard]] DeformingObject read(const std::string& bytes, const ObjectSampling& sampling = {10.0},
                                       const ObjectOptions& options = {}) const
    {
        DeformingObject read = readAnimatedObject(write(bytes), sampling, options);
        for (const std::vector<Vec3>& shape : read.vertices) {
            EXPECT_EQ(shape.size(), read.object.vertices.size());
        }
        EXPECT_EQ(read.vertices.front(), read.object.vertices);
        return read;
    }

    void expectRefused(const std::string& bytes, const std::string& words, const ObjectSampling& sampling = {}) const
    {
        try {
            (void)readAnimatedObject(write(bytes), sampling);
            ADD_FAILURE() << "read; should say: " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    }

private:
    testing::ScratchDirectory scratch_;
};

/// A strip from x = 0 to 2, with columns at 0, 1 and 2 and two rows, y = 0 and 1: accessor 0 and its indices, 1.
Draft strip()
{
    Draft draft;
    draft.addFloats({0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0}, "VEC3");
    std::string indices;
    for (const std::uint32_t i : {0U, 2U, 3U, 0U, 3U, 1U, 2U, 4U, 5U, 2U, 5U, 3U}) {
        indices += testing::littleEndian(i, 2);
    }
    draft.add(indices, 5123, "SCALAR", 12);
    return draft;
}

constexpr const char* kStrip = R"("scenes":[{"nodes":[0]}],"meshes":[{"primitives":[{"indices":1,"attributes":)";

/// A square of 0.2 m with a slope of 30 degrees down to +z of the file: accessors 0 and 1.
Draft slope()
{
    Draft draft;
    const auto high = static_cast<float>(0.2 * std::tan(30.0 * kDegree));
    draft.addFloats({0, 0, 0.2F, 0.2F, 0, 0.2F, 0.2F, high, 0, 0, high, 0}, "VEC3");
    std::string indices;
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
        indices += testing::littleEndian(i, 2);
    }
    draft.add(indices, 5123, "SCALAR", 6);
    return draft;
}

// The second bone, at x = 1, turns by a quarter in a second. Its column has half of it, the last one all.
TEST_F(AnimatedObject, SkinsBendAStripAsTheirBonesDo)
{
    Draft draft = strip();
    std::string joints;
    std::vector<float> weights;
    for (int v = 0; v < 6; ++v) {
        joints += testing::littleEndian(0x00000100, 4);  // 0 and 1
        const float second = v < 2 ? 0.0F : v < 4 ? 0.5F : 1.0F;
        weights.insert(weights.end(), {1.0F - second, second, 0.0F, 0.0F});
    }
    const std::size_t joint = draft.add(joints, 5121, "VEC4", 6);
    const std::size_t weight = draft.addFloats(weights, "VEC4");
    std::vector<float> binds{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,
                             1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1};
    const std::size_t bind = draft.add(testing::floats(binds), 5126, "MAT4", 2);
    const std::size_t times = draft.addFloats({0, 1}, "SCALAR");
    const auto root = static_cast<float>(std::sqrt(0.5));
    const std::size_t turns = draft.addFloats({0, 0, 0, 1, 0, 0, root, root}, "VEC4");
    const auto file = [&](const std::string& nodes) {
        return draft.file(std::string(kStrip) + R"({"POSITION":0,"JOINTS_0":)" + std::to_string(joint) +
                          R"(,"WEIGHTS_0":)" + std::to_string(weight) + R"(}}]}],"skins":[{"inverseBindMatrices":)" +
                          std::to_string(bind) + R"(,"joints":[1,2]}],)" + nodes +
                          animations({{2, "rotation", times, turns}}));
    };
    // The node of the mesh is elsewhere, which does not matter.
    const std::string nodes = R"("nodes":[{"children":[1,3]},{"children":[2]},{"translation":[1,0,0]},)"
                              R"({"mesh":0,"skin":0,"translation":[5,5,5]}])";
    const DeformingObject object = read(file(nodes));
    EXPECT_THAT(object.object.warnings, IsEmpty());
    EXPECT_TRUE(object.object.motion.rests());
    ASSERT_THAT(object.vertices, SizeIs(11));
    for (std::size_t k = 0; k < object.vertices.size(); ++k) {
        const double turn = 0.05 * std::numbers::pi * static_cast<double>(k);
        const double c = std::cos(turn);
        const double s = std::sin(turn);
        const std::string where = "frame " + std::to_string(k);
        const std::vector<Vec3>& shape = object.vertices[k];
        expectNear(shape[0], ofFile(0.0, 0.0, 0.0), 1e-6, where);
        expectNear(shape[1], ofFile(0.0, 1.0, 0.0), 1e-6, where);
        expectNear(shape[2], ofFile(1.0, 0.0, 0.0), 1e-6, where);
        expectNear(shape[3], ofFile(1.0 - 0.5 * s, 0.5 + 0.5 * c, 0.0), 1e-6, where);
        expectNear(shape[4], ofFile(1.0 + c, s, 0.0), 1e-6, where);
        expectNear(shape[5], ofFile(1.0 + c - s, s + c, 0.0), 1e-6, where);
    }
    EXPECT_EQ(deformingFrames(write(file(nodes)), {10.0}), 11U);
    EXPECT_EQ(deformingFrames(write(file(nodes)), {24.0}), 25U);
    expectRefused(file(R"("nodes":[{"mesh":0,"skin":0},{},{}])"), "skins[0] has a joint that is not in the scene");
}

TEST_F(AnimatedObject, MorphTargetsChangeVerticesByTheirWeights)
{
    Draft draft = strip();
    std::vector<float> up(18, 0.0F);
    up[13] = 1.0F;  // vertex 4, y
    const std::size_t first = draft.addFloats(up, "VEC3");
    // Vertex 5 alone, by +1 along z.
    const std::size_t index = draft.add(testing::littleEndian(5, 2), 5123, "SCALAR", 1);
    const std::size_t value = draft.addFloats({0, 0, 1}, "VEC3");
    const std::size_t second =
        draft.add(testing::floats(std::vector<float>(18, 0.0F)), 5126, "VEC3", 6,
                  R"(,"sparse":{"count":1,"indices":{"bufferView":)" + std::to_string(index) +
                      R"(,"componentType":5123},"values":{"bufferView":)" + std::to_string(value) + "}}");
    const std::size_t times = draft.addFloats({0, 1}, "SCALAR");
    const std::size_t even = draft.addFloats({0, 1, 2, -1}, "SCALAR");
    const auto file = [&](std::size_t values, const std::string& interpolation) {
        return draft.file(std::string(kStrip) + R"({"POSITION":0},"targets":[{"POSITION":)" + std::to_string(first) +
                          R"(},{"POSITION":)" + std::to_string(second) + R"(}]}]}],"nodes":[{"mesh":0}])" +
                          animations({{0, "weights", times, values, interpolation}}));
    };
    const DeformingObject linear = read(file(even, "LINEAR"));
    ASSERT_THAT(linear.vertices, SizeIs(11));
    for (std::size_t k = 0; k < linear.vertices.size(); ++k) {
        const double t = 0.1 * static_cast<double>(k);
        const std::string where = "frame " + std::to_string(k);
        expectNear(linear.vertices[k][3], ofFile(1.0, 1.0, 0.0), 1e-6, where);
        expectNear(linear.vertices[k][4], ofFile(2.0, 2.0 * t, 0.0), 1e-6, where);
        expectNear(linear.vertices[k][5], ofFile(2.0, 1.0, 1.0 - 2.0 * t), 1e-6, where);
    }
    // Keys of a spline have a tangent before, the values and a tangent after them, of both targets.
    const std::size_t curve = draft.addFloats({0, 0, 0, 1, 3, 0, 0, 0, 2, -1, 0, 0}, "SCALAR");
    const DeformingObject spline = read(file(curve, "CUBICSPLINE"));
    for (std::size_t k = 0; k < spline.vertices.size(); ++k) {
        const double t = 0.1 * static_cast<double>(k);
        const std::string where = "frame " + std::to_string(k);
        const double s = t * t * (3.0 - 2.0 * t);
        expectNear(spline.vertices[k][4], ofFile(2.0, 2.0 * s + 3.0 * t * (1.0 - t) * (1.0 - t), 0.0), 1e-6, where);
        expectNear(spline.vertices[k][5], ofFile(2.0, 1.0, 1.0 - 2.0 * s), 1e-6, where);
    }
    const DeformingObject step = read(file(even, "STEP"));
    expectNear(step.vertices[9][4], ofFile(2.0, 0.0, 0.0), 1e-6, "step");
    expectNear(step.vertices[10][4], ofFile(2.0, 2.0, 0.0), 1e-6, "step");
}

/// A mesh in two nodes, of which the second moves.
std::string parts(Draft& draft, const std::vector<float>& times, const std::vector<float>& places,
                  const std::string& interpolation = "LINEAR")
{
    const std::size_t time = draft.addFloats(times, "SCALAR");
    const std::size_t place = draft.addFloats(places, "VEC3");
    return draft.file(std::string(kStrip) + R"({"POSITION":0}}]}],"nodes":[{"children":[1,2]},{"mesh":0},{"mesh":0}])" +
                      animations({{2, "translation", time, place, interpolation}}));
}

TEST_F(AnimatedObject, NodesMoveApart)
{
    Draft draft = strip();
    const DeformingObject object = read(parts(draft, {0.5, 1}, {0, 0, 2, 0, 0, 4}));
    ASSERT_THAT(object.vertices, SizeIs(11));
    for (std::size_t k = 0; k < object.vertices.size(); ++k) {
        const double t = std::max(0.1 * static_cast<double>(k), 0.5);  // before the first key it stays there
        const std::string where = "frame " + std::to_string(k);
        expectNear(object.vertices[k][1], ofFile(0.0, 1.0, 0.0), 1e-6, where);
        expectNear(object.vertices[k][7], ofFile(0.0, 1.0, 4.0 * t), 1e-6, where);
    }
    // A size is that at time 0; all shapes get the same factor.
    const DeformingObject small = read(parts(draft, {0, 1}, {0, 0, 2, 0, 0, 4}), {10.0}, {.size = 0.02});
    expectNear(small.vertices[10][7], ofFile(0.0, 0.01, 0.04), 1e-8, "small");
}

TEST_F(AnimatedObject, CubicSplinesFollowTheirFormula)
{
    Draft draft = strip();
    // In two seconds from 1 to 3 along y, with the velocities 2 and -1.
    const std::vector<float> keys{0, 9, 0, 0, 1, 0, 0, 2, 0, 0, -1, 0, 0, 3, 0, 0, 9, 0};
    const DeformingObject object = read(parts(draft, {0, 2}, keys, "CUBICSPLINE"));
    ASSERT_THAT(object.vertices, SizeIs(21));
    for (std::size_t k = 0; k < object.vertices.size(); ++k) {
        const double t = 0.05 * static_cast<double>(k);
        const double y = (2 * t * t * t - 3 * t * t + 1) * 1.0 + 2.0 * (t * t * t - 2 * t * t + t) * 2.0 +
                         (-2 * t * t * t + 3 * t * t) * 3.0 + 2.0 * (t * t * t - t * t) * -1.0;
        expectNear(object.vertices[k][6], ofFile(0.0, y, 0.0), 1e-6, "frame " + std::to_string(k));
    }
}

TEST_F(AnimatedObject, CyclesAreRepeatedAndOtherEndsStay)
{
    Draft draft = strip();
    const ObjectSampling longer{10.0, 35};
    const DeformingObject cycle = read(parts(draft, {0, 0.5, 1}, {0, 0, 0, 0, 0, 2, 0, 0, 0}), longer);
    ASSERT_THAT(cycle.vertices, SizeIs(35));
    for (std::size_t k = 0; k < 25; ++k) {
        expectNear(cycle.vertices[k + 10][7], cycle.vertices[k][7], 1e-6, "frame " + std::to_string(k));
    }
    const DeformingObject way = read(parts(draft, {0, 1}, {0, 0, 0, 0, 0, 2}), longer);
    for (std::size_t k = 10; k < 35; ++k) {
        expectNear(way.vertices[k][7], ofFile(0.0, 1.0, 2.0), 1e-6, "frame " + std::to_string(k));
    }
}

TEST_F(AnimatedObject, WholeMotionsAndStillChannelsDeformNothing)
{
    Draft draft = strip();
    const std::size_t times = draft.addFloats({0, 1}, "SCALAR");
    const std::size_t places = draft.addFloats({0, 0, 0, 0, 5, 0}, "VEC3");
    const std::size_t ones = draft.addFloats({1, 1, 1, 1, 1, 1}, "VEC3");
    const std::size_t sizes = draft.addFloats({1, 1, 1, 2, 2, 2}, "VEC3");
    const auto file = [&](const std::vector<Channel>& channels) {
        return draft.file(std::string(kStrip) + R"({"POSITION":0}}]}],"nodes":[{"mesh":0}])" + animations(channels));
    };
    const DeformingObject whole =
        read(file({{0, "translation", times, places}, {0, "scale", times, ones}}), {10.0, 30});
    EXPECT_THAT(whole.vertices, SizeIs(1));
    EXPECT_FALSE(whole.object.motion.rests());
    EXPECT_THAT(whole.object.warnings, IsEmpty());
    EXPECT_EQ(deformingFrames(write(file({{0, "translation", times, places}})), {10.0}), std::nullopt);
    const DeformingObject grows = read(file({{0, "scale", times, sizes}}));
    ASSERT_THAT(grows.vertices, SizeIs(11));
    expectNear(grows.vertices[5][5], ofFile(3.0, 1.5, 0.0), 1e-6, "half");
}

TEST_F(AnimatedObject, AnimationsHaveNames)
{
    Draft draft = strip();
    const std::size_t times = draft.addFloats({0, 1}, "SCALAR");
    const std::size_t first = draft.addFloats({0, 0, 0, 0, 0, 1}, "VEC3");
    const std::size_t second = draft.addFloats({0, 0, 0, 0, 0, 2}, "VEC3");
    const std::string file =
        draft.file(std::string(kStrip) + R"({"POSITION":0}}]}],"nodes":[{"children":[1,2]},{"mesh":0},{"mesh":0}])" +
                   R"(,"animations":[)" + animation({{2, "translation", times, first}}, "walk") + "," +
                   animation({{2, "translation", times, second}}, "run") + "]");
    const DeformingObject one = read(file);
    EXPECT_THAT(one.object.warnings, ElementsAre(HasSubstr("2 animations, of which the first that moves it is used: "
                                                           "walk, run")));
    expectNear(one.vertices[10][6], ofFile(0.0, 0.0, 1.0), 1e-6, "walk");
    const DeformingObject other = read(file, {10.0, {}, "run"});
    EXPECT_THAT(other.object.warnings, IsEmpty());
    expectNear(other.vertices[10][6], ofFile(0.0, 0.0, 2.0), 1e-6, "run");
    expectRefused(file, "it has no animation jump; it has walk, run", {10.0, {}, "jump"});
}

// A plate that turns about the vertical, as a part of an object that does not: droplets run as on a body that turns.
TEST_F(AnimatedObject, ATurningNodeIsARigidMotion)
{
    Draft draft = slope();
    std::vector<float> times;
    std::vector<float> turns;
    constexpr double kRate = 0.5 * std::numbers::pi;  // [rad/s]
    for (int k = 0; k <= 2; ++k) {
        const double turn = 0.5 * kRate * k;
        times.push_back(static_cast<float>(k));
        turns.insert(turns.end(), {0, static_cast<float>(std::sin(turn)), 0, static_cast<float>(std::cos(turn))});
    }
    const std::size_t time = draft.addFloats(times, "SCALAR");
    const std::size_t turn = draft.addFloats(turns, "VEC4");
    const std::size_t sizes = draft.addFloats({1, 1, 1, 1, 1.0002F, 1, 1, 1.0002F, 1}, "VEC3");
    const auto file = [&](bool deforms) {
        std::vector<Channel> channels{{0, "rotation", time, turn}};
        if (deforms) {
            channels.push_back({0, "scale", time, sizes});  // by next to nothing
        }
        return draft.file(R"("scenes":[{"nodes":[0]}],"meshes":[{"primitives":[{"indices":1,"attributes":)"
                          R"({"POSITION":0}}]}],"nodes":[{"mesh":0}])" +
                          animations(channels));
    };
    constexpr double kFrames = 60.0;
    DeformingObject sampled = read(file(true), {kFrames});
    ASSERT_THAT(sampled.vertices, SizeIs(121));
    const DeformingObject rigid = read(file(false), {kFrames});
    ASSERT_THAT(rigid.vertices, SizeIs(1));
    FlowParameters parameters;
    parameters.forces.wetting.hysteresis = 0.05;
    const std::vector<FlowStart> starts{{ofFile(0.1, 0.1 * std::tan(30.0 * kDegree), 0.1), 30e-9, {}}};
    const auto& triangles = rigid.object.triangles;
    FlowShapes shapes(flowSurface(sampled.object.vertices, triangles), triangles, sampled.vertices, kFrames);
    const FlowTerrain terrain(flowSurface(rigid.object.vertices, triangles));
    FlowParameters moving = parameters;
    moving.motion = rigid.object.motion;
    FlowState state = startFlow(shapes.first(), parameters, starts);
    FlowState expected = startFlow(terrain, moving, starts);
    for (int frame = 1; frame <= 60; ++frame) {
        const double now = frame / kFrames;
        state = advanceFlow(std::move(state), shapes, parameters, now);
        expected = advanceFlow(std::move(expected), terrain, moving, now);
        const auto seen = sampleFlow(state, shapes, parameters);
        const auto wanted = sampleFlow(expected, terrain, moving);
        ASSERT_EQ(seen.size(), wanted.size()) << frame;
        if (seen.empty() || wanted.front().contact == FlowContact::Air) {
            break;
        }
        const ObjectPose pose = moving.motion.at(now);
        // The ground of a step is that of its frame: droplets differ by about the way in a step.
        expectNear(seen.front().place, pose.place + pose.toWorld(wanted.front().place), 2e-3,
                   "frame " + std::to_string(frame));
    }
}

}  // namespace
}  // namespace droplet
