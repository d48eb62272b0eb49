// SPDX-License-Identifier: GPL-3.0-or-later
//
// These tests play animations as the specification requires of viewers (glTF 2.0, section 3.11 and appendix C).
#include "droplet/io/animation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "support/surfaces.h"
#include "support/usda.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using testing::roundDroplet;

/// Frames of an animation, and where new triangles begin.
struct Film {
    std::vector<Surface> frames;
    std::vector<bool> continues;
};

/// Runs with given numbers of frames. In a run the droplet grows and moves; every run has its own triangles.
Film filmOf(const std::vector<int>& runs, bool open = false)
{
    Film film;
    std::uint32_t segments = 9;
    for (const int length : runs) {
        for (int k = 0; k < length; ++k) {
            const double t = 0.05 * k;
            film.frames.push_back(roundDroplet({.inner = segments % 2 == 0 ? 1e-3 : 0.0,
                                                .outer = 4e-3 + 0.5e-3 * t,
                                                .height = 1e-3 * (1.0 + t),
                                                .segments = segments,
                                                .open = open,
                                                .centre = {2e-3 * t, -1e-3 * t}}));
            film.continues.push_back(k > 0);
        }
        ++segments;
    }
    return film;
}

std::string written(const Film& film, const AnimationOptions& options = {}, const AnimatedFile& file = {})
{
    Animation animation(options);
    for (std::size_t k = 0; k < film.frames.size(); ++k) {
        animation.add(film.frames[k], film.continues[k]);
    }
    std::ostringstream out;
    const std::uint64_t bytes = animation.write(out, file);
    EXPECT_EQ(bytes, out.str().size());
    EXPECT_TRUE(out.good());
    return out.str();
}

tinygltf::Model parsed(const std::string& bytes)
{
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error;
    std::string warning;
    EXPECT_TRUE(reader.LoadBinaryFromMemory(&model, &error, &warning,
                                            reinterpret_cast<const unsigned char*>(bytes.data()),
                                            static_cast<unsigned>(bytes.size())))
        << error;
    EXPECT_EQ(warning, "");
    return model;
}

std::size_t at(int index)
{
    return static_cast<std::size_t>(index);
}

template <class Number>
std::vector<Number> numbersOf(const tinygltf::Model& model, int index)
{
    const tinygltf::Accessor& accessor = model.accessors.at(at(index));
    const tinygltf::BufferView& view = model.bufferViews.at(at(accessor.bufferView));
    std::vector<Number> numbers(accessor.count *
                                at(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type))));
    EXPECT_LE(accessor.byteOffset + numbers.size() * sizeof(Number), view.byteLength);
    EXPECT_EQ((view.byteOffset + accessor.byteOffset) % 4, 0U);
    std::memcpy(numbers.data(), model.buffers.at(0).data.data() + view.byteOffset + accessor.byteOffset,
                numbers.size() * sizeof(Number));
    return numbers;
}

/// Value of a channel at a time.
std::vector<double> sampled(const tinygltf::Model& model, const tinygltf::AnimationChannel& channel, double time)
{
    const tinygltf::AnimationSampler& sampler = model.animations.at(0).samplers.at(at(channel.sampler));
    const auto times = numbersOf<float>(model, sampler.input);
    const auto values = numbersOf<float>(model, sampler.output);
    const std::size_t width = values.size() / times.size();
    EXPECT_EQ(values.size(), width * times.size());
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
    std::size_t key = 0;
    while (key + 1 < times.size() && static_cast<double>(times[key + 1]) <= time) {
        ++key;
    }
    double part = 0.0;
    if (sampler.interpolation == "LINEAR" && key + 1 < times.size() && time > static_cast<double>(times[key])) {
        part = (time - static_cast<double>(times[key])) / static_cast<double>(times[key + 1] - times[key]);
    }
    std::vector<double> result;
    for (std::size_t i = 0; i < width; ++i) {
        const double from = static_cast<double>(values[key * width + i]);
        const double to = part > 0.0 ? static_cast<double>(values[(key + 1) * width + i]) : from;
        result.push_back(from + part * (to - from));
    }
    return result;
}

