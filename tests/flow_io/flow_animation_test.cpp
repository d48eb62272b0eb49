// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_animation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "box_corners.h"
#include "droplet/error.h"
#include "droplet/flow/flow_shapes.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/units.h"
#include "flow_io/unit_bodies.h"
#include "support/animated_scene.h"
#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using testing::AnimatedScene;
using ::testing::HasSubstr;
using testing::Shown;

constexpr double kRate = 30.0;
constexpr double kFrameOfFall = kStandardGravity / kRate;  ///< speed that a droplet gains in a frame [m/s]

const DropletBodies& bodies()
{
    static const DropletBodies made(BodyShape::Capillary);
    return made;
}

/// A sphere with uv and two materials.
FlowObject sphere(double radius)
{
    constexpr std::uint32_t kAround = 24;
    constexpr std::uint32_t kRings = 12;
    FlowObject object;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
        for (std::uint32_t k = 0; k <= kAround; ++k) {
            const double tilt = std::numbers::pi * ring / kRings;
            const double turn = 2.0 * std::numbers::pi * k / kAround;
            object.normals.push_back(
                {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)});
            object.vertices.push_back(radius * object.normals.back());
            object.uvs.push_back({static_cast<double>(k) / kAround, static_cast<double>(ring) / kRings});
            if (ring < kRings && k < kAround) {
                const std::uint32_t a = ring * (kAround + 1) + k;
                const std::uint32_t b = a + kAround + 1;
                object.triangles.push_back({a, b, b + 1});
                object.triangles.push_back({a, b + 1, a + 1});
                object.materials.insert(object.materials.end(), 2, (k / 3) % 2);
            }
        }
    }
    object.material_names = {"skin", "stripes"};
    return object;
}

FlowTerrain theTerrain(const FlowObject& object)
{
    return FlowTerrain(flowSurface(object.vertices, object.triangles));
}

/// Droplets that start near the top of a sphere, run down, merge and fall off.
struct Sequence {
    FlowObject object = sphere(0.05);
    FlowTerrain terrain = theTerrain(object);
    std::vector<double> times;
    std::vector<std::vector<FlowSample>> frames;
    std::size_t max = 0;
    double volume = 0.0;  ///< of all droplets at the start [m³]

    Sequence()
    {
        FlowParameters parameters;
        parameters.adhesion = 30.0;
        std::vector<FlowStart> starts;
        for (int k = 0; k < 90; ++k) {
            const double tilt = 0.25 + 0.015 * k;
            const double turn = 2.4 * k;
            const Vec3 up{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
            starts.push_back({terrain.nearest(0.05 * up).place, (k % 5 == 0 ? 60e-9 : 1e-9 * (2 + k % 7)), {}});
        }
        for (const FlowStart& start : starts) {
            volume += start.volume;
        }
        FlowState state = startFlow(terrain, parameters, starts);
        for (int frame = 0; frame < 30; ++frame) {
            times.push_back(frame / kRate);
            state = advanceFlow(std::move(state), terrain, parameters, times.back());
            frames.push_back(sampleFlow(state, terrain, parameters));
            max = std::max(max, frames.back().size());
        }
    }

    [[nodiscard]] std::string animation(const FlowAnimationOptions& options = {}) const
    {
        FlowAnimation made(object, terrain, bodies(), options);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            made.add(times[i], frames[i]);
        }
        std::ostringstream out;
        const std::uint64_t bytes = made.write(out);
        EXPECT_EQ(bytes, out.str().size());
        return out.str();
    }
};

const Sequence& theRun()
{
    static const Sequence run;
    return run;
}

/// Vector in the file's frame: +Y up.
Vec3 inFile(Vec3 v)
{
    return {v.x, v.z, -v.y};
}

/// Tolerance of a place along the path of a droplet [m].
double slackOf(const FlowSample& sample)
{
    return 2e-3 * (length(sample.velocity) + kFrameOfFall) + 1e-4;
}

