// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d_io/read_scene.h"

#include <gmock/gmock.h>

#include <numbers>

#include "droplet/error.h"
#include "droplet/liquid2d/fluid.h"
#include "liquid2d/region.h"
#include "support/paths.h"

namespace {

using droplet::Error;
using droplet::FluidScene;
using droplet::parseFluidScene;
using droplet::Vec2;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

TEST(ReadScene, TakesEveryKey)
{
    const FluidScene scene = parseFluidScene(R"(
size = ["2m", "150cm"]
spacing = "10mm"
gravity = ["0m/s2", "-1g"]
density = "1g/cm3"
surface_tension = "72mN/m"
viscosity = "2Pa.s"
margin = "20cm"
max_particles = 5000
[[liquid]]
box = [["0m", "0m"], ["1m", "0.5m"]]
velocity = ["1m/s", "-2m/s"]
spin = "180deg/s"
[[liquid]]
circle = { at = ["1m", "1m"], radius = "0.2m" }
[[wall]]
polygon = [["0m", "-1m"], ["2m", "-1m"], ["1m", "-0.1m"]]
visible = false
motion = { amplitude = ["0.1m", "0m"], swing = "90deg", pivot = ["1m", "2m"], period = "2s", phase = "180deg", begin = "500ms" }
[[emitter]]
position = ["1m", "1.4m"]
velocity = ["0m/s", "-2m/s"]
width = "10cm"
begin = "1s"
end = "2s"
)",
                                             "a.toml");
    EXPECT_EQ(scene.size, (Vec2{2.0, 1.5}));
    EXPECT_EQ(scene.spacing, 0.01);
    EXPECT_EQ(scene.gravity, (Vec2{0.0, -9.81}));
    EXPECT_EQ(scene.density, 1000.0);
    EXPECT_EQ(scene.surface_tension, 0.072);
    EXPECT_EQ(scene.viscosity, 0.002);
    EXPECT_EQ(scene.margin, 0.2);
    EXPECT_EQ(scene.max_particles, 5000U);
    ASSERT_EQ(scene.liquid.size(), 2U);
    EXPECT_EQ(scene.liquid[0].velocity, (Vec2{1.0, -2.0}));
    EXPECT_NEAR(scene.liquid[0].spin, std::numbers::pi, 1e-12);
    EXPECT_NEAR(droplet::momentsOf(scene.liquid[0].region).area, 0.5, 1e-12);
    EXPECT_NEAR(droplet::momentsOf(scene.liquid[1].region).area, std::numbers::pi * 0.04, 1e-9);
    ASSERT_EQ(scene.walls.size(), 1U);
    EXPECT_FALSE(scene.walls[0].visible);
    EXPECT_NEAR(scene.walls[0].motion->swing, std::numbers::pi / 2.0, 1e-12);
    EXPECT_EQ(scene.walls[0].motion->pivot, (Vec2{1.0, 2.0}));
    EXPECT_EQ(scene.walls[0].motion->begin, 0.5);
    ASSERT_EQ(scene.emitters.size(), 1U);
    EXPECT_EQ(scene.emitters[0].width, 0.1);
    EXPECT_EQ(scene.emitters[0].end, 2.0);
}

TEST(ReadScene, ScalesMasksToTheirWidth)
{
    const auto folder = std::filesystem::path(droplet::testing::kSourceDir) / "data";
    const auto area = [&](const char* width) {
        const FluidScene scene = parseFluidScene(
            std::string("[[liquid]]\nmask = \"cluster.png\"\nat = [\"1m\", \"1m\"]\nwidth = \"") + width + "\"\n",
            folder / "scene.toml");
        return droplet::momentsOf(scene.liquid[0].region).area;
    };
    const double one = area("1m");
    EXPECT_GT(one, 0.01);
    EXPECT_NEAR(area("2m"), 4.0 * one, 1e-6);
}

TEST(ReadScene, ErrorsNameFileLineAndFault)
{
    const auto refused = [](const std::string& text, const std::string& begin, const std::string& what) {
        EXPECT_THAT([&] { parseFluidScene(text, "a.toml"); },
                    ThrowsMessage<Error>(AllOf(StartsWith(begin), HasSubstr(what), Not(HasSubstr("\n")))))
            << text;
    };
    refused("spacing = \"1cm\"\ncolour = 3\n", "a.toml:2: ", "unknown key 'colour'");
    refused("[[wall]]\nbox = [[\"0m\", \"0m\"], [\"1m\", \"1m\"]]\nspeed = 1\n", "a.toml:3: ", "unknown key 'speed'");
    refused("\nspacing = 3\n", "a.toml:2: ", "spacing must be text in quotes");
    // Each message names the place once.
    EXPECT_THAT([] { parseFluidScene("size = [2, 1]\n", "a.toml"); },
                ThrowsMessage<Error>("a.toml:1: size must be text in quotes, such as \"0.5m\""));
    refused("spacing = \"3s\"\n", "a.toml:1: ", "spacing: '3s'");
    refused("spacing = \"-1cm\"\n", "a.toml:1: ", "spacing is -0.01");
    refused("\ndensity = \"-1kg/m3\"\n", "a.toml:2: ", "density is -1");
    refused("size = [\"1m\"]\n", "a.toml:1: ", "must be a pair");
    refused("max_particles = 0\n", "a.toml:1: ", "max_particles");
    refused("a = = 1\n", "a.toml:1: ", "is not TOML");
    refused("[[liquid]]\n", "a.toml:1: ", "needs one of box");
    refused("[[liquid]]\nmask = \"missing.png\"\nat = [\"1m\", \"1m\"]\nwidth = \"1m\"\n", "a.toml:2: ", "missing.png");
    refused("[liquid]\n", "a.toml:1: ", "[[liquid]]");
    refused(
        "[[wall]]\nbox = [[\"0m\", \"1m\"], [\"2m\", \"3m\"]]\n\n[[emitter]]\nposition = [\"1m\", \"2m\"]\n"
        "velocity = [\"1m/s\", \"0m/s\"]\nwidth = \"10cm\"\n",
        "a.toml:4: ", "opens in wall 1");
    refused("[[emitter]]\nposition = [\"1m\", \"2m\"]\nvelocity = [\"0m/s\", \"0m/s\"]\nwidth = \"10cm\"\n",
            "a.toml:1: ", "velocity is 0");
}

}  // namespace