/// Vertices of the node that is visible at a time.
struct Shown {
    std::size_t nodes = 0;
    std::size_t node = 0;
    std::vector<Vec3> vertices;
    std::vector<Vec3> normals;
    std::vector<Triangle> triangles;
};

Shown playedAt(const tinygltf::Model& model, double time)
{
    Shown shown;
    for (std::size_t n = 0; n < model.nodes.size(); ++n) {
        const tinygltf::Node& node = model.nodes[n];
        const tinygltf::Mesh& mesh = model.meshes.at(at(node.mesh));
        std::vector<double> scale = node.scale.empty() ? std::vector<double>(3, 1.0) : node.scale;
        std::vector<double> weights = mesh.weights;
        for (const tinygltf::AnimationChannel& channel :
             model.animations.empty() ? std::vector<tinygltf::AnimationChannel>{} : model.animations[0].channels) {
            if (channel.target_node == static_cast<int>(n)) {
                (channel.target_path == "scale" ? scale : weights) = sampled(model, channel, time);
            }
        }
        if (scale == std::vector<double>(3, 0.0)) {
            continue;
        }
        EXPECT_EQ(scale, std::vector<double>(3, 1.0));
        ++shown.nodes;
        shown.node = n;
        const tinygltf::Primitive& primitive = mesh.primitives.at(0);
        EXPECT_EQ(weights.size(), primitive.targets.size());
        const auto morphed = [&](const char* name) {
            const auto base = numbersOf<float>(model, primitive.attributes.at(name));
            std::vector<double> sums(base.begin(), base.end());
            for (std::size_t i = 0; i < weights.size(); ++i) {
                const auto change = numbersOf<float>(model, primitive.targets[i].at(name));
                for (std::size_t j = 0; j < sums.size(); ++j) {
                    sums[j] += weights[i] * static_cast<double>(change[j]);
                }
            }
            std::vector<Vec3> vectors;
            for (std::size_t j = 0; j < sums.size(); j += 3) {
                vectors.push_back({sums[j], -sums[j + 2], sums[j + 1]});
            }
            return vectors;
        };
        shown.vertices = morphed("POSITION");
        shown.normals = morphed("NORMAL");
        const auto indices = numbersOf<std::uint16_t>(model, primitive.indices);
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            shown.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
        }
    }
    return shown;
}

void expectShows(const tinygltf::Model& model, double time, const Surface& surface)
{
    SCOPED_TRACE("at " + std::to_string(time) + " s");
    const Shown shown = playedAt(model, time);
    ASSERT_EQ(shown.nodes, 1U);
    EXPECT_EQ(shown.triangles, surface.triangles);
    ASSERT_EQ(shown.vertices.size(), surface.vertices.size());
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
        ASSERT_LT(length(shown.vertices[v] - surface.vertices[v]), 1e-9);
        ASSERT_LT(length((1.0 / length(shown.normals[v])) * shown.normals[v] - surface.normals[v]), 1e-6);
    }
}

void expectPlays(const Film& film, double rate)
{
    const tinygltf::Model model = parsed(written(film, {.frames_per_second = rate, .frames = film.frames.size()}));
    const auto count = static_cast<double>(film.frames.size());
    for (std::size_t k = 0; k < film.frames.size(); ++k) {
        // Players store key times as floats.
        expectShows(model, static_cast<double>(static_cast<float>(static_cast<double>(k) / rate)), film.frames[k]);
    }
    expectShows(model, (count - 0.5) / rate, film.frames.back());
    expectShows(model, count / rate, film.frames.back());
    float end = 0.0F;
    for (const tinygltf::AnimationSampler& sampler :
         model.animations.empty() ? std::vector<tinygltf::AnimationSampler>{} : model.animations[0].samplers) {
        const auto times = numbersOf<float>(model, sampler.input);
        EXPECT_EQ(model.accessors[at(sampler.input)].minValues,
                  std::vector<double>{static_cast<double>(times.front())});
        EXPECT_EQ(model.accessors[at(sampler.input)].maxValues, std::vector<double>{static_cast<double>(times.back())});
        if (sampler.interpolation == "STEP") {
            EXPECT_EQ(times.front(), 0.0F);
        }
        end = std::max(end, times.back());
    }
    if (film.frames.size() > 1) {
        EXPECT_FLOAT_EQ(end, static_cast<float>(count / rate));
    }
}