TEST(FlowAnimation, ShowsTheDropletsOfEveryFrame)
{
    const Sequence& run = theRun();
    const AnimatedScene scene(run.animation());
    const double unit = unitVolume(bodies());
    std::set<std::string> meshes;
    for (std::size_t frame = 0; frame < run.frames.size(); frame += 5) {
        SCOPED_TRACE(frame);
        const std::vector<Shown> shown = scene.at((static_cast<double>(frame) + 1e-3) / kRate);
        ASSERT_EQ(shown.size(), run.frames[frame].size());
        for (const FlowSample& sample : run.frames[frame]) {
            const double radius = std::cbrt(sample.volume / unit);
            const double size = 1.6 * radius;  // a droplet on its way is wider and longer than one at rest
            const double slack = 0.1 * size + slackOf(sample);
            const auto fits = [&](const Shown& one) {
                return length(one.place - inFile(sample.place)) < slack &&
                       std::abs(std::cbrt(one.scale.x * one.scale.y * one.scale.z) / radius - 1.0) < 0.015;
            };
            const auto one = std::find_if(shown.begin(), shown.end(), fits);
            ASSERT_NE(one, shown.end()) << sample.id;
            meshes.insert(one->mesh);
            EXPECT_EQ(one->mesh == "droplets in the air", sample.contact == FlowContact::Air) << sample.id;
            if (sample.contact != FlowContact::Air) {
                EXPECT_GT(dot(one->y, inFile(sample.normal)), std::cos(1.8 * kDegree)) << sample.id;
            }
            if (one->mesh == "droplets on their way" && length(sample.velocity) > 0.1) {
                const Vec3 ahead = inFile(frameOf(sample, {}).ahead);
                EXPECT_GT(dot(one->x, ahead), 0.5) << sample.id;
            }
        }
    }
    EXPECT_EQ(meshes.size(), 3U) << "there are resting, running and falling droplets";
}

/// Distance of a droplet's rim from the ground, over its contact radius.
double gapOf(const FlowTerrain& terrain, const Shown& one, const AnimatedScene::Shape& shape)
{
    constexpr std::size_t kRim = 16;
    const std::size_t base = shape.vertices.size() - (3 * kRim + 1);
    double gap = 0.0;
    for (std::size_t v = base; v < base + kRim; ++v) {
        const Vec3 p = shape.vertices[v];
        const Vec3 in_file =
            one.place + one.scale.x * p.x * one.x + one.scale.y * p.y * one.y + one.scale.z * p.z * cross(one.x, one.y);
        const Vec3 place{in_file.x, -in_file.z, in_file.y};
        gap = std::max(gap, length(place - terrain.nearest(place).place));
    }
    return gap / std::sqrt(one.scale.x * one.scale.z);
}

double volumeOf(const AnimatedScene::Shape& shape)
{
    double volume = 0.0;
    for (const auto& [a, b, c] : shape.triangles) {
        volume += dot(shape.vertices[a], cross(shape.vertices[b], shape.vertices[c])) / 6.0;
    }
    return volume;
}

// The ball has edges of 15°.
TEST(FlowAnimation, DropletsSitOnTheObject)
{
    const Sequence& run = theRun();
    const AnimatedScene scene(run.animation());
    const std::vector<AnimatedScene::Shape> shapes = scene.shapes();
    std::vector<double> gaps;
    std::vector<double> volumes;
    for (std::size_t frame = 0; frame < run.frames.size(); ++frame) {
        for (const Shown& one : scene.at((static_cast<double>(frame) + 1e-3) / kRate)) {
            if (one.mesh != "droplets in the air") {
                gaps.push_back(gapOf(run.terrain, one, shapes[one.slot]));
                volumes.push_back(volumeOf(shapes[one.slot]) / unitVolume(bodies()));
            }
        }
    }
    ASSERT_GT(gaps.size(), 1000U);
    std::sort(gaps.begin(), gaps.end());
    std::sort(volumes.begin(), volumes.end());
    EXPECT_LE(gaps[gaps.size() * 99 / 100], 0.05);
    EXPECT_GE(volumes.front(), 0.99);
    EXPECT_LE(volumes.back(), 1.01);
    EXPECT_LE(scene.pool(), 5 * run.max) << "shapes are used again where they fit";
}

