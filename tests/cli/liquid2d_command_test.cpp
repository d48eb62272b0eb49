// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape liquid2d`: outputs, errors, resuming an interrupted run; and `animate` on what it writes.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/in_process.h"
#include "droplet/liquid2d_io/particle_file.h"
#include "droplet/mask/mask.h"
#include "support/command.h"
#include "support/paths.h"
#include "support/usda.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::CommandResult;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::readFile;
using testing::runDroplet;
using ::testing::StartsWith;

class Liquid2dCommand : public ::testing::Test {
protected:
    [[nodiscard]] std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

    [[nodiscard]] static CommandResult liquid(std::vector<std::string> more)
    {
        std::vector<std::string> arguments{"liquid2d", "--scene",          "dam", "--time",        "1s",  "--fps",
                                           "8",        "--particle-count", "300", "--frame-width", "160", "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runDroplet(arguments);
    }

    static void expectRefused(const std::vector<std::string>& arguments, int exit_code, const std::string& message)
    {
        testing::expectOneLine(testing::runInProcess(arguments), exit_code, {message});
    }

    testing::ScratchDirectory scratch_;
};

TEST_F(Liquid2dCommand, WritesDrawingsMasksAndAReport)
{
    const CommandResult run =
        liquid({path("out/%02d.svg"), "--masks", path("masks/%02d.png"), "--json", path("r.json")});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto report = nlohmann::json::parse(readFile(path("r.json")));
    EXPECT_EQ(report.at("schema"), "droplet-shape.liquid2d/1");
    ASSERT_EQ(report.at("frames").size(), 8U);
    const auto& frame = report.at("frames").at(5);
    EXPECT_DOUBLE_EQ(frame.at("time_s").get<double>(), 5.0 / 8.0);
    EXPECT_NEAR(frame.at("area_m2").get<double>(), frame.at("particle_area_m2").get<double>(),
                0.1 * frame.at("particle_area_m2").get<double>());
    EXPECT_THAT(readFile(path("out/06.svg")), StartsWith("<svg "));
    // The mask covers the area that the report states, but for what lies beyond the window's edges.
    const Mask mask = readMask(path("masks/06.png"));
    double covered = 0.0;
    for (const std::uint16_t level : mask.coverage) {
        covered += level / 65535.0;
    }
    const double pixel = report.at("window_m").at(0).get<double>() / 160.0;
    EXPECT_LE(covered * pixel * pixel, 1.001 * frame.at("area_m2").get<double>());
    EXPECT_GE(covered * pixel * pixel, 0.9 * frame.at("area_m2").get<double>());
    EXPECT_FALSE(fs::exists(path("out/checkpoint.state")));
}

TEST_F(Liquid2dCommand, WritesALottieAnimation)
{
    const CommandResult run = liquid({path("dam.json"), "--json", path("r.json")});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto file = nlohmann::json::parse(readFile(path("dam.json")));
    EXPECT_EQ(file.at("op"), 8);
    EXPECT_EQ(file.at("fr"), 8);
    EXPECT_EQ(file.at("w"), 160);
    // A layer for each material, not for each frame; the collapsing water has a keyframe at each.
    EXPECT_LE(file.at("layers").size(), 6U);
    std::size_t keyframes = 0;
    for (const auto& layer : file.at("layers")) {
        if (layer.at("nm") == "liquid") {
            keyframes = layer.at("shapes").at(0).at("it").at(0).at("ks").at("k").size();
        }
    }
    EXPECT_EQ(keyframes, 8U);
    EXPECT_EQ(nlohmann::json::parse(readFile(path("r.json"))).at("frames").size(), 8U);

    expectRefused({"liquid2d", path("dam.json"), "--no-clobber"}, 4, "dam.json");
    expectRefused({"liquid2d", path("dam.json"), "--resume"}, 2, "--resume needs a file for every frame");
    expectRefused({"liquid2d", path("dam.json"), "--json", path("dam.json")}, 2, "are the same");
    expectRefused({"liquid2d", path("dam%d.json")}, 2, "a .json with a Lottie animation");
}

TEST_F(Liquid2dCommand, ResumesToTheSameBytes)
{
    const auto run = [&](const std::string& folder, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"liquid2d", path(folder + "/%02d.svg"), "--scene", "dam",    "--fps",
                                           "4",        "--particle-count",         "300",     "--time", "2s",
                                           "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runDroplet(arguments);
    };
    ASSERT_EQ(run("whole", {}).exit_code, 0);
    // A folder in the place of the seventh frame interrupts the run behind its checkpoint.
    fs::create_directories(path("cut/07.svg"));
    ASSERT_EQ(run("cut", {}).exit_code, 4);
    ASSERT_TRUE(fs::exists(path("cut/checkpoint.state")));
    fs::remove(path("cut/07.svg"));
    const std::string kept = path("cut/01.svg");
    testing::writeFile(kept, "kept");
    ASSERT_EQ(run("cut", {"--resume"}).exit_code, 0);
    EXPECT_EQ(readFile(kept), "kept");
    for (const char* name : {"/05.svg", "/08.svg"}) {
        EXPECT_EQ(readFile(path("cut") + name), readFile(path("whole") + name)) << name;
    }
}

TEST_F(Liquid2dCommand, HoldsDrawingsAndNotTheLiquid)
{
    ASSERT_EQ(liquid({path("ones/%02d.svg"), "--particle-cache", path("ones/%02d.csv")}).exit_code, 0);
    ASSERT_EQ(liquid({path("threes/%02d.svg"), "--particle-cache", path("threes/%02d.csv"), "--hold", "3"}).exit_code,
              0);
    const auto file = [&](const std::string& name) { return readFile(path(name)); };
    EXPECT_EQ(file("threes/01.svg"), file("ones/01.svg"));
    for (const char* held : {"2", "3"}) {
        EXPECT_EQ(file(std::string("threes/0") + held + ".svg"), file("threes/01.svg"));
        EXPECT_NE(file(std::string("ones/0") + held + ".svg"), file("ones/01.svg"));
    }
    EXPECT_NE(file("threes/04.svg"), file("threes/03.svg"));
    EXPECT_EQ(file("threes/06.svg"), file("threes/04.svg"));
    for (const char* frame : {"/03.csv", "/08.csv"}) {
        EXPECT_EQ(readFile(path("threes") + frame), readFile(path("ones") + frame));
    }
    // A run that was cut off amid a held drawing begins again, with the same files.
    const std::string last = file("threes/08.svg");
    ASSERT_EQ(liquid({path("threes/%02d.svg"), "--particle-cache", path("threes/%02d.csv"), "--hold", "3", "--resume"})
                  .exit_code,
              0);
    EXPECT_EQ(file("threes/08.svg"), last);
}

TEST_F(Liquid2dCommand, BeginsLater)
{
    ASSERT_EQ(liquid({path("whole/%02d.svg"), "--hold", "2"}).exit_code, 0);
    ASSERT_EQ(liquid({path("end/%02d.svg"), "--hold", "2", "--begin", "0.5s"}).exit_code, 0);
    for (int frame = 1; frame <= 4; ++frame) {
        EXPECT_EQ(readFile(path(fmt::format("end/{:02}.svg", frame))),
                  readFile(path(fmt::format("whole/{:02}.svg", frame + 4))));
    }
    EXPECT_TRUE(fs::exists(path("end/08.svg")));
}

TEST_F(Liquid2dCommand, TheFirstFrameOfALoopGoesOnFromTheLast)
{
    const auto masks = [&](const std::string& folder, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"--masks", path(folder + "/%02d.png")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult run = liquid(arguments);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        std::vector<std::vector<std::uint16_t>> all;
        for (int frame = 1; frame <= 8; ++frame) {
            all.push_back(readMask(path(fmt::format("{}/{:02}.png", folder, frame))).coverage);
        }
        return all;
    };
    const auto difference = [](const std::vector<std::uint16_t>& a, const std::vector<std::uint16_t>& b) {
        double sum = 0.0;
        for (std::size_t k = 0; k < a.size(); ++k) {
            sum += std::abs(a[k] - b[k]) / 65535.0;
        }
        return sum;
    };
    const auto plain = masks("plain", {"--begin", "0.5s"});
    const auto loop = masks("loop", {"--begin", "0.5s", "--loop", "0.5s"});
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(loop[k], plain[k]) << k;
    }
    double most = 0.0;  // from a frame to the next
    for (std::size_t k = 0; k + 1 < loop.size(); ++k) {
        most = std::max(most, difference(loop[k], loop[k + 1]));
    }
    EXPECT_GT(difference(plain.back(), plain.front()), 1.2 * most);
    EXPECT_LT(difference(loop.back(), loop.front()), most);
    EXPECT_LT(difference(loop.back(), loop.front()), 0.4 * difference(plain.back(), plain.front()));
}

