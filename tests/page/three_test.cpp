// SPDX-License-Identifier: GPL-3.0-or-later
// Our files in three.js's own loader, run by node.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/colour_pictures.h"
#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using ::testing::ElementsAre;
using testing::runDroplet;
using testing::runProgram;
using ::testing::SizeIs;
using testing::writeFile;

nlohmann::json played(const std::string& file, int frames = 0)
{
    const auto run = runProgram({"node", testing::kPlayer, testing::kThree, "24", std::to_string(frames), file});
    EXPECT_EQ(run.exit_code, 0) << run.error;
    return nlohmann::json::parse(run.output, nullptr, false);
}

TEST(Three, KnowsTheSliderByItsName)
{
    testing::ScratchDirectory scratch;
    const std::string file = (scratch.path() / "disc.glb").string();
    writeFile(scratch.path() / "disc.pgm", testing::discPicture(64, 24.0));
    const auto run = runDroplet(
        {(scratch.path() / "disc.pgm").string(), file, "--fill-range", "0.5..3", "--triangles", "500", "-q"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto seen = played(file);
    ASSERT_THAT(seen.at("meshes"), SizeIs(1));
    const auto& mesh = seen.at("meshes").at(0);
    EXPECT_EQ(mesh.at("targets"), nlohmann::json({{"volume", 0}}));
    EXPECT_THAT(mesh.at("influences"), ElementsAre(0.0));
    EXPECT_EQ(mesh.at("extras").at("fill_range"), nlohmann::json({0.5, 3.0}));
    EXPECT_EQ(mesh.at("relative"), true);
}

// Compressed GLB and USD are the same droplet as the GLB: its size in metres, its volume, its crisp rim, its closed
// mesh.
TEST(Three, SeesTheSameDropletInEveryFormat)
{
    testing::ScratchDirectory scratch;
    const std::string picture = (scratch.path() / "disc.pgm").string();
    writeFile(picture, testing::discPicture(64, 24.0));
    const auto seen = [&](const std::string& name, const std::vector<std::string>& options = {}) {
        const std::string file = (scratch.path() / name).string();
        std::vector<std::string> arguments{picture, file, "--triangles", "500", "-q", "--material", "honey"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto made = runDroplet(arguments);
        EXPECT_EQ(made.exit_code, 0) << made.error;
        const auto run = runProgram({"node", testing::kMeshReader, testing::kThree, file});
        EXPECT_EQ(run.exit_code, 0) << run.error;
        const auto meshes = nlohmann::json::parse(run.output, nullptr, false);
        EXPECT_THAT(meshes, SizeIs(1)) << name;
        return meshes.at(0);
    };
    const auto glb = seen("droplet.glb");
    EXPECT_EQ(glb.at("open_edges"), 0);
    EXPECT_NEAR(glb.at("high").at(0), 7.5e-3, 0.05e-3);
    EXPECT_GT(glb.at("outward"), 0.9);
    const auto compare = [&](const nlohmann::json& other, double tolerance) {
        EXPECT_EQ(other.at("triangles"), glb.at("triangles"));
        EXPECT_EQ(other.at("places"), glb.at("places"));
        EXPECT_EQ(other.at("open_edges"), 0);
        EXPECT_GT(other.at("outward"), 0.9);
        EXPECT_NEAR(other.at("volume"), glb.at("volume"), 1e-4 * glb.at("volume").get<double>());
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(other.at("low").at(k), glb.at("low").at(k), tolerance);
            EXPECT_NEAR(other.at("high").at(k), glb.at("high").at(k), tolerance);
        }
        EXPECT_NEAR(other.at("uv").at(0), glb.at("uv").at(0), 1e-5);
        EXPECT_EQ(other.at("material").at("ior"), glb.at("material").at("ior"));
        EXPECT_EQ(other.at("material").at("roughness"), glb.at("material").at("roughness"));
    };
    for (const char* compression : {"quantize", "meshopt"}) {
        const auto compressed = seen(std::string(compression) + ".glb", {"--compress", compression});
        compare(compressed, 0.2e-6);
        EXPECT_NEAR(compressed.at("uv").at(1), glb.at("uv").at(1), 1e-5);
        const double thickness = glb.at("material").at("thickness");
        EXPECT_GT(thickness, 0.0);
        EXPECT_NEAR(compressed.at("material").at("thickness"), thickness, 1e-6 * thickness);
    }
    for (const char* name : {"droplet.usda", "droplet.usdz"}) {
        const auto usd = seen(name);
        compare(usd, 0.0);
        EXPECT_NEAR(usd.at("uv").at(1), 1.0 - glb.at("uv").at(1).get<double>(), 1e-5);
        EXPECT_LT(usd.at("material").at("opacity"), 1.0);
        EXPECT_EQ(usd.at("material").at("colour"), nlohmann::json({0.9, 0.5, 0.1})) << name;
    }
}

// A slider, an animation with new triangles, a windshield and a flow look the same however they are compressed.
TEST(Three, SeesTheSameFilmWithEveryCompression)
{
    testing::ScratchDirectory scratch;
    const auto path = [&](const std::string& name) { return (scratch.path() / name).string(); };
    writeFile(path("disc.pgm"), testing::discPicture(64, 24.0));
    for (int frame = 0; frame < 4; ++frame) {
        writeFile(path("f" + std::to_string(frame) + ".pgm"), testing::discPicture(64, 24.0 - 2.0 * frame));
    }
    struct Film {
        std::string name;
        std::vector<std::string> command;  ///< without the file
        std::vector<std::string> shown;    ///< arguments of the player
        double tolerance;                  ///< of places [m]
    };
    const std::vector<Film> films{
        {"slider",
         {path("disc.pgm"), "--triangles", "500", "--fill-range", "0.5..3", "-q", "@"},
         {"fill", "0.5", "1", "3"},
         2e-6},
        {"animation",
         {"animate", path("f0.pgm"), path("f1.pgm"), path("f2.pgm"), path("f3.pgm"), "@", "--triangles", "500", "-q"},
         {"time", "0.001", "0.06", "0.12"},
         2e-6},
        {"windshield",
         {"windshield", path("w.png"), "--rain", "25mm/h", "--glass-width", "0.4m", "--glass-height", "0.2m",
          "--warm-up", "2s", "--time", "1s", "--frame-size", "32x18", "--samples", "1", "-q", "--animation", "@"},
         {"time", "0.001", "0.5", "0.9"},
         2e-5},
        {"flow", {"flow", "--preset", "bottle", "@", "--time", "0.5s", "-q"}, {"time", "0.001", "0.2", "0.4"}, 2e-5}};
    for (const Film& film : films) {
        SCOPED_TRACE(film.name);
        nlohmann::json plain;
        for (const std::string compression : {"none", "quantize", "meshopt"}) {
            SCOPED_TRACE(compression);
            const std::string file = path(film.name + "_" + compression + ".glb");
            std::vector<std::string> arguments = film.command;
            std::replace(arguments.begin(), arguments.end(), std::string("@"), file);
            arguments.insert(arguments.end(), {"--compress", compression});
            const auto made = runDroplet(arguments);
            ASSERT_EQ(made.exit_code, 0) << made.error;
            std::vector<std::string> player{"node", testing::inSource("tests/page/film.mjs"), testing::kThree, file};
            player.insert(player.end(), film.shown.begin(), film.shown.end());
            const auto run = runProgram(player);
            ASSERT_EQ(run.exit_code, 0) << run.error;
            const auto seen = nlohmann::json::parse(run.output);
            if (compression == "none") {
                plain = seen;
                EXPECT_NE(plain.at(0), plain.at(2)) << "it moves";
                continue;
            }
            for (std::size_t k = 0; k < plain.size(); ++k) {
                EXPECT_EQ(seen[k].at("triangles"), plain[k].at("triangles"));
                for (const char* const figure : {"volume", "area"}) {
                    const double expected = plain[k].at(figure);
                    EXPECT_NEAR(seen[k].at(figure), expected, 1e-3 * expected) << figure;
                }
                for (std::size_t i = 0; i < 3; ++i) {
                    EXPECT_NEAR(seen[k].at("low").at(i), plain[k].at("low").at(i), film.tolerance);
                    EXPECT_NEAR(seen[k].at("high").at(i), plain[k].at("high").at(i), film.tolerance);
                }
            }
        }
    }
}

// The page lights the ground through the liquid's surface, of which the part below an overhang faces down, as the base
// does: what is taken for it has no hole and ends on the ground.
TEST(Three, PageKnowsTheSurfaceBelowAnOverhang)
{
    testing::ScratchDirectory scratch;
    const auto path = [&](const char* name) { return (scratch.path() / name).string(); };
    writeFile(scratch.path() / "disc.pgm", testing::discPicture(64, 24.0));
    const auto made = runDroplet({path("disc.pgm"), path("disc.glb"), "--triangles", "2000", "--liquid", "mercury",
                                  "--contact-angle", "140deg", "--json", path("disc.json"), "-q"});
    ASSERT_EQ(made.exit_code, 0) << made.error;
    const auto run = runProgram({"node", testing::inSource("tests/page/surface.mjs"), testing::kThree, path("disc.glb"),
                                 testing::inSource("src/html/liquid_triangles.js")});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto seen = nlohmann::json::parse(run.output, nullptr, false);
    const auto mesh = nlohmann::json::parse(testing::readFile(path("disc.json"))).at("mesh");
    const int triangles = mesh.at("triangles");
    EXPECT_EQ(seen.at("triangles"), triangles);
    EXPECT_GT(seen.at("facing_down"), 100);
    EXPECT_EQ(seen.at("rim"), 2 * mesh.at("vertices").get<int>() - triangles - 2) << "Euler's formula of a disc";
    EXPECT_EQ(seen.at("rim_height"), 0.0);
}

// Every look is on its own droplets.
TEST(Three, SeesTheSameLooksInEveryFormat)
{
    testing::ScratchDirectory scratch;
    const std::string picture = (scratch.path() / "pie.ppm").string();
    writeFile(picture, testing::pie(120, 50.0));
    const auto seen = [&](const std::string& name, const std::vector<std::string>& options) {
        const std::string file = (scratch.path() / name).string();
        std::vector<std::string> arguments{picture, file, "--triangles", "2000", "-q"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto made = runDroplet(arguments);
        EXPECT_EQ(made.exit_code, 0) << made.error;
        const auto run = runProgram({"node", testing::kMeshReader, testing::kThree, file});
        EXPECT_EQ(run.exit_code, 0) << run.error;
        return nlohmann::json::parse(run.output, nullptr, false);
    };
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{"--by-colour"}, {"--by-colour", "--nodes", "each"}}) {
        const auto glb = seen("looks.glb", options);
        ASSERT_THAT(glb, SizeIs(3));
        for (const char* name : {"looks.usda", "looks.usdz"}) {
            const auto usd = seen(name, options);
            ASSERT_THAT(usd, SizeIs(3)) << name;
            for (std::size_t k = 0; k < 3; ++k) {
                for (const char* key : {"triangles", "places", "low", "high"}) {
                    EXPECT_EQ(usd.at(k).at(key), glb.at(k).at(key)) << key;
                }
                EXPECT_EQ(usd.at(k).at("open_edges"), 0);
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    // Absorption leaves a little of every colour; USD has none.
                    const double colour = usd.at(k).at("material").at("colour").at(channel);
                    EXPECT_NEAR(std::max(colour, 0.02), glb.at(k).at("material").at("depth_colour").at(channel), 1e-6);
                }
            }
        }
        for (const char* compression : {"quantize", "meshopt"}) {
            std::vector<std::string> compress = options;
            compress.insert(compress.end(), {"--compress", compression});
            const auto compressed = seen("compressed.glb", compress);
            ASSERT_THAT(compressed, SizeIs(3)) << compression;
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(compressed.at(k).at("places"), glb.at(k).at("places"));
                EXPECT_EQ(compressed.at(k).at("open_edges"), 0);
                EXPECT_EQ(compressed.at(k).at("name"), glb.at(k).at("name"));
                EXPECT_EQ(compressed.at(k).at("material").at("name"), glb.at(k).at("material").at("name"));
                EXPECT_EQ(compressed.at(k).at("material").at("depth_colour"),
                          glb.at(k).at("material").at("depth_colour"));
                const double thickness = glb.at(k).at("material").at("thickness");
                EXPECT_NEAR(compressed.at(k).at("material").at("thickness"), thickness, 1e-6 * thickness);
                EXPECT_NEAR(compressed.at(k).at("volume"), glb.at(k).at("volume"),
                            1e-4 * glb.at(k).at("volume").get<double>());
            }
        }
    }
    const auto tinted = seen("tinted.usdz", {"--colour-map"});
    ASSERT_THAT(tinted, SizeIs(1));
    EXPECT_EQ(tinted.at(0).at("material").at("has_picture"), true);
    EXPECT_EQ(tinted.at(0).at("material").at("colour"), nlohmann::json({1, 1, 1}));
}