TEST(FlowAnimation, StreaksGrowAndDry)
{
    const Sequence& run = theRun();
    FlowParameters parameters;
    parameters.adhesion = 30.0;
    std::vector<FlowStart> starts;
    for (int k = 0; k < 12; ++k) {
        starts.push_back({run.terrain.nearest({0.01 * std::cos(k), 0.01 * std::sin(k), 0.05}).place, 60e-9, {}});
    }
    FlowState state = startFlow(run.terrain, parameters, starts);
    FlowAnimation made(run.object, run.terrain, bodies());
    StreakRibbons ribbons;
    std::vector<double> areas;  // of the streaks at every frame
    const auto area_of = [](const Surface& surface) {
        double area = 0.0;
        for (const auto& [a, b, c] : surface.triangles) {
            area += 0.5 *
                    length(cross(surface.vertices[b] - surface.vertices[a], surface.vertices[c] - surface.vertices[a]));
        }
        return area;
    };
    for (int frame = 0; frame < 12; ++frame) {
        state = advanceFlow(std::move(state), run.terrain, parameters, frame / kRate);
        ribbons.add(state.tracks, run.terrain.surface());
        made.add(frame / kRate, sampleFlow(state, run.terrain, parameters));
        areas.push_back(area_of(ribbons.mesh(frame / kRate).surface));
    }
    ASSERT_GT(areas[9], 1.5 * areas[5]);
    ASSERT_GT(areas[5], 0.0);
    const StreakMesh streaks = ribbons.growing(1.0 / kRate);
    const auto shown = [&](const std::optional<double>& drying, int frame) {
        StreakMesh vanishing = streaks;
        for (std::size_t i = 0; drying && i < streaks.gone.size(); ++i) {
            vanishing.gone[i] = streaks.wetted[i] + *drying;
        }
        made.setStreaks(std::move(vanishing));
        std::ostringstream out;
        made.write(out);
        const AnimatedScene scene(out.str());
        double area = 0.0;
        for (std::size_t i = 0; i < scene.model().at("nodes").size(); ++i) {
            const nlohmann::json& node = scene.model().at("nodes")[i];
            if (node.value("name", "").starts_with("streaks of frames ") &&
                scene.at(i, "scale", (frame + 1e-3) / kRate)[0] > 0.0) {
                const auto [vertices, triangles] = scene.meshOf(node.at("mesh").get<std::size_t>());
                Surface surface;
                surface.vertices = vertices;
                for (const auto& [a, b, c] : triangles) {
                    surface.triangles.push_back(
                        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
                }
                area += area_of(surface);
            }
        }
        return area;
    };
    const auto wetted = [&](int from, int to) {
        double area = 0.0;
        for (std::size_t i = 0; i < streaks.wetted.size(); ++i) {
            const auto frame = static_cast<int>(std::ceil(streaks.wetted[i] * kRate - 1e-6));
            const auto& [a, b, c] = streaks.surface.triangles[i];
            const Vec3 origin = streaks.surface.vertices[a];
            const double size =
                0.5 * length(cross(streaks.surface.vertices[b] - origin, streaks.surface.vertices[c] - origin));
            area += frame >= from && frame <= to ? size : 0.0;
        }
        return area;
    };
    for (const int frame : {0, 5, 9, 11}) {
        EXPECT_NEAR(shown({}, frame), wetted(0, frame), 1e-9) << frame;
    }
    EXPECT_NEAR(shown(3 / kRate, 11), wetted(9, 11), 1e-9) << "what is older is dry";
}

TEST(FlowAnimation, OnFlatGroundDropletsShareOneShape)
{
    FlowObject plate;
    plate.vertices = {{-0.1, -0.1, 0.0}, {0.1, -0.1, 0.0}, {0.1, 0.1, 0.0}, {-0.1, 0.1, 0.0}};
    plate.normals.assign(4, {0.0, 0.0, 1.0});
    plate.triangles = {{0, 1, 2}, {0, 2, 3}};
    const FlowTerrain terrain = theTerrain(plate);
    FlowAnimation made(plate, terrain, bodies());
    std::vector<FlowSample> samples;
    for (int k = 0; k < 200; ++k) {
        FlowSample sample;
        sample.id = static_cast<std::uint64_t>(k);
        sample.contact = FlowContact::Still;
        sample.place = {-0.08 + 0.01 * (k % 17), -0.08 + 0.012 * (k / 17), 0.0};
        sample.normal = {0.0, 0.0, 1.0};
        sample.volume = 1e-9 * (1 + k % 5);
        samples.push_back(sample);
    }
    made.add(0.0, samples);
    std::ostringstream out;
    made.write(out);
    EXPECT_EQ(AnimatedScene(out.str()).model().at("meshes").size(), 2U) << "the plate and one of droplets";
}

TEST(FlowAnimation, MovesTheDropletsWithTheObject)
{
    ObjectMotion motion;
    motion.keys = {{0.0, {}}, {0.5, {{0.1, 0.2, 0.3}, {0.0, 0.6, 0.0}, 0.8}}};
    FlowSample sample = theRun().frames.front().front();
    sample.velocity = {};
    FlowAnimation made(theRun().object, theRun().terrain, bodies(), {.motion = motion});
    for (int frame = 0; frame <= 30; ++frame) {
        made.add(frame / kRate, {&sample, 1});
    }
    std::ostringstream out;
    made.write(out);
    const AnimatedScene scene(out.str());
    for (const int frame : {0, 7, 15, 30}) {
        const ObjectPose pose = motion.at(frame / kRate);
        const std::vector<Shown> shown = scene.at(frame / kRate + 1e-6);
        ASSERT_EQ(shown.size(), 1U);
        EXPECT_LT(length(shown[0].place - inFile(pose.place + pose.toWorld(sample.place))), 1e-5) << frame;
        EXPECT_GT(dot(shown[0].y, inFile(pose.toWorld(sample.normal))), std::cos(0.1 * kDegree)) << frame;
    }
}

TEST(FlowAnimation, PlaysInThree)
{
    const testing::ScratchDirectory scratch;
    const std::string file = (scratch.path() / "run.glb").string();
    testing::writeFile(file, theRun().animation());
    const std::vector<std::size_t> frames{0, 9, 29};
    std::vector<std::string> command{"node", testing::inSource("tests/page/joints.mjs"), testing::kThree, file};
    for (const std::size_t frame : frames) {
        command.push_back(std::to_string((static_cast<double>(frame) + 1e-3) / kRate));
    }
    const auto run = testing::runProgram(command);
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto played = nlohmann::json::parse(run.output);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const std::vector<FlowSample>& samples = theRun().frames[frames[i]];
        ASSERT_EQ(played.at(i).size(), samples.size());
        double volume = 0.0;
        for (const auto& joint : played.at(i)) {
            volume += std::pow(joint.at("size").get<double>(), 3) * unitVolume(bodies());
        }
        for (const FlowSample& sample : samples) {
            volume -= sample.volume;
            EXPECT_TRUE(std::any_of(played.at(i).begin(), played.at(i).end(), [&](const auto& joint) {
                const Vec3 place{joint.at("place").at(0), joint.at("place").at(1), joint.at("place").at(2)};
                return length(place - inFile(sample.place)) < 0.2 * std::cbrt(sample.volume) + slackOf(sample);
            })) << sample.id;
        }
        EXPECT_NEAR(volume / theRun().volume, 0.0, 0.02);
    }
}