TEST(Animation, ShowsEveryFrameAtItsTimeAndNothingElse)
{
    expectPlays(filmOf({5}), 24.0);
    expectPlays(filmOf({1, 1, 1}), 24.0);
    expectPlays(filmOf({3, 1, 4, 1}), 30.0);
    expectPlays(filmOf({1, 6}), 29.97);
    expectPlays(filmOf({1}), 24.0);
    expectPlays(filmOf({2, 2}, true), 12.0);
}

TEST(Animation, BetweenFramesOfARunVerticesMoveInStraightLines)
{
    const Film film = filmOf({4, 2});
    const tinygltf::Model model = parsed(written(film, {.frames_per_second = 10.0}));
    const Shown shown = playedAt(model, 0.125);
    ASSERT_EQ(shown.nodes, 1U);
    for (std::size_t v = 0; v < shown.vertices.size(); ++v) {
        const Vec3 wanted = 0.75 * film.frames[1].vertices[v] + 0.25 * film.frames[2].vertices[v];
        EXPECT_LT(length(shown.vertices[v] - wanted), 1e-8);
    }
    // The last frame of a run stands still.
    expectShows(model, 0.399, film.frames[3]);
}

TEST(Animation, LongRunsContinueInAnotherNodeWithoutAJump)
{
    for (const int length : {64, 65, 66, 130}) {
        const Film film = filmOf({length, 2});
        expectPlays(film, 25.0);
        const tinygltf::Model model = parsed(written(film, {.frames_per_second = 25.0}));
        for (const tinygltf::Mesh& mesh : model.meshes) {
            EXPECT_LE(mesh.primitives[0].targets.size(), 64U);
        }
        if (length > 66) {
            EXPECT_EQ(playedAt(model, 63.5 / 25.0).node, 0U);
            EXPECT_EQ(playedAt(model, 64.5 / 25.0).node, 1U);
            const Shown between = playedAt(model, 63.5 / 25.0);
            for (std::size_t v = 0; v < between.vertices.size(); ++v) {
                const Vec3 wanted = 0.5 * (film.frames[63].vertices[v] + film.frames[64].vertices[v]);
                EXPECT_LT(droplet::length(between.vertices[v] - wanted), 1e-7);
            }
        }
    }
}

TEST(Animation, ShowsTheFirstFrameIfNotPlayed)
{
    const Film film = filmOf({2, 3});
    tinygltf::Model model = parsed(written(film));
    model.animations.clear();
    expectShows(model, 0.0, film.frames[0]);
}

TEST(Animation, IsClosedAtEveryWeight)
{
    const Film film = filmOf({4});
    const tinygltf::Model model = parsed(written(film, {.frames_per_second = 10.0}));
    for (const double time : {0.0, 0.04, 0.1, 0.17, 0.25, 0.3}) {
        Surface seen = film.frames[0];
        const Shown shown = playedAt(model, time);
        seen.vertices = shown.vertices;
        for (std::size_t v = 0; v < seen.weld.size(); ++v) {
            EXPECT_EQ(seen.vertices[v], seen.vertices[seen.weld[v]]) << "copies move alike";
        }
        EXPECT_TRUE(isClosed(seen));
        EXPECT_GT(enclosedVolume(seen), 0.0);
    }
}

