// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/wind_io/windshield_animation.h"
#include "droplet/windshield/presets.h"
#include "support/animated_scene.h"
#include "support/command.h"
#include "support/paths.h"
#include "support/usda.h"

namespace droplet {
namespace {

using nlohmann::json;
using testing::AnimatedScene;
using ::testing::HasSubstr;
using testing::Shown;
using ::testing::ThrowsMessage;

RunningDroplet droplet(std::uint64_t id, Vec2 position, Vec2 velocity = {}, double volume = 20e-9)
{
    RunningDroplet one;
    one.id = id;
    one.position = position;
    one.velocity = velocity;
    one.volume = volume;
    return one;
}

/// Five frames: droplet 1 rests, then climbs; droplet 2 appears in the third and is gone in the last.
std::string fiveFrames(const Glass& glass, const WindshieldAnimationOptions& options = {})
{
    WindshieldAnimation scene(glass, options);
    WindshieldState state;
    state.droplets = {droplet(1, {0.5, 0.2})};
    scene.add(state);
    scene.add(state);
    state.droplets = {droplet(1, {0.5, 0.21}, {0.1, 0.6}), droplet(2, {0.9, 0.3}, {-0.2, 0.0}, 5e-9)};
    scene.add(state);
    state.droplets = {droplet(1, {0.5, 0.23}, {0.1, 0.9}), droplet(2, {0.88, 0.3}, {-0.3, 0.1}, 6e-9)};
    scene.add(state);
    state.droplets = {droplet(1, {0.5, 0.25})};
    scene.add(state);
    std::ostringstream out;
    const std::uint64_t bytes = scene.write(out);
    EXPECT_EQ(bytes, out.str().size());
    return out.str();
}

/// Vector in the file's frame: +Y up, +Z ahead.
Vec3 inFile(Vec3 v)
{
    return {-v.x, v.z, v.y};
}

/// Heavy rain on a small curved glass; droplets rest, run, merge and leave.
struct Rain {
    Glass glass{Glass::Cylinder{.width = 0.4, .height = 0.2, .radius = 1.0}};
    std::vector<WindshieldState> states;
    std::set<std::uint64_t> ids;
    std::size_t max = 0;

    Rain()
    {
        WindshieldParameters p = windshieldPresetNamed("figure-3.11").parameters;
        p.glass = glass;
        p.rainfall = 25.0 * kMillimetrePerHour;
        WindshieldState state = startWindshield(p);
        for (int frame = 0; frame < 110; ++frame) {
            state = step(std::move(state), p, 1.0 / 30.0);
            if (frame >= 50) {
                states.emplace_back().droplets = state.droplets;
                max = std::max(max, state.droplets.size());
                for (const RunningDroplet& d : state.droplets) {
                    ids.insert(d.id);
                }
            }
        }
    }