TEST(FlowAnimation, IsTheSameWithAnyNumberOfThreads)
{
    const std::string many = theRun().animation();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(theRun().animation(), many);
}

TEST(FlowAnimation, MeshesOfDropletsHaveTheUnitVolume)
{
    const double unit = unitVolume(bodies());
    BodyConditions running;
    running.volume = 30e-9;
    running.speed = 0.3;
    running.gravity = {5.0, 0.0, -5.0};
    for (const DropletMesh& mesh : {unitBody(bodies(), running, {}, unit), unitBall({}, unit)}) {
        double volume = 0.0;
        for (const auto& [a, b, c] : mesh.triangles) {
            volume += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6.0;
        }
        EXPECT_NEAR(volume / unit, 1.0, 1e-12);
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            EXPECT_NEAR(length(mesh.normals[i]), 1.0, 1e-12);
            EXPECT_GT(dot(mesh.normals[i], mesh.vertices[i] + Vec3{0.0, 0.0, -1e-6}), 0.0) << "outward";
        }
    }
    const auto [low, high] = cornersOf(unitBody(bodies(), running, {}, unit).vertices);
    EXPECT_NEAR(high.x - low.x, 2.0, 1e-9);
    EXPECT_NEAR(high.y - low.y, 2.0, 1e-9);
}