TEST_F(Liquid2dCommand, AnInterruptedLoopIsMadeAgain)
{
    const auto run = [&](const std::string& folder, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"liquid2d",
                                           path(folder + "/%02d.svg"),
                                           "--scene",
                                           "dam",
                                           "--fps",
                                           "4",
                                           "--particle-count",
                                           "300",
                                           "--time",
                                           "2s",
                                           "--loop",
                                           "0.5s",
                                           "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runDroplet(arguments).exit_code;
    };
    ASSERT_EQ(run("whole", {}), 0);
    fs::create_directories(path("cut/07.svg"));
    ASSERT_EQ(run("cut", {}), 4);
    ASSERT_TRUE(fs::exists(path("cut/checkpoint.state")));
    fs::remove(path("cut/07.svg"));
    ASSERT_EQ(run("cut", {"--resume"}), 0);
    for (const char* name : {"/01.svg", "/07.svg", "/08.svg"}) {
        EXPECT_EQ(readFile(path("cut") + name), readFile(path("whole") + name)) << name;
    }
}

TEST_F(Liquid2dCommand, RefusesLoopsThatDoNotFit)
{
    const std::string out = path("x%d.svg");
    expectRefused({"liquid2d", out, "--loop", "2s", "--begin", "1s"}, 2, "--loop: '2s' must be no longer than --begin");
    expectRefused({"liquid2d", out, "--loop", "2s", "--time", "1s"}, 2, "--loop: a fade of 48 frames is longer");
    expectRefused({"liquid2d", out, "--loop", "1s", "--particle-cache", path("x%d.ply")}, 2, "--particle-cache");
    expectRefused({"liquid2d", out, "--begin", "1s", "--particles", path("none.vtk")}, 2,
                  "--begin: the film begins after 24 frames, and there are 1 of --particles");
}