TEST(Animation, EqualFramesHaveNoDifference)
{
    Film film = filmOf({1});
    film.frames.resize(3, film.frames[0]);
    film.continues = {false, true, true};
    const tinygltf::Model model = parsed(written(film));
    for (const auto& target : model.meshes.at(0).primitives.at(0).targets) {
        for (const char* name : {"POSITION", "NORMAL"}) {
            for (const float number : numbersOf<float>(model, target.at(name))) {
                // The difference between the base's doubles and floats.
                EXPECT_LT(std::abs(number), 1e-7F);
            }
        }
    }
}

TEST(Animation, FramesWithoutASurfaceShowNothing)
{
    const Film film = filmOf({3, 2});
    // Two dry frames, a run of three, one dry, a run of two, two dry: ten frames.
    const std::vector<int> order{-1, -1, 0, 1, 2, -1, 3, 4, -1, -1};
    Animation animation({.frames_per_second = 10.0, .frames = order.size()});
    for (const int k : order) {
        if (k < 0) {
            animation.addDry();
        } else {
            animation.add(film.frames[at(k)], film.continues[at(k)]);
        }
    }
    std::ostringstream out;
    animation.write(out);
    tinygltf::Model model = parsed(out.str());
    for (std::size_t frame = 0; frame < order.size(); ++frame) {
        const auto time = static_cast<double>(static_cast<float>(static_cast<double>(frame) / 10.0));
        if (order[frame] < 0) {
            EXPECT_EQ(playedAt(model, time).nodes, 0U) << frame;
            EXPECT_EQ(playedAt(model, time + 0.09).nodes, 0U) << frame;
        } else {
            expectShows(model, time, film.frames[at(order[frame])]);
        }
    }
    // The last frame before a pause stands still until then; the animation is as long as its frames.
    expectShows(model, 0.499, film.frames[2]);
    EXPECT_EQ(playedAt(model, 1.0).nodes, 0U);
    float end = 0.0F;
    for (const tinygltf::AnimationSampler& sampler : model.animations.at(0).samplers) {
        end = std::max(end, numbersOf<float>(model, sampler.input).back());
    }
    EXPECT_FLOAT_EQ(end, 1.0F);
    model.animations.clear();
    expectShows(model, 0.0, film.frames[0]);

    Animation again({.frames_per_second = 10.0});
    again.add(film.frames[0], false);
    again.addDry();
    EXPECT_THROW(again.add(film.frames[1], true), Error) << "nothing goes on after a pause";
}

TEST(Animation, NamesMeshesAfterFrames)
{
    const tinygltf::Model model = parsed(written(filmOf({2, 3})));
    EXPECT_EQ(model.animations.at(0).name, "sequence");
    ASSERT_EQ(model.nodes.size(), 2U);
    EXPECT_EQ(model.nodes[1].name, "frame 3");
    const tinygltf::Value& names = model.meshes[1].extras.Get("targetNames");
    ASSERT_EQ(names.ArrayLen(), 2U);
    EXPECT_EQ(names.Get(0).Get<std::string>(), "frame 4");
    EXPECT_EQ(names.Get(1).Get<std::string>(), "frame 5");
}

/// Value of an attribute of a USD file at a time code at which it has a sample, or holds one.
std::string valueAt(const testing::UsdProperty& property, double code)
{
    if (property.samples.empty()) {
        return property.value;
    }
    const auto next = property.samples.upper_bound(code);
    return next == property.samples.begin() ? next->second : std::prev(next)->second;
}