TEST(FlowAnimation, PassesTheValidator)
{
    const testing::ScratchDirectory scratch;
    std::vector<std::string> command{"node", testing::kValidator};
    const auto store = [&](const char* name, const std::string& bytes) {
        const std::string path = (scratch.path() / name).string();
        testing::writeFile(path, bytes);
        command.push_back(path);
    };
    FlowAnimationOptions options;
    options.material = Material::Ink;
    options.motion.spin = {0.5, 0.0, 6.0};
    store("run.glb", theRun().animation(options));
    FlowObject plain = sphere(0.05);
    plain.uvs.clear();
    plain.materials.clear();
    plain.material_names.clear();
    FlowAnimation dry(plain, theRun().terrain, bodies());
    dry.add(0.0, {});
    dry.add(0.1, {});
    StreakMesh streaks{dropletSurfaces(theRun().frames.front(), {bodies(), {}}), {}, {}};
    streaks.wetted.resize(streaks.surface.triangles.size(), 0.01);
    streaks.gone.resize(streaks.surface.triangles.size(), 0.03);
    dry.setStreaks(streaks);
    std::ostringstream out;
    dry.write(out);
    store("dry.glb", out.str());
    const auto verdict = testing::runProgram(command);
    EXPECT_EQ(verdict.exit_code, 0) << verdict.output << verdict.error;
    for (const char* name : {"run", "dry"}) {
        EXPECT_THAT(verdict.output + verdict.error, HasSubstr(std::string(name) + ".glb: 0 errors, 0 warnings"));
    }
}

TEST(FlowAnimation, RejectsAnimationsWithoutFrames)
{
    const FlowTerrain terrain = theTerrain(sphere(0.05));
    EXPECT_THROW(FlowAnimation(sphere(0.05), terrain, bodies(), {.frames_per_second = 0.0}), Error);
    std::ostringstream out;
    EXPECT_THROW(FlowAnimation(sphere(0.05), terrain, bodies()).write(out), Error);
}