TEST_F(Liquid2dCommand, WritesParticlesThatAreReadAgain)
{
    const CommandResult run = liquid({"--particle-cache", path("cache/%02d.vtp"), "--json", path("r.json")});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto frames = nlohmann::json::parse(readFile(path("r.json"))).at("frames");
    ASSERT_EQ(frames.size(), 8U);
    // The cache has all frames, at their times, with velocities; another run draws them.
    const droplet::ParticleFile last = droplet::readParticles(path("cache/08.vtp"));
    EXPECT_EQ(last.frame.position.size(), frames.at(7).at("particles").get<std::size_t>());
    EXPECT_EQ(last.time, 7.0 / 8.0);
    EXPECT_TRUE(last.has_velocity && last.has_id);
    const CommandResult again = runDroplet({"liquid2d", "--particles", path("cache/%02d.vtp"), "--fps", "8",
                                            path("again.svg"), "--json", path("again.json"), "-q"});
    ASSERT_EQ(again.exit_code, 0) << again.error;
    const auto drawn = nlohmann::json::parse(readFile(path("again.json"))).at("frames");
    ASSERT_EQ(drawn.size(), 8U);
    EXPECT_EQ(drawn.at(7).at("particles"), frames.at(7).at("particles"));
    for (const char* refused : {"cache/%02d.vtk", "cache.vtp", "-"}) {
        expectRefused({"liquid2d", "--particle-cache", refused}, 2, "cache/%04d.bgeo");
    }
}

TEST_F(Liquid2dCommand, WritesParticlesOverTime)
{
    ASSERT_EQ(liquid({"--particle-cache", path("liquid.usda"), "--json", path("r.json")}).exit_code, 0);
    const auto frames = nlohmann::json::parse(readFile(path("r.json"))).at("frames");
    const std::string file = readFile(path("liquid.usda"));
    const testing::UsdPrim points = testing::UsdaReader(file).read().child("liquid");
    const auto& samples = points.properties.at("ids").samples;
    ASSERT_EQ(samples.size(), frames.size());
    EXPECT_EQ(testing::numbersIn(samples.at(7.0)).size(), frames.at(7).at("particles").get<std::size_t>());
    expectRefused({"liquid2d", path("%d.svg"), "--particle-cache", path("liquid.usda"), "--resume"}, 2,
                  "--resume needs a file for every frame");
}