    [[nodiscard]] std::string scene(AnimationMethod animation, const AnimatedFile& file = {}) const
    {
        WindshieldAnimation scene(glass, {.animation = animation});
        for (const WindshieldState& state : states) {
            scene.add(state);
        }
        std::ostringstream out;
        scene.write(out, file);
        return out.str();
    }
};

const Rain& theRain()
{
    static const Rain rain;
    return rain;
}

/// Checks that every droplet of a state is shown once, and nothing else.
void expectShown(const std::vector<Shown>& shown, const WindshieldState& state, const Glass& glass, double place_slack)
{
    ASSERT_EQ(shown.size(), state.droplets.size());
    double volume = 0.0;
    double shown_volume = 0.0;
    std::set<std::size_t> slots;
    for (const RunningDroplet& d : state.droplets) {
        const GlassPlace place = *glass.place(d.position);
        const double radius = runningShape(d.volume, 0.0).contact_radius;
        const Shown& one = *std::min_element(shown.begin(), shown.end(), [&](const Shown& a, const Shown& b) {
            return length(a.place - inFile(place.point)) < length(b.place - inFile(place.point));
        });
        slots.insert(one.slot);
        const double its = std::cbrt(one.scale.x * one.scale.y * one.scale.z);
        EXPECT_NEAR(its / radius, 1.0, 0.015) << d.id;
        EXPECT_LE(length(one.place - inFile(place.point)),
                  place_slack * (0.25 * radius / 0.8 + 5e-3 * length(d.velocity)) + 5e-5)
            << d.id;
        EXPECT_GT(dot(one.y, inFile(place.normal)), std::cos(1.8 * kDegree)) << d.id;
        volume += radius * radius * radius;
        shown_volume += its * its * its;
    }
    EXPECT_EQ(slots.size(), state.droplets.size());
    EXPECT_NEAR(shown_volume / volume, 1.0, 0.01);
}

TEST(WindshieldAnimation, ShowsTheDropletsOfEveryFrame)
{
    const Rain& rain = theRain();
    const AnimatedScene scene(rain.scene(AnimationMethod::Nodes));
    for (std::size_t frame = 0; frame < rain.states.size(); frame += 7) {
        SCOPED_TRACE(frame);
        expectShown(scene.at((static_cast<double>(frame) + 1e-3) / 30.0), rain.states[frame], rain.glass, 1.0);
    }
    // Droplets reuse joints, and one draw call shows many.
    EXPECT_GT(rain.ids.size(), rain.max + rain.max / 4);
    EXPECT_LE(scene.pool(), rain.max + rain.max / 2);
    EXPECT_LE(scene.model().at("skins").size(), scene.pool() / 62 + 2);
    for (const json& skin : scene.model().at("skins")) {
        EXPECT_TRUE(skin.contains("inverseBindMatrices")) << "assimp 5.2 ends where there are none";
    }
    for (const json& view : scene.model().at("bufferViews")) {
        EXPECT_EQ(view.at("buffer"), 0) << "tracks are binary, in the one buffer";
    }
}

TEST(WindshieldAnimation, TextureHasTheDropletsOfEveryFrame)
{
    const Rain& rain = theRain();
    const AnimatedScene scene(rain.scene(AnimationMethod::Texture));
    testing::ScratchDirectory scratch;
    testing::writeFile(scratch.path() / "droplets.png", scene.png());
    const Picture picture = readPicture(scratch.path() / "droplets.png");
    const json& about = scene.model().at("nodes").at(1).at("extras");
    const std::size_t columns = about.at("columns");
    const std::size_t frames = about.at("frames");
    const std::size_t slots = about.at("slots");
    ASSERT_EQ(frames, rain.states.size());
    EXPECT_EQ(about.at("frames_per_second"), 30.0);
    ASSERT_EQ(static_cast<std::size_t>(picture.width), 4 * columns);
    ASSERT_EQ(static_cast<std::size_t>(picture.height), frames * ((slots + columns - 1) / columns));
    EXPECT_LE(slots, rain.max + rain.max / 10);
    const auto low = about.at("low_m").get<std::vector<double>>();
    const auto high = about.at("high_m").get<std::vector<double>>();
    const double smallest = about.at("smallest_m");
    const double largest = about.at("largest_m");
    for (std::size_t frame = 0; frame < frames; frame += 7) {
        SCOPED_TRACE(frame);
        std::vector<Shown> shown;
        for (std::size_t slot = 0; slot < slots; ++slot) {
            const std::size_t row = frame + frames * (slot / columns);
            const std::uint8_t* const bytes = &picture.rgb[3 * (row * 4 * columns + 4 * (slot % columns))];
            if (bytes[10] == 0) {
                continue;
            }
            const auto place = [&](std::size_t i) {
                return low[i] + (high[i] - low[i]) * (256 * bytes[2 * i] + bytes[2 * i + 1]) / 65535.0;
            };
            const auto axis = [&](std::size_t i) { return bytes[6 + i] / 127.5 - 1.0; };
            const auto size = [&](std::size_t i) {
                return smallest * std::pow(largest / smallest, (bytes[i] - 1) / 254.0);
            };
            Vec3 u{axis(0), axis(1), axis(2)};
            const double norm = std::sqrt(dot(u, u) + axis(3) * axis(3));
            u = (1.0 / norm) * u;
            const Vec3 t = 2.0 * cross(u, {0, 1, 0});
            shown.push_back({{place(0), place(1), place(2)},
                             {},
                             Vec3{0, 1, 0} + axis(3) / norm * t + cross(u, t),
                             {size(10), size(11), size(11)},
                             slot,
                             {}});
        }
        expectShown(shown, rain.states[frame], rain.glass, 0.0);
    }
}

/// Numbers of an attribute at a time code, between its samples as USD shows them.
std::vector<double> numbersAt(const testing::UsdPrim& prim, const std::string& name, double code,
                              std::vector<double> otherwise)
{
    const auto found = prim.properties.find(name);
    if (found == prim.properties.end()) {
        return otherwise;
    }
    const auto numbersOf = [](std::string text) {
        std::replace_if(
            text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
        std::istringstream in(text);
        return std::vector<double>(std::istream_iterator<double>(in), {});
    };
    const std::map<double, std::string>& samples = found->second.samples;
    if (samples.empty()) {
        return numbersOf(found->second.value);
    }
    const auto next = samples.upper_bound(code);
    if (next == samples.begin() || next == samples.end()) {
        return numbersOf(next == samples.begin() ? next->second : samples.rbegin()->second);
    }
    std::vector<double> numbers = numbersOf(std::prev(next)->second);
    const std::vector<double> after = numbersOf(next->second);
    const double share = (code - std::prev(next)->first) / (next->first - std::prev(next)->first);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        numbers[k] += share * (after[k] - numbers[k]);
    }
    return numbers;
}

// Every droplet is an instance of one of two classes, in the place and size of its joint in glTF.
TEST(WindshieldAnimation, UsdShowsTheSameDroplets)
{
    const Rain& rain = theRain();
    const AnimatedScene scene(rain.scene(AnimationMethod::Nodes));
    const testing::UsdPrim root =
        testing::UsdaReader(rain.scene(AnimationMethod::Nodes, {Format::Usda})).read().child("droplet");
    EXPECT_TRUE(root.child("droplets_at_rest").is_class);
    EXPECT_TRUE(root.child("droplets_on_their_way").is_class);
    EXPECT_EQ(root.child("glass").type, "Mesh");
    for (std::size_t frame = 0; frame < rain.states.size(); frame += 13) {
        SCOPED_TRACE(frame);
        const double code = static_cast<double>(frame) + 0.03;
        std::vector<Vec3> places;
        double volume = 0.0;
        const auto take = [&](const testing::UsdPrim& prim, const std::vector<double>& q) {
            EXPECT_EQ(prim.metadata.at("instanceable"), "true");
            const std::string& of = prim.metadata.at("prepend references");
            EXPECT_TRUE(of == "/droplet/droplets_at_rest" || of == "/droplet/droplets_on_their_way") << of;
            const std::vector<double> size = numbersAt(prim, "xformOp:scale", code, {1, 1, 1});
            if (size[0] == 0.0) {
                return;
            }
            const std::vector<double> p = numbersAt(prim, "xformOp:translate", code, {0, 0, 0});
            const Vec3 v{p[0], p[1], p[2]};
            const Vec3 u{q[1], q[2], q[3]};
            const Vec3 t = 2.0 * cross(u, v);
            places.push_back(v + q[0] * t + cross(u, t));
            volume += size[0] * size[1] * size[2];
        };
        const std::vector<double> no_turn{1, 0, 0, 0};
        for (const auto& [name, prim] : root.child("droplets").children) {
            if (!prim.metadata.contains("instanceable")) {
                for (const auto& [copy_name, copy] : prim.children) {
                    take(copy, numbersAt(prim, "xformOp:orient", code, no_turn));
                }
            } else {
                take(prim, no_turn);
            }
        }
        const std::vector<Shown> shown = scene.at(code / 30.0);
        ASSERT_EQ(places.size(), shown.size());
        for (const Shown& one : shown) {
            volume -= one.scale.x * one.scale.y * one.scale.z;
            EXPECT_TRUE(std::any_of(places.begin(), places.end(),
                                    [&](const Vec3& place) { return length(place - one.place) < 1e-6; }));
        }
        EXPECT_NEAR(volume, 0.0, 1e-12);
    }
    EXPECT_THROW((void)rain.scene(AnimationMethod::Texture, {Format::Usda}), Error);
}

TEST(WindshieldAnimation, DropletsAreVisibleOnlyWhileTheyExist)
{
    const Glass glass;
    const AnimatedScene scene(fiveFrames(glass, {.frames_per_second = 10.0}));
    for (const auto& [time, count] : {std::pair(0.0, 1U), {0.199, 1U}, {0.201, 2U}, {0.399, 2U}, {0.401, 1U}}) {
        EXPECT_EQ(scene.at(time).size(), count) << time;
    }
    // The first droplet rests for a frame and then starts from its place.
    EXPECT_LT(length(scene.at(0.0)[0].place - inFile(glass.place({0.5, 0.2})->point)), 1e-4);
    EXPECT_LT(length(scene.at(0.1)[0].place - scene.at(0.0)[0].place), 1e-3);
    EXPECT_LT(length(scene.at(0.4)[0].place - inFile(glass.place({0.5, 0.25})->point)), 1e-6);
}

TEST(WindshieldAnimation, KeepsVolumesAndFacesTheMotion)
{
    const Glass glass;
    const AnimatedScene scene(fiveFrames(glass));
    const double rest = runningShape(20e-9, 0.0, ShapeOptions()).contact_radius;
    for (const double time : {0.0, 0.07, 0.11}) {
        const Vec3 scale = scene.at(time)[0].scale;
        EXPECT_NEAR(scale.x * scale.y * scale.z / (rest * rest * rest), 1.0, 1e-3) << time;
        EXPECT_GE(scale.x, scale.y);
    }
    const Shown running = scene.at(0.11)[0];
    EXPECT_GT(running.scale.x, 1.2 * rest);
    const auto place = glass.place({0.5, 0.23});
    const double speed = std::hypot(0.1, 0.9);
    const Vec3 along = (0.1 / speed) * place->across + (0.9 / speed) * place->up;
    EXPECT_GT(dot(running.x, inFile(along)), std::cos(10.0 * kDegree));
    EXPECT_NEAR(dot(running.y, inFile(place->normal)), 1.0, 1e-5);
}

TEST(WindshieldAnimation, PassesTheValidator)
{
    testing::ScratchDirectory scratch;
    std::vector<std::string> command{"node", testing::kValidator};
    const auto store = [&](const char* name, const std::string& bytes) {
        const std::string path = (scratch.path() / name).string();
        std::ofstream(path, std::ios::binary) << bytes;
        command.push_back(path);
    };
    store("five.glb", fiveFrames(Glass()));
    store("texture.glb", fiveFrames(Glass(), {.animation = AnimationMethod::Texture}));
    store("quantized.glb", theRain().scene(AnimationMethod::Nodes, {Format::Glb, Compression::Quantize}));
    store("meshopt.glb", theRain().scene(AnimationMethod::Nodes, {Format::Glb, Compression::Meshopt}));
    store("ink.glb", fiveFrames(Glass(), {.material = Material::Ink, .shape = {.contact_angle = 0.5}}));
    WindshieldAnimation one{Glass()};
    WindshieldState state;
    state.droplets = {droplet(7, {0.3, 0.3})};
    one.add(state);
    std::ostringstream out;
    one.write(out);
    store("one_frame.glb", out.str());
    WindshieldAnimation none{Glass()};
    none.add(WindshieldState());
    none.add(WindshieldState());
    std::ostringstream dry;
    none.write(dry);
    store("dry.glb", dry.str());
    WindshieldAnimation nothing(Glass(), {.animation = AnimationMethod::Texture});
    nothing.add(WindshieldState());
    std::ostringstream empty;
    nothing.write(empty);
    store("empty.glb", empty.str());
    const auto verdict = testing::runProgram(command);
    EXPECT_EQ(verdict.exit_code, 0) << verdict.output << verdict.error;
    for (const char* name : {"five", "texture", "quantized", "meshopt", "ink", "one_frame", "dry", "empty"}) {
        EXPECT_THAT(verdict.output + verdict.error, HasSubstr(std::string(name) + ".glb: 0 errors, 0 warnings"));
    }
}

TEST(WindshieldAnimation, RejectsTexturesTooLargeForViewers)
{
    WindshieldAnimation scene(Glass(), {.animation = AnimationMethod::Texture});
    WindshieldState state;
    for (std::uint64_t id = 1; id <= 2049; ++id) {
        state.droplets.push_back(droplet(id, {0.0005 * static_cast<double>(id), 0.3}));
    }
    scene.add(state);
    for (int frame = 1; frame < 4096; ++frame) {
        scene.add(WindshieldState());
    }
    EXPECT_THAT([&] { scene.add(WindshieldState()); }, ThrowsMessage<Error>(HasSubstr("a texture of 8194 rows")));
}

TEST(WindshieldAnimation, RejectsScenesWithoutFrames)
{
    EXPECT_THROW(WindshieldAnimation(Glass(), {.frames_per_second = 0.0}), Error);
    std::ostringstream out;
    EXPECT_THROW(WindshieldAnimation{Glass()}.write(out), Error);
}

}  // namespace
}  // namespace droplet