// The same frames as in glTF, as samples of scale, points and normals. Steps are held to a thousandth of a frame.
TEST(Animation, HasTimeSamplesInUsd)
{
    const Film film = filmOf({3, 1, 4, 1});
    const std::string usda = written(film, {.frames_per_second = 10.0}, {Format::Usda});
    const testing::UsdPrim root = testing::UsdaReader(usda).read();
    EXPECT_EQ(root.metadata.at("startTimeCode"), "0");
    EXPECT_EQ(root.metadata.at("endTimeCode"), "9");
    EXPECT_EQ(root.metadata.at("timeCodesPerSecond"), "10");
    const testing::UsdPrim& droplet = root.child("droplet");
    std::vector<std::string> meshes;
    for (std::size_t frame = 0; frame < film.frames.size(); ++frame) {
        for (const double code : {static_cast<double>(frame), static_cast<double>(frame) + 0.998}) {
            std::size_t shown = 0;
            for (const auto& [name, prim] : droplet.children) {
                if (prim.type != "Mesh" ||
                    testing::numbersIn(valueAt(prim.properties.at("xformOp:scale"), code))[0] == 0.0) {
                    continue;
                }
                ++shown;
                EXPECT_EQ(prim.value("xformOpOrder"), "[xformOp:scale]");
                if (code > static_cast<double>(frame)) {
                    continue;
                }
                meshes.push_back(name);
                const Surface& surface = film.frames[frame];
                const std::vector<double> points = testing::numbersIn(valueAt(prim.properties.at("points"), code));
                const std::vector<double> normals =
                    testing::numbersIn(valueAt(prim.properties.at("primvars:normals"), code));
                const std::vector<double> corners = testing::numbersIn(prim.value("faceVertexIndices"));
                ASSERT_EQ(corners.size(), 3 * surface.triangles.size());
                ASSERT_EQ(normals.size(), 3 * surface.normals.size());
                for (std::size_t c = 0; c < corners.size(); ++c) {
                    const std::uint32_t v = surface.triangles[c / 3][c % 3];
                    const auto p = 3 * static_cast<std::size_t>(corners[c]);
                    const Vec3 place{points.at(p), -points.at(p + 2), points.at(p + 1)};
                    EXPECT_LT(length(place - surface.vertices[v]), 1e-9);
                    const Vec3 normal{normals[3 * v], -normals[3 * v + 2], normals[3 * v + 1]};
                    EXPECT_LT(length(normal - surface.normals[v]), 1e-6);
                }
            }
            EXPECT_EQ(shown, 1U) << code;
        }
    }
    EXPECT_THAT(meshes, ::testing::ElementsAre("frame_1", "frame_1", "frame_1", "frame_4", "frame_5", "frame_5",
                                               "frame_5", "frame_5", "frame_9"));
    EXPECT_EQ(droplet.child("frame_1").properties.at("primvars:normals").metadata.at("interpolation"), "faceVarying");
    EXPECT_EQ(written(film, {.frames_per_second = 10.0}, {Format::Usdz}).find("PK"), 0U);
    const std::string still = written(filmOf({1}), {}, {Format::Usda});
    EXPECT_EQ(still.find("timeCode"), std::string::npos) << "one frame has no time";
}

// Renderers blur motion by velocities: a point's place and velocity give its place at the next sample.
TEST(Animation, MovesByItsVelocitiesInUsd)
{
    constexpr double kFrames = 10.0;
    const std::string usda = written(filmOf({3, 1, 4, 1}), {.frames_per_second = kFrames}, {Format::Usda});
    const testing::UsdPrim root = testing::UsdaReader(usda).read();
    const testing::UsdPrim& droplet = root.child("droplet");
    for (const auto& [name, run] : {std::pair{"frame_1", 3U}, {"frame_5", 4U}}) {
        const auto& properties = droplet.child(name).properties;
        const auto& points = properties.at("points").samples;
        const auto& velocities = properties.at("velocities").samples;
        ASSERT_EQ(velocities.size(), points.size()) << name;
        ASSERT_EQ(points.size(), run) << name;
        double fastest = 0.0;
        for (auto now = points.begin(), next = std::next(now); next != points.end(); ++now, ++next) {
            const std::vector<double> from = testing::numbersIn(now->second);
            const std::vector<double> to = testing::numbersIn(next->second);
            const std::vector<double> velocity = testing::numbersIn(velocities.at(now->first));
            ASSERT_EQ(velocity.size(), from.size());
            for (std::size_t i = 0; i < from.size(); ++i) {
                EXPECT_NEAR(from[i] + velocity[i] * (next->first - now->first) / kFrames, to[i], 1e-9);
                fastest = std::max(fastest, std::abs(velocity[i]));
            }
        }
        EXPECT_GT(fastest, 0.0) << name;
        EXPECT_EQ(velocities.rbegin()->second, std::next(velocities.rbegin())->second)
            << "it goes on until it is replaced";
    }
    EXPECT_FALSE(droplet.child("frame_4").properties.contains("velocities"));
}

