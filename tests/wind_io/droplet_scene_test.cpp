// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind_io/droplet_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

RunningDroplet droplet(std::uint64_t id, Vec2 position, Vec2 velocity = {}, double volume = 20e-9)
{
    RunningDroplet one;
    one.id = id;
    one.position = position;
    one.velocity = velocity;
    one.volume = volume;
    return one;
}

/// Five frames: 1 rests, then climbs; 2 is born in the third and gone in the last.
std::string fiveFrames(const Glass& glass, const DropletSceneOptions& options = {})
{
    DropletScene scene(glass, options);
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

class Scene {
public:
    explicit Scene(const std::string& glb)
    {
        std::uint32_t length = 0;
        std::memcpy(&length, glb.data() + 12, 4);
        json_ = json::parse(glb.substr(20, length));
        buffer_ = glb.substr(28 + length);
    }

    [[nodiscard]] const json& model() const { return json_; }

    [[nodiscard]] std::vector<std::vector<float>> array(std::size_t accessor) const
    {
        const json& one = json_.at("accessors").at(accessor);
        const std::string type = one.at("type");
        const std::size_t width = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
        const std::size_t offset =
            json_.at("bufferViews").at(one.at("bufferView").get<std::size_t>()).value("byteOffset", std::size_t{0});
        std::vector<std::vector<float>> rows(one.at("count").get<std::size_t>(), std::vector<float>(width));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            std::memcpy(rows[i].data(), buffer_.data() + offset + 4 * width * i, 4 * width);
        }
        return rows;
    }

    /// Times and values of what is animated of a node.
    [[nodiscard]] std::pair<std::vector<std::vector<float>>, std::vector<std::vector<float>>> track(
        const std::string& node, const std::string& path, const std::string& interpolation) const
    {
        const json& animation = json_.at("animations").at(0);
        for (const json& channel : animation.at("channels")) {
            if (channel.at("target").at("path") == path &&
                json_.at("nodes").at(channel.at("target").at("node").get<std::size_t>()).at("name") == node) {
                const json& sampler = animation.at("samplers").at(channel.at("sampler").get<std::size_t>());
                EXPECT_EQ(sampler.at("interpolation"), interpolation);
                return {array(sampler.at("input")), array(sampler.at("output"))};
            }
        }
        ADD_FAILURE() << node << " has no " << path;
        return {};
    }

private:
    json json_;
    std::string buffer_;
};

TEST(DropletScene, HasANodeForEveryDropletAndOneMesh)
{
    const Scene scene(fiveFrames(Glass()));
    const json& model = scene.model();
    ASSERT_EQ(model.at("nodes").size(), 3U);
    EXPECT_EQ(model.at("nodes")[0].at("name"), "glass");
    EXPECT_EQ(model.at("nodes")[1].at("name"), "droplet 1");
    EXPECT_EQ(model.at("nodes")[2].at("name"), "droplet 2");
    EXPECT_EQ(model.at("nodes")[1].at("mesh"), model.at("nodes")[2].at("mesh"));
    EXPECT_EQ(model.at("meshes").size(), 2U);
}

TEST(DropletScene, DropletsAreThereWhileTheyLive)
{
    const Glass glass;
    const Scene scene(fiveFrames(glass, {.frames_per_second = 10.0}));
    const auto [times, scales] = scene.track("droplet 2", "scale", "STEP");
    ASSERT_EQ(times.size(), 4U);
    EXPECT_FLOAT_EQ(times[0][0], 0.0F);
    EXPECT_FLOAT_EQ(times[1][0], 0.2F);
    EXPECT_FLOAT_EQ(times[3][0], 0.4F);
    EXPECT_EQ(scales[0], (std::vector<float>{0, 0, 0}));
    EXPECT_GT(scales[1][0], 0.0F);
    EXPECT_EQ(scales[3], (std::vector<float>{0, 0, 0}));
    // The first rests for a frame, begins to move from where it was, and is not keyed in between.
    const auto [moves, places] = scene.track("droplet 1", "translation", "LINEAR");
    ASSERT_EQ(moves.size(), 5U);
    EXPECT_FLOAT_EQ(moves[1][0], 0.1F);
    EXPECT_EQ(places[0], places[1]);
    const Vec3 last = glass.place({0.5, 0.25})->point;
    EXPECT_NEAR(places.back()[0], -last.x, 1e-6);
    EXPECT_NEAR(places.back()[1], last.z, 1e-6) << "+Y is up";
    EXPECT_NEAR(places.back()[2], last.y, 1e-6) << "+Z is ahead";
}

