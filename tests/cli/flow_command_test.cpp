// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape flow`: the contract of its files, errors, resuming an interrupted run.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "cli/in_process.h"
#include "droplet/drawing/picture.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/io/read_surface.h"
#include "droplet/units.h"
#include "support/command.h"
#include "support/paths.h"
#include "support/usda.h"

namespace droplet {
namespace {

using ::testing::AllOf;
using testing::CommandResult;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::readFile;
using testing::runDroplet;
using ::testing::StartsWith;

// A rectangle of 1 m by 1 m that slopes down 30° to +z, in millimetres.
constexpr const char* kSlope =
    "v 0 0 0\nv 1000 0 0\nv 1000 577.350269189626 -1000\nv 0 577.350269189626 -1000\nf 1 2 3\nf 1 3 4\n";

class FlowCommand : public ::testing::Test {
protected:
    FlowCommand() { testing::writeFile(path("slope.obj"), kSlope); }

    [[nodiscard]] std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

    [[nodiscard]] CommandResult flow(const std::string& output, const std::vector<std::string>& more,
                                     const std::string& object = "slope.obj") const
    {
        return runDroplet(argumentsOf(object, output, more));
    }

    [[nodiscard]] std::vector<std::string> argumentsOf(const std::string& object, const std::string& output,
                                                       const std::vector<std::string>& more) const
    {
        std::vector<std::string> arguments{"flow", path(object), path(output), "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    void expectRefused(const std::vector<std::string>& arguments, int exit_code, const std::string& message,
                       const std::string& object = "slope.obj") const
    {
        testing::expectOneLine(testing::runInProcess(argumentsOf(object, "refused.glb", arguments)), exit_code,
                               {message});
        EXPECT_FALSE(std::filesystem::exists(path("refused.glb")));
    }

    /// Rows of a table, without its header.
    [[nodiscard]] std::vector<std::vector<double>> rows(const std::string& table) const
    {
        std::istringstream lines(readFile(path(table)));
        std::vector<std::vector<double>> all;
        std::string line;
        std::getline(lines, line);
        EXPECT_EQ(line,
                  "frame,time_s,id,x_m,y_m,z_m,velocity_x_m_per_s,velocity_y_m_per_s,velocity_z_m_per_s,volume_m3,"
                  "face,radius_m,elongation,rotation_x,rotation_y,rotation_z,rotation_w,age_s");
        while (std::getline(lines, line)) {
            std::istringstream cells(line);
            all.emplace_back();
            for (std::string cell; std::getline(cells, cell, ',');) {
                all.back().push_back(std::stod(cell));
            }
        }
        return all;
    }

    testing::ScratchDirectory scratch_;
};

TEST_F(FlowCommand, IsTheFormulaOnASlope)
{
    const double slope = 30.0 * kDegree;
    testing::writeFile(path("start.csv"), "x_m,y_m,z_m,volume_m3\n0.5,0.519615242270663,-0.9,2e-8\n");
    const CommandResult run = flow("out.glb", {"--start", path("start.csv"), "--retention", "paper", "--friction",
                                               "1e-4", "--droplets", path("paths.csv"), "--time", "1s", "--fps", "24"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const double decay = 1e-4 / (998.2 * 2e-8);
    const double pull = 9.81 * std::sin(slope);
    const auto all = rows("paths.csv");
    ASSERT_EQ(all.size(), 24U);
    for (const std::vector<double>& row : all) {
        const double t = row[1];
        const double way = pull / decay * t + pull / (decay * decay) * std::expm1(-decay * t);
        EXPECT_NEAR(row[5], -0.9 + std::cos(slope) * way, 1e-12);
        EXPECT_NEAR(row[4], -std::tan(slope) * row[5], 1e-12);
        EXPECT_NEAR(row[8], std::cos(slope) * pull / decay * -std::expm1(-decay * t), 1e-12);
        EXPECT_EQ(row[9], 2e-8);
    }
}

TEST_F(FlowCommand, WritesAllThatItSays)
{
    ASSERT_EQ(flow("out.glb", {"--drops", "30", "--time", "0.5s", "--json", path("report.json"), "--droplets",
                               path("paths.json"), "--streaks", path("streaks.ply"), "--hysteresis", "0.02"})
                  .exit_code,
              0);
    EXPECT_THAT(readFile(path("out.glb")), StartsWith("glTF"));
    const auto report = nlohmann::json::parse(readFile(path("report.json")));
    EXPECT_EQ(report.at("schema"), "droplet-shape.flow/1");
    EXPECT_EQ(nlohmann::json::parse(readFile(path("paths.json"))).at("schema"), "droplet-shape.flow-droplets/1");
    EXPECT_GT(readSurface(path("streaks.ply")).surface.triangles.size(), 100U);
    for (const char* name : {"mesh-%d.obj", "mesh-%d.stl", "mesh-%d.ply", "mesh-%d.glb"}) {
        ASSERT_EQ(flow(name, {"--drops", "3", "--time", "0.1s"}).exit_code, 0) << name;
        const std::string first = path(std::string(name).replace(5, 2, "1"));
        // They lie on the slope, y = −tan 30° z in the file.
        const Surface surface = readSurface(first).surface;
        const bool is_turned = first.ends_with(".stl") || first.ends_with(".ply");
        for (const Vec3& p : surface.vertices) {
            const Vec3 in_file = is_turned ? p : Vec3{p.x, p.z, -p.y};
            EXPECT_NEAR(in_file.y, -std::tan(30.0 * kDegree) * in_file.z, 5e-3) << first;
        }
    }
}

TEST_F(FlowCommand, DrawsPicturesAndMaps)
{
    ASSERT_EQ(flow("last.png", {"--drops", "5", "--time", "0.1s", "--preview-size", "96x64"}).exit_code, 0);
    const Picture last = readPicture(path("last.png"));
    EXPECT_EQ(last.width, 96);
    EXPECT_EQ(last.height, 64);
    testing::writeFile(path("uv.obj"), "v 0 0 0\nv 100 0 0\nv 100 0 -100\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n");
    ASSERT_EQ(flow("f%d.png",
                   {"--drops", "5", "--time", "0.1s", "--fps", "20", "--preview-size", "96x64", "--maps",
                    path("m%d.png"), "--map-width", "64"},
                   "uv.obj")
                  .exit_code,
              0);
    for (const char* name : {"f1.png", "f2.png", "m1-normal.png", "m2-thickness.png", "m2-age.png", "m2-wet.png"}) {
        EXPECT_TRUE(std::filesystem::exists(path(name))) << name;
    }
    expectRefused({"--drops", "3", "--maps", path("m%d.png")}, 2, "--maps");
}

TEST_F(FlowCommand, IsTheSameWithAnyNumberOfThreadsAndIfItResumes)
{
    for (const char* folder : {"a", "b"}) {
        std::filesystem::create_directory(path(folder));
    }
    const std::vector<std::string> options{"--drops", "20",  "--object-size", "20cm", "--rain", "50mm/h",
                                           "--film",  "5um", "--fps",         "10",   "--time"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> all = options;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    ASSERT_EQ(flow("a/%d.ply", with({"3s", "-j", "1"})).exit_code, 0);
    // A folder in the place of a frame interrupts the run.
    std::filesystem::create_directories(path("b/25.ply/x"));
    ASSERT_EQ(flow("b/%d.ply", with({"3s", "-j", "2"})).exit_code, 4);
    EXPECT_TRUE(std::filesystem::exists(path("b/checkpoint.state")));
    std::filesystem::remove_all(path("b/25.ply"));
    EXPECT_EQ(flow("b/%d.ply", with({"3s", "--resume", "--seed", "7"})).exit_code, 2) << "another run";
    testing::writeFile(path("b/5.ply"), "kept");
    ASSERT_EQ(flow("b/%d.ply", with({"3s", "--resume"})).exit_code, 0);
    EXPECT_EQ(readFile(path("b/5.ply")), "kept") << "frames that exist are not made again";
    EXPECT_FALSE(std::filesystem::exists(path("b/checkpoint.state")));
    testing::writeFile(path("b/5.ply"), readFile(path("a/5.ply")));
    for (int k = 1; k <= 30; ++k) {
        const std::string name = "/" + std::to_string(k) + ".ply";
        EXPECT_EQ(readFile(path("a" + name)), readFile(path("b" + name))) << k;
    }
}

TEST_F(FlowCommand, ResumesPicturesAndMapsFromTheLastFrame)
{
    testing::writeFile(path("uv.obj"), "v 0 0 0\nv 100 80 0\nv 100 80 -100\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n");
    const auto wet = [&](const std::string& folder, const std::string& end, const std::vector<std::string>& more) {
        std::vector<std::string> all{"--drops",        "9",
                                     "--hysteresis",   "0.02",
                                     "--fps",          "2",
                                     "--drying",       "3s",
                                     "--maps",         path(folder + "/m%d.png"),
                                     "--map-width",    "48",
                                     "--preview-size", "64x48",
                                     "--time",         end};
        all.insert(all.end(), more.begin(), more.end());
        return flow(folder + "/%d.png", all, "uv.obj");
    };
    ASSERT_EQ(wet("new/a", "2.5s", {}).exit_code, 0) << "the folder of a pattern is made";
    std::filesystem::create_directories(path("b/5.png/x"));
    ASSERT_EQ(wet("b", "2.5s", {}).exit_code, 4);
    std::filesystem::remove_all(path("b/5.png"));
    testing::writeFile(path("b/2.png"), "kept");
    const CommandResult resumed = wet("b", "2.5s", {"--resume"});
    ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
    EXPECT_EQ(readFile(path("b/2.png")), "kept") << "frames that exist are not drawn again";
    for (const char* name : {"/1.png", "/5.png", "/m5-normal.png", "/m5-thickness.png", "/m5-age.png"}) {
        EXPECT_EQ(readFile(path("b") + name), readFile(path("new/a") + name)) << name;
    }
}

TEST_F(FlowCommand, MapsHaveTheThicknessOfTheFilm)
{
    testing::writeFile(path("uv.obj"), "v 0 0 0\nv 100 80 0\nv 100 80 -100\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n");
    const CommandResult run = flow("f%d.obj",
                                   {"--drops", "9", "--hysteresis", "0.02", "--film", "0.4mm", "--time", "1s", "--fps",
                                    "2", "--maps", path("m%d.png"), "--map-width", "64"},
                                   "uv.obj");
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const Picture map = readPicture(path("m2-thickness.png"));
    // 0.4 mm of 5 mm is level 20; in the middle the film is 1.5 times as thick, and thicker where it is narrow.
    const auto films =
        std::count_if(map.rgb.begin(), map.rgb.end(), [](std::uint8_t level) { return level >= 20 && level <= 80; });
    EXPECT_GT(films, 30);
}

TEST_F(FlowCommand, AFloorCatchesTheWater)
{
    // Small, so that they are over the edge soon.
    const auto with = [&](const std::string& floor) {
        return std::vector<std::string>{"--floor",       floor,
                                        "--object-size", "10cm",
                                        "--drops",       "30",
                                        "--volume",      "20uL",
                                        "--time",        "4s",
                                        "--fps",         "5",
                                        "--hysteresis",  "0",
                                        "--adhesion",    "0",
                                        "--droplets",    path("drops.csv"),
                                        "--json",        path("report.json")};
    };
    for (const char* const floor : {"plate", "dish"}) {
        const CommandResult result = flow("x.glb", with(floor));
        ASSERT_EQ(result.exit_code, 0) << result.error;
        const auto report = nlohmann::json::parse(readFile(path("report.json")));
        if (floor == std::string("plate")) {
            EXPECT_EQ(report["balance"].back()["left_m3"], 0.0) << "the dish is narrower";
        }
        EXPECT_GT(report["counts"]["landings"], 5) << floor;
        // In the first frame all are on the object, whose triangles are 0 and 1.
        std::istringstream table(readFile(path("drops.csv")));
        std::string line;
        std::getline(table, line);
        const auto before = line.substr(0, line.find("face"));
        int count = 0;
        while (std::getline(table, line) && line.starts_with("1,")) {
            std::istringstream cells(line);
            for (auto k = std::count(before.begin(), before.end(), ','); k >= 0; --k) {
                std::getline(cells, line, ',');
            }
            EXPECT_TRUE(line == "0" || line == "1") << line;
            ++count;
        }
        EXPECT_EQ(count, 30);
    }
    expectRefused({"--drops", "3", "--floor", "dish", "--spin", "10deg/s"}, 2, "--floor needs an object that rests");
    expectRefused({"--drops", "3", "--floor", "bowl"}, 2, "--floor");
    expectRefused({"--rain", "0mm/h"}, 2, "--rain 0mm/h brings no droplets");
}

TEST_F(FlowCommand, TheCameraStandsAnywhereInALight)
{
    const auto drawn = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all{"--drops", "5", "--time", "0.1s", "--preview-size", "48x32"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_EQ(flow("x.png", all).exit_code, 0);
        return testing::readFile(path("x.png"));
    };
    const std::string above = drawn({"--camera", "-60deg,10deg"});
    EXPECT_NE(drawn({"--camera", "-60deg,-10deg"}), above);
    EXPECT_NE(drawn({"--camera", "-60deg,10deg,2m"}), above);
    EXPECT_NE(drawn({"--camera", "-60deg,10deg", "--look-at", "0cm,10cm,0cm"}), above);
    testing::writeFile(path("sky.ppm"), "P3 2 1 255 255 0 0 0 0 255\n");
    EXPECT_NE(drawn({"--camera", "-60deg,10deg", "--environment", path("sky.ppm")}), above);
    EXPECT_EQ(flow("sky.ppm.png", {"--drops", "3", "--environment", path("sky.ppm.png")}).exit_code, 2);
    expectRefused({"--drops", "3", "--preview", path("p.png"), "--camera", "1deg,2deg,3deg"}, 2, "--camera: distance");
    expectRefused({"--drops", "3", "--preview", path("p.png"), "--camera", "1deg"}, 2, "azimuth, elevation");
    expectRefused({"--drops", "3", "--look-at", "1m,2m,3m"}, 2, "--look-at needs --preview");
}

TEST_F(FlowCommand, ShowsTheLastFrameInAPreviewOrATurntable)
{
    const std::vector<std::string> scene{"--drops",        "5",     "--time",       "0.1s",
                                         "--preview-size", "64x48", "--hysteresis", "0"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.end(), scene.begin(), scene.end());
        return more;
    };
    ASSERT_EQ(flow("last.png", scene).exit_code, 0);
    ASSERT_EQ(flow("out.glb", with({"--preview", path("p.png")})).exit_code, 0);
    EXPECT_EQ(readPicture(path("p.png")), readPicture(path("last.png")));
    const CommandResult turned =
        flow("out-%d.obj", with({"--preview", path("t.png"), "--turntable", "3", "--progress", "json"}));
    ASSERT_EQ(turned.exit_code, 0) << turned.error;
    EXPECT_NE(readPicture(path("t-001.png")), readPicture(path("t-002.png")));
    EXPECT_NE(readPicture(path("t-002.png")), readPicture(path("t-003.png")));
    const std::vector<std::string> lines = turned.errorLines();
    ASSERT_EQ(lines.size(), 6U) << turned.error;
    EXPECT_THAT(lines[2], StartsWith(R"({"frame":3,"of":3,"elapsed_s":)"));
    EXPECT_THAT(lines[5], StartsWith(R"({"drawn":3,"of":3,"elapsed_s":)"));
    expectRefused({"--drops", "3", "--preview", path("p.mp4")}, 2, "--turntable");
    expectRefused({"--drops", "3", "--preview", path("p.jpg")}, 2, "--preview");
    expectRefused({"--drops", "3", "--turntable", "4"}, 2, "--preview");
    EXPECT_EQ(flow("x.png", with({"--preview", path("p.png")})).exit_code, 2);
}

TEST_F(FlowCommand, ShowsPresetsWithTheirOwnObjects)
{
    const auto preset = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"flow", "--preset"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runDroplet(arguments);
    };
    const CommandResult tear = preset({"tear", path("tear.glb"), "--json", path("tear.json"), "--droplets",
                                       path("tear.csv"), "--fps", "10", "--quiet"});
    ASSERT_EQ(tear.exit_code, 0) << tear.error;
    const auto report = nlohmann::json::parse(readFile(path("tear.json")));
    EXPECT_EQ(report["preset"], "tear");
    EXPECT_EQ(report["input"]["path"], "preset tear");
    EXPECT_EQ(report["model"]["motion"], "paper");
    EXPECT_EQ(report["counts"]["launches"], 1);
    EXPECT_EQ(rows("tear.csv").front().size(), 18U);
    EXPECT_EQ(preset({"bottle", path("b.glb"), "--time", "0.1s", "--quiet"}).exit_code, 0);
    EXPECT_THAT(preset({"tears", path("x.glb")}).error, HasSubstr("masses, viscosities, adhesions"));
    EXPECT_THAT(preset({"tear", path("slope.obj"), path("x.glb")}).error, HasSubstr("its own object"));
    EXPECT_THAT(preset({"tear", path("x.glb"), "--object-size", "3cm"}).error, HasSubstr("--object-size needs OBJECT"));
    EXPECT_THAT(preset({"tear"}).error, HasSubstr("OUTPUT"));
    EXPECT_FALSE(std::filesystem::exists(path("x.glb")));
}

TEST_F(FlowCommand, TellsOfFullCoverAndOfTrianglesThatDoNotJoin)
{
    const auto warned = [&](const std::string& object, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"flow", path(object), path("out.glb"), "--time", "40ms"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult run = runDroplet(arguments);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        std::vector<std::string> lines = run.errorLines();
        std::erase_if(lines, [](const std::string& line) { return !line.starts_with("warning: "); });
        return lines;
    };
    EXPECT_THAT(warned("slope.obj", {"--object-size", "2cm", "--drops", "10"}), IsEmpty());
    EXPECT_THAT(warned("slope.obj", {"--object-size", "2cm", "--drops", "100"}),
                ElementsAre(AllOf(HasSubstr("--drops: 100 droplets cover"), HasSubstr("cm2"))));
    EXPECT_THAT(warned("slope.obj", {"--object-size", "2cm", "--drops", "100", "--no-merge"}), IsEmpty());
    // A strip narrower than a droplet.
    testing::writeFile(path("strip.obj"), "v 0 0 0\nv 1 0 0\nv 1 50 -50\nv 0 50 -50\nf 1 2 3 4\n");
    EXPECT_THAT(warned("strip.obj", {"--drops", "3"}),
                ElementsAre(HasSubstr("3 of 3 droplets at the end sit where the object ends")));
    // Two triangles whose common corners differ by rounding.
    testing::writeFile(path("soup.obj"),
                       "v 0 0 0\nv 100 0 0\nv 100 50 -100\nv 0.001 0 0\nv 100.001 50 -100\nv 0 50 -100\n"
                       "f 1 2 3\nf 4 5 6\n");
    EXPECT_THAT(warned("soup.obj", {"--drops", "3"}),
                ElementsAre(AllOf(HasSubstr("soup.obj: 6 of 6 sides of triangles have no neighbour, in 2 parts"),
                                  HasSubstr("merge by distance"))));
}

TEST_F(FlowCommand, MapsHaveTheScaleThatIsChosen)
{
    testing::writeFile(path("uv.obj"), "v 0 0 0\nv 100 80 0\nv 100 80 -100\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n");
    const std::vector<std::string> run{"--drops",     "9",      "--hysteresis", "0.02",          "--film",
                                       "0.1mm",       "--time", "1s",           "--fps",         "2",
                                       "--map-width", "64",     "--maps",       path("m%d.png"), "--map-thickness",
                                       "0.2mm",       "--json", path("r.json")};
    ASSERT_EQ(flow("f%d.obj", run, "uv.obj").exit_code, 0);
    const Picture map = readPicture(path("m2-thickness.png"));
    const Picture wet = readPicture(path("m2-wet.png"));
    const Picture age = readPicture(path("m2-age.png"));
    for (std::size_t k = 0; k < wet.rgb.size(); ++k) {
        EXPECT_TRUE(wet.rgb[k] == 0 || age.rgb[k] < 255) << "no film where nothing ran";
    }
    std::vector<std::string> coarser = run;
    coarser[13] = path("c%d.png");
    coarser[15] = "1mm";
    ASSERT_EQ(flow("f%d.obj", coarser, "uv.obj").exit_code, 0);
    const Picture fifth = readPicture(path("c2-thickness.png"));
    int compared = 0;
    for (std::size_t k = 0; k < map.rgb.size(); ++k) {
        if (map.rgb[k] > 20 && map.rgb[k] < 255) {
            EXPECT_NEAR(fifth.rgb[k], map.rgb[k] / 5.0, 1.0);
            ++compared;
        }
    }
    EXPECT_GT(compared, 20);
    ASSERT_EQ(flow("f%d.obj", run, "uv.obj").exit_code, 0);
    const auto output = nlohmann::json::parse(readFile(path("r.json"))).at("output");
    EXPECT_EQ(output.at("map_thickness_m"), 2e-4);
    EXPECT_EQ(output.at("map_age_s"), 10.0);
    expectRefused({"--drops", "3", "--map-thickness", "1mm"}, 2, "--map-thickness needs --maps");
    expectRefused({"--drops", "3", "--maps", path("m%d.exr"), "--map-thickness", "1mm"}, 2, ".exr has metres");
}

TEST_F(FlowCommand, RefusesWhatItCannotUse)
{
    expectRefused({}, 2, "no droplets are asked for");
    expectRefused({"--rain", "-3mm/h"}, 2, "--rain");
    expectRefused({"--drops", "3", "--volume", "20"}, 2, "--volume");
    expectRefused({"--drops", "3", "--from", "0,0"}, 2, "--from");
    expectRefused({"--drops", "3", "--from", "0,-1,0"}, 3, "--drops");
    for (const std::string spin : {"30deg", "30", "fast/s", "30deg/day", "30mm/s", "1e6rad/s"}) {
        expectRefused({"--drops", "3", "--spin", spin}, 2,
                      "--spin: '" + spin + "' must be an angle per s, min or h, such as 30deg/s");
    }
    for (const std::string emitter : {"0,1,0", "0,1", "5uL/s", "0,1,0,5uL", "0,1,0,5", "a,1,0,5uL/s", "0,1,0,0,5uL/s",
                                      "0,2000,0,5uL/s", "0,1,0,20L/s", "0,1,0,-5uL/s", "0,1,0,5mm/s"}) {
        expectRefused({"--emitter", emitter}, 2,
                      "--emitter: '" + emitter + "' must be X,Y,Z,RATE such as 0,0.1,0,50uL/s");
    }
    expectRefused({"--start", path("no.csv")}, 3, "no.csv");
    expectRefused({"--drops", "3", "--object-size", "20mm", "--volume", "1L"}, 2, "the object");
    expectRefused({"--drops", "3", "--json", path("slope.obj")}, 2, "slope.obj");
    testing::writeFile(path("points.obj"), "v 0 0 0\nv 1 0 0\n");
    expectRefused({"--drops", "3"}, 3, "points.obj", "points.obj");
    testing::writeFile(path("flat.obj"), "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    expectRefused({"--drops", "3"}, 3, "flat.obj", "flat.obj");
    testing::writeFile(path("tiny.obj"), "v 0 0 0\nv 1e-27 0 0\nv 0 1e-27 0\nf 1 2 3\n");
    expectRefused({"--drops", "3"}, 3, "tiny.obj", "tiny.obj");
    testing::writeFile(path("tent.obj"),
                       "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    expectRefused({"--emitter", "0.01,0.01,0.01,5uL/s"}, 2, "inside", "tent.obj");
}

TEST_F(FlowCommand, PointsOfEveryFrameAreThoseOfTheTable)
{
    const std::vector<std::string> scene{"--drops", "7", "--volume-spread", "0.5", "--time", "0.3s", "--fps", "10"};
    const auto with = [&](const std::string& droplets) {
        std::vector<std::string> arguments = scene;
        arguments.insert(arguments.end(), {"--droplets", droplets});
        return flow("out.glb", arguments).exit_code;
    };
    ASSERT_EQ(with(path("rows.csv")), 0);
    ASSERT_EQ(with(path("points/%02d.ply")), 0);
    const auto table = rows("rows.csv");
    const std::string ply = readFile(path("points/02.ply"));
    const std::size_t head = ply.find("end_header\n") + 11;
    std::size_t count = 0;
    for (const std::vector<double>& row : table) {
        if (row[0] != 2.0) {
            continue;
        }
        std::array<float, 18> point{};
        std::memcpy(point.data(), ply.data() + head + 76 * count, 72);
        const std::array<std::pair<std::size_t, std::size_t>, 5> same{{{0, 3}, {1, 4}, {2, 5}, {13, 11}, {15, 9}}};
        for (const auto& [column, of_table] : same) {
            EXPECT_NEAR(static_cast<double>(point[column]), row[of_table], 1e-6 * std::abs(row[of_table])) << column;
        }
        EXPECT_EQ(std::bit_cast<std::uint32_t>(point[17]), static_cast<std::uint32_t>(row[2]));
        ++count;
    }
    EXPECT_EQ(ply.size(), head + 76 * count);
    EXPECT_GT(count, 0U);
    expectRefused({"--drops", "3", "--droplets", path("points.ply")}, 2, "points/%04d.ply");
}

TEST_F(FlowCommand, PointsOverTimeAreThoseOfTheTable)
{
    const auto with = [&](const char* droplets) {
        return flow("out.glb",
                    {"--rain", "2mm/h", "--drops", "7", "--time", "0.5s", "--fps", "10", "--droplets", path(droplets)})
            .exit_code;
    };
    ASSERT_EQ(with("rows.csv"), 0);
    ASSERT_EQ(with("points.usda"), 0);
    const testing::UsdPrim root = testing::UsdaReader(readFile(path("points.usda"))).read();
    EXPECT_EQ(root.metadata.at("timeCodesPerSecond"), "10");
    const testing::UsdPrim& instancer = root.child("droplet").child("droplets");
    const auto& samples = instancer.properties.at("ids").samples;
    ASSERT_EQ(samples.size(), 5U);
    EXPECT_EQ(samples.begin()->first, 0.0) << "frame 1";
    std::map<double, std::vector<std::vector<double>>> frames;
    for (const std::vector<double>& row : rows("rows.csv")) {
        frames[row[0] - 1.0].push_back(row);
    }
    for (const auto& [code, text] : samples) {
        const std::vector<double> ids = testing::numbersIn(text);
        const auto& table = frames[code];
        ASSERT_EQ(ids.size(), table.size()) << code;
        const auto at = [&, time = code](const char* name) {
            return testing::numbersIn(instancer.properties.at(name).samples.at(time));
        };
        const std::vector<double> positions = at("positions");
        const std::vector<double> velocities = at("velocities");
        double sum = 0.0;
        for (std::size_t i = 0; i < ids.size(); ++i) {
            EXPECT_EQ(ids[i], table[i][2]);
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_NEAR(positions.at(3 * i + k), table[i][3 + k], 1e-7);
                EXPECT_NEAR(velocities.at(3 * i + k), table[i][6 + k], 1e-6);
            }
            sum += table[i][9];
        }
        const std::vector<double> volumes = at("primvars:volume");
        EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0) / sum, 1.0, 1e-6);
    }
    EXPECT_GT(frames[4.0].size(), frames[0.0].size()) << "it rains";
    expectRefused({"--drops", "3", "--droplets", path("points/%04d.usda")}, 2, "one file for all frames");
    expectRefused({"--drops", "3", "--droplets", path("points.abc")}, 2, ".usda or .usdz");
}

TEST_F(FlowCommand, StreaksOfEveryFrameGrow)
{
    const CommandResult run = flow("wet.glb", {"--drops", "20", "--volume", "100uL", "--time", "0.5s", "--fps", "10",
                                               "--streaks", path("streaks-%02d.obj")});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    EXPECT_EQ(readFile(path("streaks-01.obj")).find("\nf "), std::string::npos) << "nothing has run";
    const auto area_of = [&](const char* name) {
        const Surface surface = readSurface(path(name)).surface;
        double area = 0.0;
        for (const auto& [a, b, c] : surface.triangles) {
            const Vec3 origin = surface.vertices[a];
            area += 0.5 * length(cross(surface.vertices[b] - origin, surface.vertices[c] - origin));
        }
        return area;
    };
    EXPECT_GT(area_of("streaks-05.obj"), area_of("streaks-03.obj")) << "although they narrow";
    EXPECT_NE(readFile(path("wet.glb")).find("streaks of frames "), std::string::npos);
    EXPECT_EQ(flow("wet.glb", {"--drops", "1", "--streaks", path("a%d%d.obj")}).exit_code, 2);
}

TEST_F(FlowCommand, AnObjectDeformsByAMeshForEveryFrame)
{
    // A slope that moves to +x by 2 cm from frame to frame.
    for (int k = 0; k < 6; ++k) {
        testing::writeFile(path(fmt::format("s{}.obj", k + 7)),
                           fmt::format("v {0} 0 0\nv {1} 0 0\nv {1} 80 -100\nv {0} 80 -100\nf 1 2 3\nf 1 3 4\n", 20 * k,
                                       20 * k + 100));
    }
    const std::vector<std::string> scene{"--drops", "12",         "--fps",     "20", "--film",
                                         "10um",    "--no-merge", "--pinning", "0",  "--droplets"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> all = scene;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    ASSERT_EQ(flow("moved/%d.obj", with({path("moved.csv")}), "s%d.obj").exit_code, 0);
    ASSERT_EQ(flow("rests/%d.obj", with({path("rests.csv"), "--time", "0.3s"}), "s7.obj").exit_code, 0);
    const auto moved = rows("moved.csv");
    const auto rests = rows("rests.csv");
    ASSERT_EQ(moved.size(), rests.size());
    ASSERT_GT(moved.size(), 40U);
    for (std::size_t i = 0; i < moved.size(); ++i) {
        EXPECT_NEAR(moved[i][3] - 0.02 * (moved[i][0] - 1.0), rests[i][3], 1e-9);
        EXPECT_NEAR(moved[i][5], rests[i][5], 1e-9);
        EXPECT_NEAR(moved[i][6] - 0.4, rests[i][6], 1e-6) << "the place changes by the velocity";
        EXPECT_NEAR(moved[i][11], rests[i][11], 1e-9);
        EXPECT_EQ(moved[i][10], rests[i][10]);
    }
    const Surface last = readSurface(path("moved/6.obj")).surface;
    const Surface expected = readSurface(path("rests/6.obj")).surface;
    ASSERT_EQ(last.vertices.size(), expected.vertices.size());
    EXPECT_LT(length(last.vertices.front() - Vec3{0.1, 0.0, 0.0} - expected.vertices.front()), 1e-6);

    std::filesystem::create_directories(path("again/5.png/x"));
    const std::vector<std::string> pictures{"--drops", "12", "--fps", "2", "--preview-size", "64x48"};
    ASSERT_EQ(flow("whole/%d.png", pictures, "s%d.obj").exit_code, 0);
    ASSERT_EQ(flow("again/%d.png", pictures, "s%d.obj").exit_code, 4);
    std::filesystem::remove_all(path("again/5.png"));
    std::vector<std::string> resumed = pictures;
    resumed.emplace_back("--resume");
    ASSERT_EQ(flow("again/%d.png", resumed, "s%d.obj").exit_code, 0);
    for (int k = 1; k <= 6; ++k) {
        EXPECT_EQ(readFile(path(fmt::format("again/{}.png", k))), readFile(path(fmt::format("whole/{}.png", k)))) << k;
    }

    expectRefused({"--drops", "3", "--ground", "Wax:hysteresis=2"}, 2, "droplet-shape: --ground: material is Wax");
    // In an animation the slope moves with its droplets.
    ASSERT_EQ(flow("moved.glb", {"--drops", "3", "--fps", "20"}, "s%d.obj").exit_code, 0);
    const droplet::DeformingObject back = droplet::readAnimatedObject(path("moved.glb"), {20.0, 6});
    ASSERT_EQ(back.vertices.size(), 6U);
    for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_LT(length(back.vertices[k][1] - Vec3{0.1 + 0.02 * static_cast<double>(k), 0.0, 0.0}), 1e-4);
    }
    // And it is an object that deforms again, over a floor that rests.
    const std::vector<std::string> over_floor{"--drops", "3", "--floor", "plate"};
    ASSERT_EQ(flow("floor.glb", over_floor, "moved.glb").exit_code, 0);
    ASSERT_EQ(flow("floor.glb", {"--drops", "3", "--floor", "plate", "--fps", "20"}, "s%d.obj").exit_code, 0);
    const droplet::DeformingObject above = droplet::readAnimatedObject(path("floor.glb"), {20.0, 6});
    ASSERT_EQ(above.vertices.size(), 6U);
    double lowest = 1.0;
    for (const std::vector<Vec3>& shape : back.vertices) {
        for (std::size_t v = 0; v < 4; ++v) {
            lowest = std::min(lowest, shape[v].z);
        }
    }
    std::size_t resting = 0;
    for (std::size_t v = 0; v < above.vertices[0].size(); ++v) {
        const Vec3 p = above.vertices[0][v];
        resting += p.z < lowest && length(above.vertices[5][v] - p) < 1e-6 ? 1 : 0;
    }
    EXPECT_GE(resting, 4U) << "corners of a floor that rests below all shapes";
    ASSERT_EQ(flow("rough/%d.png", {"--drops", "3", "--deformation", "0.2", "--preview-size", "64x48", "--fps", "20"},
                   "s%d.obj")
                  .exit_code,
              0);
    expectRefused({"--drops", "3", "--spin", "30deg/s"}, 2, "--spin turns an object that keeps its shape", "s%d.obj");
    testing::expectOneLine(testing::runInProcess(argumentsOf("s%d.obj", "x.png", {"--drops", "3", "--time", "5s"})), 2,
                           {"--time: 150 frames need as many meshes", "has 6; give at most 0.2 s"});
    std::filesystem::remove(path("s9.obj"));
    testing::expectOneLine(testing::runInProcess(argumentsOf("s%d.obj", "x.png", {"--drops", "3"})), 3,
                           {"s9.obj is missing"});
}

}  // namespace
}  // namespace droplet