// A ball that bends, stretches and shakes, with droplets that stay where they are on it.
TEST(FlowAnimation, AnObjectThatDeformsCarriesItsDroplets)
{
    const FlowObject object = sphere(0.05);
    constexpr int kFrames = 24;
    std::vector<std::vector<Vec3>> vertices;
    for (int k = 0; k < kFrames; ++k) {
        const double time = k / kRate;
        std::vector<Vec3>& shape = vertices.emplace_back();
        for (const Vec3& p : object.vertices) {
            const double twist = 8.0 * time * p.z;
            const double c = std::cos(twist);
            const double s = std::sin(twist);
            shape.push_back({c * p.x - s * p.y + 0.03 * std::sin(9.0 * time), s * p.x + c * p.y,
                             (1.0 + 0.2 * std::sin(5.0 * time)) * p.z});
        }
    }
    FlowShapes shapes(flowSurface(object.vertices, object.triangles), object.triangles, vertices, kRate);
    FlowParameters parameters;
    parameters.forces.wetting.hysteresis = 1.9;
    std::vector<FlowStart> starts;
    for (int k = 0; k < 25; ++k) {
        const double tilt = 0.3 + 0.04 * k;
        const double turn = 2.4 * k;
        const Vec3 up{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
        starts.push_back({shapes.first().nearest(0.05 * up).place, 1e-9 * (2 + k % 5), {}});
    }
    FlowState state = startFlow(shapes.first(), parameters, starts);
    FlowAnimation animation(object, shapes, bodies(), {});
    std::vector<std::vector<FlowSample>> frames;
    for (int k = 0; k < kFrames; ++k) {
        state = advanceFlow(std::move(state), shapes, parameters, k / kRate);
        frames.push_back(sampleFlow(state, shapes, parameters));
        animation.add(k / kRate, frames.back(), shapes.of(state, parameters.step));
    }
    std::ostringstream out;
    animation.write(out);
    const testing::ScratchDirectory scratch;
    testing::writeFile(scratch.path() / "a.glb", out.str());
    const DeformingObject back = readAnimatedObject(scratch.path() / "a.glb", {kRate, kFrames});
    ASSERT_EQ(back.vertices.size(), static_cast<std::size_t>(kFrames));
    for (std::size_t k = 0; k < back.vertices.size(); ++k) {
        double farthest = 0.0;
        for (std::size_t v = 0; v < object.vertices.size(); ++v) {
            farthest = std::max(farthest, length(back.vertices[k][v] - vertices[k][v]));
        }
        EXPECT_LT(farthest, 5.1e-5 * length(sizeOf(object))) << k;
    }
    const AnimatedScene scene(out.str());
    const std::vector<AnimatedScene::Shape> seats = scene.shapes();
    EXPECT_LT(scene.model().at("meshes").at(0).at("primitives").at(0).at("targets").size(), 12U);
    for (std::size_t k = 0; k < back.vertices.size(); ++k) {
        const std::vector<Shown> shown = scene.at((static_cast<double>(k) + 1e-3) / kRate);
        EXPECT_EQ(shown.size(), frames[k].size()) << k;
        for (const FlowSample& sample : frames[k]) {
            ASSERT_NE(sample.contact, FlowContact::Air);
            const Vec3 place = inFile(sample.place);
            const auto nearest = std::min_element(shown.begin(), shown.end(), [&](const Shown& a, const Shown& b) {
                return length(a.place - place) < length(b.place - place);
            });
            EXPECT_EQ(nearest->mesh, "droplets at rest");
            EXPECT_LT(length(nearest->place - place), 0.11 * nearest->scale.z) << k;
            EXPECT_GT(dot(nearest->y, inFile(sample.normal)), std::cos(2.0 * kDegree)) << k;
        }
        const auto terrain = shapes.at(static_cast<std::size_t>(k));
        double gaps = 0.0;
        for (const Shown& one : shown) {
            gaps += gapOf(*terrain, one, seats[one.slot]) / static_cast<double>(shown.size());
        }
        EXPECT_LT(gaps, 0.12) << k << ": the ground stretches by a fifth";
    }
}

// A ball that is stretched along x: its streaks are stretched with it.
TEST(FlowAnimation, AnObjectThatDeformsCarriesItsStreaks)
{
    const FlowObject object = sphere(0.05);
    constexpr std::size_t kFrames = 13;
    constexpr double kStretch = 0.3;
    std::vector<std::vector<Vec3>> vertices;
    for (std::size_t k = 0; k < kFrames; ++k) {
        std::vector<Vec3>& shape = vertices.emplace_back();
        for (const Vec3& p : object.vertices) {
            shape.push_back(p + kStretch * static_cast<double>(k) / (kFrames - 1) * Vec3{p.x, 0.0, 0.0});
        }
    }
    FlowShapes shapes(flowSurface(object.vertices, object.triangles), object.triangles, vertices, kRate);
    FlowParameters parameters;
    parameters.adhesion = 30.0;
    std::vector<FlowStart> starts;
    for (int k = 0; k < 6; ++k) {
        starts.push_back({shapes.first().nearest({0.02 * std::cos(k), 0.02 * std::sin(k), 0.05}).place, 60e-9, {}});
    }
    FlowState state = startFlow(shapes.first(), parameters, starts);
    FlowAnimation animation(object, shapes, bodies(), {});
    StreakRibbons ribbons;
    for (std::size_t k = 0; k < kFrames; ++k) {
        const double time = static_cast<double>(k) / kRate;
        state = advanceFlow(std::move(state), shapes, parameters, time);
        ribbons.add(state.tracks, shapes.first().surface());
        animation.add(time, sampleFlow(state, shapes, parameters), shapes.of(state, parameters.step));
    }
    animation.setStreaks(ribbons.growing(1.0 / kRate));
    std::ostringstream out;
    animation.write(out);
    const AnimatedScene scene(out.str());
    std::size_t count = 0;
    for (std::size_t i = 0; i < scene.model().at("nodes").size(); ++i) {
        const nlohmann::json& node = scene.model().at("nodes")[i];
        if (!node.value("name", "").starts_with("streaks of frames ")) {
            continue;
        }
        const auto mesh = node.at("mesh").get<std::size_t>();
        const AnimatedScene::Shape streak = scene.meshOf(mesh);
        const std::size_t targets = scene.model().at("meshes")[0].at("primitives")[0].at("targets").size();
        ASSERT_EQ(scene.model().at("meshes")[mesh].at("primitives")[0].at("targets").size(), targets);
        for (std::size_t k = 0; k < targets; ++k) {
            // Each change is a stretch, too.
            const std::vector<Vec3> of_object = scene.changeOf(0, k);
            const std::vector<Vec3> change = scene.changeOf(mesh, k);
            const auto outermost = std::max_element(object.vertices.begin(), object.vertices.end(),
                                                    [](Vec3 a, Vec3 b) { return a.x < b.x; });
            const double stretch =
                of_object[static_cast<std::size_t>(outermost - object.vertices.begin())].x / outermost->x;
            ASSERT_EQ(change.size(), streak.vertices.size());
            for (std::size_t v = 0; v < change.size(); ++v) {
                EXPECT_LT(length(change[v] - stretch * Vec3{streak.vertices[v].x, 0.0, 0.0}), 5e-5);
            }
        }
        ++count;
    }
    EXPECT_GT(count, 3U);
}

// Ponds are meshes of their own, one at a time.
TEST(FlowAnimation, ShowsPonds)
{
    constexpr std::uint32_t kSide = 40;
    FlowObject bowl;
    for (std::uint32_t j = 0; j <= kSide; ++j) {
        for (std::uint32_t i = 0; i <= kSide; ++i) {
            const Vec2 p{0.1 * (1.0 * i / kSide - 0.5), 0.1 * (1.0 * j / kSide - 0.5)};
            bowl.vertices.push_back({p.x, p.y, 12.5 * dot(p, p)});
            bowl.normals.push_back({0.0, 0.0, 1.0});
        }
    }
    for (std::uint32_t j = 0; j < kSide; ++j) {
        for (std::uint32_t i = 0; i < kSide; ++i) {
            const std::uint32_t a = j * (kSide + 1) + i;
            bowl.triangles.push_back({a, a + 1, a + kSide + 2});
            bowl.triangles.push_back({a, a + kSide + 2, a + kSide + 1});
        }
    }
    const FlowTerrain terrain(flowSurface(bowl.vertices, bowl.triangles));
    const FlowParameters parameters;
    FlowState state = startFlow(terrain, parameters, {{{0.0, 0.0, 0.0}, 20e-6, {}}});
    FlowAnimation animation(bowl, terrain, bodies());
    for (int k = 0; k < 4; ++k) {
        state = advanceFlow(std::move(state), terrain, parameters, k / kRate);
        const std::vector<FlowSample> samples = sampleFlow(state, terrain, parameters);
        ASSERT_TRUE(samples[0].pond);
        animation.add(k / kRate, samples);
    }
    std::ostringstream out;
    animation.write(out);
    const AnimatedScene scene(out.str());
    for (int frame = 0; frame < 4; ++frame) {
        double volume = 0.0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < scene.model().at("nodes").size(); ++i) {
            const nlohmann::json& node = scene.model().at("nodes")[i];
            if (node.value("name", "").starts_with("pond of frames ") &&
                scene.at(i, "scale", (frame + 1e-3) / kRate)[0] > 0.0) {
                const auto [vertices, triangles] = scene.meshOf(node.at("mesh").get<std::size_t>());
                for (const auto& [a, b, c] : triangles) {
                    volume += dot(vertices[a], cross(vertices[b], vertices[c])) / 6.0;
                }
                ++count;
            }
        }
        EXPECT_EQ(count, 1U) << frame;
        EXPECT_NEAR(volume / 20e-6, 1.0, 1e-4) << "the file has floats";
    }
    EXPECT_TRUE(scene.at(0.0).empty()) << "no droplet besides";
}

}  // namespace
}  // namespace droplet