TEST_F(Liquid2dCommand, AnimateTakesMasksFromStandardInput)
{
    const CommandResult masks = liquid({"--masks", "-"});
    ASSERT_EQ(masks.exit_code, 0) << masks.error;
    testing::CommandOptions input;
    input.input = masks.output;
    const std::vector<std::string> animate{"animate", "-", path("dam.glb"), "-q", "--triangles", "500"};
    const CommandResult run = runDroplet(animate, input);
    EXPECT_EQ(run.exit_code, 0) << run.error;
    EXPECT_TRUE(fs::exists(path("dam.glb")));

    input.input.resize(input.input.size() - 10);
    const CommandResult cut = runDroplet(animate, input);
    EXPECT_EQ(cut.exit_code, 3);
    EXPECT_THAT(cut.errorLines(), ElementsAre(HasSubstr("standard input, frame 8: the picture is cut off")));
    input.input = "GIF89a and more";
    EXPECT_THAT(runDroplet(animate, input).errorLines(), ElementsAre(HasSubstr("neither PNG nor binary PGM or PPM")));
    input.input.clear();
    EXPECT_THAT(runDroplet(animate, input).errorLines(), ElementsAre(HasSubstr("there is no picture")));
    // Two grey pictures of 40 × 40 pixels with a square of 20 × 20.
    for (int frame = 0; frame < 2; ++frame) {
        input.input += "P5 # square\n40 40\n255\n";
        for (int k = 0; k < 1600; ++k) {
            const bool is_inside = k / 40 >= 10 && k / 40 < 30 && k % 40 >= 10 && k % 40 < 30;
            input.input += is_inside ? '\xff' : '\0';
        }
    }
    EXPECT_EQ(runDroplet(animate, input).exit_code, 0);
}