// At every time one mesh is shown; its weights select the frame and add up to 1, or to 0 at a run's first frame.
TEST(Three, PlaysOneMeshAfterAnother)
{
    constexpr int kFrames = 12;
    testing::ScratchDirectory scratch;
    const std::string file = (scratch.path() / "closing.glb").string();
    const auto run = runDroplet(
        {"animate", testing::inSource("data/closing/%04d.png"), file, "--fps", "24", "--triangles", "1k", "-q"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto seen = played(file, kFrames);
    EXPECT_EQ(seen.at("clips"), 1);
    ASSERT_THAT(seen.at("frames"), SizeIs(kFrames));
    std::vector<std::string> order;
    for (const auto& shown : seen.at("frames")) {
        ASSERT_THAT(shown, SizeIs(1));
        const std::string name = shown.at(0).at("name");
        double sum = 0.0;
        for (const double influence : shown.at(0).at("influences")) {
            sum += influence;
        }
        if (order.empty() || order.back() != name) {
            EXPECT_EQ(std::count(order.begin(), order.end(), name), 0) << name;
            EXPECT_LT(sum, 0.02) << name;
            order.push_back(name);
        } else {
            EXPECT_NEAR(sum, 1.0, 0.02) << name;
        }
    }
    EXPECT_EQ(order.size(), seen.at("meshes").size());
}

// In a real browser both forms of a model show the same droplets; the texture form uses the example's shader.
TEST(Three, PlaysRainByNodesAndByTexture)
{
    testing::ScratchDirectory scratch;
    const auto path = [&](const char* name) { return (scratch.path() / name).string(); };
    for (const char* animation : {"nodes", "texture"}) {
        const auto run = runDroplet({"windshield",
                                     path("last.png"),
                                     "--preset",
                                     "figure-3.11",
                                     "--rain",
                                     "25mm/h",
                                     "--glass-width",
                                     "0.4m",
                                     "--glass-height",
                                     "0.2m",
                                     "--warm-up",
                                     "2s",
                                     "--time",
                                     "1s",
                                     "--frame-size",
                                     "32x18",
                                     "--samples",
                                     "1",
                                     "--animation",
                                     path((std::string(animation) + ".glb").c_str()),
                                     "--animation-method",
                                     animation,
                                     "-q"});
        ASSERT_EQ(run.exit_code, 0) << run.error;
    }
    const auto run = runProgram({"node", testing::kRainPlayer, testing::kChromium, testing::kThree,
                                 testing::inSource("examples/three/play_droplets.js"), path("nodes.glb"),
                                 path("texture.glb"), "30", "0", "29"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto seen = nlohmann::json::parse(run.output);
    SCOPED_TRACE(seen.dump(1));
    EXPECT_THAT(seen.at("complaints"), ::testing::IsEmpty());
    EXPECT_EQ(seen.at("calls").at("texture"), 1);
    EXPECT_LT(seen.at("calls").at("nodes"), 40);
    ASSERT_THAT(seen.at("frames"), SizeIs(2));
    for (const auto& frame : seen.at("frames")) {
        EXPECT_GT(frame.at("nodes"), 2000);
        EXPECT_LT(frame.at("different").get<int>(), frame.at("nodes").get<int>() / 10);
    }
    EXPECT_NE(seen.at("frames").at(0).at("nodes"), seen.at("frames").at(1).at("nodes")) << "it moves";
}

}  // namespace
}  // namespace droplet