TEST(DropletScene, KeepsVolumesAndPointsAlongTheWay)
{
    const Glass glass;
    const Scene scene(fiveFrames(glass));
    const auto [times, scales] = scene.track("droplet 1", "scale", "STEP");
    const double rest = runningShape(20e-9, 0.0, ShapeOptions()).contact_radius;
    for (const std::vector<float>& scale : scales) {
        EXPECT_NEAR(scale[0] * scale[1] * scale[2] / (rest * rest * rest), 1.0, 1e-5);
        EXPECT_GE(scale[0], scale[1]);
    }
    EXPECT_GT(scales[3][0], 1.2F * scales[0][0]);
    const auto [more_times, turns] = scene.track("droplet 1", "rotation", "LINEAR");
    const auto turned = [](const std::vector<float>& q, Vec3 v) {
        const Vec3 u{static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2])};
        const Vec3 t = 2.0 * cross(u, v);
        return v + static_cast<double>(q[3]) * t + cross(u, t);
    };
    const auto place = glass.place({0.5, 0.23});
    const double speed = std::hypot(0.1, 0.9);
    const Vec3 along = (0.1 / speed) * place->across + (0.9 / speed) * place->up;
    const Vec3 x = turned(turns[3], {1, 0, 0});
    const Vec3 y = turned(turns[3], {0, 1, 0});
    EXPECT_NEAR(dot(x, Vec3{-along.x, along.z, along.y}), 1.0, 1e-5);
    EXPECT_NEAR(dot(y, Vec3{-place->normal.x, place->normal.z, place->normal.y}), 1.0, 1e-5);
}

TEST(DropletScene, PassesTheValidator)
{
    testing::ScratchDirectory scratch;
    std::vector<std::string> command{"node", testing::kValidator};
    const auto store = [&](const char* name, const std::string& bytes) {
        const std::string path = (scratch.path() / name).string();
        std::ofstream(path, std::ios::binary) << bytes;
        command.push_back(path);
    };
    store("five.glb", fiveFrames(Glass()));
    store("ink.glb", fiveFrames(Glass(), {.material = Material::Ink, .shape = {.contact_angle = 0.5}}));
    DropletScene one{Glass()};
    WindshieldState state;
    state.droplets = {droplet(7, {0.3, 0.3})};
    one.add(state);
    std::ostringstream out;
    one.write(out);
    store("one_frame.glb", out.str());
    DropletScene none{Glass()};
    none.add(WindshieldState());
    none.add(WindshieldState());
    std::ostringstream dry;
    none.write(dry);
    store("dry.glb", dry.str());
    const auto verdict = testing::runProgram(command);
    EXPECT_EQ(verdict.exit_code, 0) << verdict.output << verdict.error;
    for (const char* name : {"five", "ink", "one_frame", "dry"}) {
        EXPECT_THAT(verdict.output + verdict.error, HasSubstr(std::string(name) + ".glb: 0 errors, 0 warnings"));
    }
}

TEST(DropletScene, RefusesNothingToShow)
{
    EXPECT_THROW(DropletScene(Glass(), {.frames_per_second = 0.0}), Error);
    std::ostringstream out;
    EXPECT_THROW(DropletScene{Glass()}.write(out), Error);
}

}  // namespace
}  // namespace droplet