TEST_F(Liquid2dCommand, DrawsParticlesOfOtherPrograms)
{
    for (int frame = 1; frame <= 3; ++frame) {
        std::string rows = "id,x,y\n";
        for (int k = 0; k < 100; ++k) {
            rows += std::to_string(k) + "," + std::to_string(0.1 * (k % 10)) + "," +
                    std::to_string(0.1 * (k / 10) + 0.2 * frame) + "\n";
        }
        testing::writeFile(path("sim" + std::to_string(frame) + ".csv"), rows);
    }
    const CommandResult run = runDroplet({"liquid2d", "--particles", path("sim%d.csv"), path("out%d.png"),
                                          "--frame-width", "100", "--json", "-", "--quiet"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto report = nlohmann::json::parse(run.output);
    EXPECT_NEAR(report.at("frames").at(2).at("area_m2").get<double>(), 1.0, 0.05);
    EXPECT_TRUE(fs::exists(path("out3.png")));

    // A file without a number is one frame.
    const CommandResult single = runDroplet(
        {"liquid2d", "--particles", path("sim1.csv"), path("one.png"), "--frame-width", "100", "--json", "-", "-q"});
    ASSERT_EQ(single.exit_code, 0) << single.error;
    const auto frames = nlohmann::json::parse(single.output).at("frames");
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_NEAR(frames.at(0).at("area_m2").get<double>(), 1.0, 0.05);
    expectRefused({"liquid2d", "--particles", path("sim1.csv"), path("x%d.png"), "--json", path("sim1.csv")}, 2,
                  "--particles");

    testing::writeFile(path("sim2.csv"), "id,x,y\n1,nan,0\n2,1,1\n");
    expectRefused({"liquid2d", "--particles", path("sim%d.csv"), path("x%d.png"), "-q"}, 3, "sim2.csv");
    fs::remove(path("sim2.csv"));
    expectRefused({"liquid2d", "--particles", path("sim%d.csv"), path("x%d.png"), "-q"}, 3, "sim2.csv");
}

TEST_F(Liquid2dCommand, IdsMayBeAsLargeAsTheyLike)
{
    const auto drawn = [&](const std::string& name, const std::string& last) {
        std::string rows = "id,x,y\n";
        for (int k = 0; k < 100; ++k) {
            rows += (k < 99 ? std::to_string(k) : last) + "," + std::to_string(0.1 * (k % 10)) + "," +
                    std::to_string(0.1 * (k / 10)) + "\n";
        }
        testing::writeFile(path(name + ".csv"), rows);
        const CommandResult run = runDroplet(
            {"liquid2d", "--particles", path(name + ".csv"), path(name + ".svg"), "--frame-width", "100", "-q"});
        EXPECT_EQ(run.exit_code, 0) << run.error;
        return readFile(path(name + ".svg"));
    };
    EXPECT_EQ(drawn("far", "4294967295"), drawn("near", "99"));
}

TEST_F(Liquid2dCommand, TellsOfShortStepsAndOfLostLiquid)
{
    testing::writeFile(path("fall.toml"),
                       "size = [\"1m\", \"1m\"]\nspacing = \"10cm\"\ngravity = [\"0m/s2\", \"-1e6m/s2\"]\n"
                       "margin = \"1cm\"\n[[liquid]]\nbox = [[\"0m\", \"0m\"], [\"1m\", \"0.2m\"]]\n");
    const CommandResult run =
        runDroplet({"liquid2d", "--scene", path("fall.toml"), path("x%d.svg"), "--fps", "1", "--time", "3s"});
    EXPECT_EQ(run.exit_code, 5) << run.error;
    EXPECT_THAT(run.errorLines(),
                ElementsAre(AllOf(StartsWith("warning: "), HasSubstr("steps")),
                            AllOf(HasSubstr("from frame 2 on"), HasSubstr("all 18 particles have left"))));
    EXPECT_FALSE(fs::exists(path("x2.svg")));
}

TEST_F(Liquid2dCommand, SummaryTellsTheShownTimeAndWhatLeft)
{
    const auto run = [&](const char* count, const char* output) {
        return runDroplet({"liquid2d", "--scene", "splash", "--time", "1s", "--fps", "8", "--particle-count", count,
                           "--frame-width", "160", path(output), "--json", path("r.json")});
    };
    const CommandResult many = run("300", "x.svg");
    const auto report = nlohmann::json::parse(readFile(path("r.json")));
    EXPECT_THAT(many.error, StartsWith("8 frames, 1 s; "));
    const auto left = report.at("removed").get<int>();
    EXPECT_EQ(many.error.find(" left the window") != std::string::npos, left > 0);
    EXPECT_THAT(many.error, Not(HasSubstr("too few")));
    EXPECT_THAT(run("100", "few.svg").error, HasSubstr("warning: --particle-count: 100 particles are too few"));
}

TEST_F(Liquid2dCommand, RefusesWhatCannotBeDrawn)
{
    expectRefused({"liquid2d", "x.mp4", "--frame-width", "641"}, 2, "--frame-width: '641' must be even");
    const std::string out = path("x%d.svg");
    expectRefused({"liquid2d", out, "--scene", "splosh"}, 2, "scene is 'splosh', must be one of splash, wave");
    expectRefused({"liquid2d"}, 2, "OUTPUT");
    expectRefused({"liquid2d", path("x.gif")}, 2, "a file for every frame such as out/%04d.svg");
    expectRefused({"liquid2d", out, "--spacing", "1mm"}, 2, "--spacing needs --particles");
    expectRefused({"liquid2d", out, "--particles", "none.vtk"}, 3, "none.vtk");
    expectRefused({"liquid2d", out, "--tail-slope", "2"}, 2, "--tail-slope: '2' must be a number from 0.2 to 1.2");
    expectRefused({"liquid2d", path("x.mp4"), "--resume"}, 2, "--resume needs a file for every frame");
    testing::writeFile(path("scene.toml"), "spacing = \"2cm\"\ngravitas = \"1m/s2\"\n");
    expectRefused({"liquid2d", out, "--scene", path("scene.toml")}, 3, "scene.toml:2: ");
    expectRefused({"liquid2d", out, "--scene", path("none.toml")}, 3, "none.toml");
}

}  // namespace
}  // namespace droplet