// Nodes that appear and go keep their tracks; a child places the compressed vertices.
TEST(Animation, IsCompressed)
{
    Film film;
    for (int k = 0; k < 8; ++k) {
        film.frames.push_back(roundDroplet({.height = 1e-3 + 1e-4 * k, .rings = 20, .segments = 60}));
        film.continues.push_back(k % 4 > 0);
    }
    const auto plain = static_cast<double>(written(film).size());
    for (const Compression compression : {Compression::Quantize, Compression::Meshopt}) {
        const std::string glb = written(film, {}, {Format::Glb, compression});
        EXPECT_LT(static_cast<double>(glb.size()), (compression == Compression::Quantize ? 0.8 : 0.4) * plain);
        EXPECT_EQ(glb, written(film, {}, {Format::Glb, compression}));
    }
    const tinygltf::Model model = parsed(written(film, {}, {Format::Glb, Compression::Quantize}));
    for (const tinygltf::AnimationChannel& channel : model.animations.at(0).channels) {
        const tinygltf::Node& node = model.nodes.at(at(channel.target_node));
        EXPECT_EQ(node.mesh >= 0, channel.target_path == "weights");
        if (channel.target_path == "scale") {
            ASSERT_EQ(node.children.size(), 1U);
            EXPECT_GE(model.nodes.at(at(node.children[0])).mesh, 0);
        }
    }
}

TEST(Animation, RefusesFormsThatDoNotExist)
{
    for (const AnimatedFile& file : {AnimatedFile{Format::Obj}, AnimatedFile{Format::Gltf, Compression::Quantize},
                                     AnimatedFile{Format::Usdz, Compression::Meshopt}}) {
        Animation animation(AnimationOptions{});
        animation.add(roundDroplet(), false);
        std::ostringstream out;
        EXPECT_THROW(animation.write(out, file), Error);
        EXPECT_EQ(out.str(), "");
    }
}

std::string refusal(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
        return error.what();
    }
    return {};
}

TEST(Animation, RefusesInvalidFrames)
{
    EXPECT_THAT(refusal([] { Animation(AnimationOptions{.frames_per_second = 0.0, .frames = {}}); }),
                HasSubstr("frames_per_second"));
    EXPECT_THAT(refusal([] { Animation(AnimationOptions{.frames = 0}); }), HasSubstr("frames is 0"));
    EXPECT_THAT(refusal([] {
                    std::ostringstream out;
                    Animation(AnimationOptions{}).write(out);
                }),
                HasSubstr("at least one frame"));
    EXPECT_THAT(refusal([] {
                    Animation animation(AnimationOptions{});
                    animation.add(roundDroplet(), true);
                }),
                HasSubstr("frame 1 must have the same triangles"));
    EXPECT_THAT(refusal([] {
                    Animation animation(AnimationOptions{});
                    animation.add(roundDroplet(), false);
                    animation.add(roundDroplet({.segments = 13}), true);
                }),
                HasSubstr("frame 2 must have the same triangles"));
}

TEST(Animation, RefusesATooLargeFileAtItsFirstFrame)
{
    const Surface surface = roundDroplet({.rings = 60, .segments = 60});
    EXPECT_THAT(refusal([&] { Animation({.frames = 100'000}).add(surface, false); }), HasSubstr("2 GiB"));
    EXPECT_EQ(refusal([&] { Animation({.frames = 1'000}).add(surface, false); }), "");
}

}  // namespace
}  // namespace droplet
