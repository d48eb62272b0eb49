// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape dew`: its files, presets and refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/in_process.h"
#include "droplet/drawing/picture.h"
#include "droplet/io/read_surface.h"
#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using testing::CommandResult;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::readFile;
using testing::runDroplet;

// A square of 4 cm on the ground with uvs, in millimetres.
constexpr const char* kPlate =
    "v 0 0 0\nv 40 0 0\nv 40 0 -40\nv 0 0 -40\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

class DewCommand : public ::testing::Test {
protected:
    DewCommand() { testing::writeFile(path("plate.obj"), kPlate); }

    [[nodiscard]] std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

    [[nodiscard]] CommandResult dew(const std::string& output, const std::vector<std::string>& more = {}) const
    {
        std::vector<std::string> arguments{"dew", path("plate.obj"), path(output)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runDroplet(arguments);
    }

    void expectRefused(const std::string& output, const std::vector<std::string>& more, int exit_code,
                       const std::string& message) const
    {
        const CommandResult result = dew(output, more);
        EXPECT_EQ(result.exit_code, exit_code) << result.error;
        EXPECT_THAT(result.error, HasSubstr(message));
        EXPECT_FALSE(std::filesystem::exists(path(output)));
    }

private:
    testing::ScratchDirectory scratch_;
};

TEST_F(DewCommand, WritesEveryFormat)
{
    for (const char* output : {"a.glb", "a.gltf", "a.usda", "a.usdz", "a.obj", "a.ply", "a.stl"}) {
        const CommandResult result = dew(output, {"--coverage", "0.1"});
        EXPECT_EQ(result.exit_code, 0) << result.error;
        EXPECT_THAT(result.error, HasSubstr("droplets, ")) << output;
        EXPECT_GT(readFile(path(output)).size(), 1000U);
    }
    // Where the object is: droplets lie on y = 0 of the file, between its corners.
    const Surface surface = readSurface(path("a.obj")).surface;
    EXPECT_TRUE(isClosed(surface));
    double low = 1.0;
    for (const Vec3& p : surface.vertices) {
        low = std::min(low, p.z);
        EXPECT_GT(p.x, -2e-3);
        EXPECT_LT(p.x, 42e-3);
    }
    EXPECT_NEAR(low, 0.0, 1e-9);
    EXPECT_NEAR(enclosedVolume(readSurface(path("a.stl")).surface) / enclosedVolume(surface), 1.0, 1e-3);
}

TEST_F(DewCommand, PresetsDiffer)
{
    std::vector<std::string> files;
    for (const char* preset : {"dew", "rain", "bottle", "shower", "mist"}) {
        EXPECT_EQ(dew("one.glb", {"--preset", preset, "--coverage", "0.1", "-q"}).exit_code, 0);
        for (const std::string& other : files) {
            EXPECT_NE(other, readFile(path("one.glb")));
        }
        files.push_back(readFile(path("one.glb")));
    }
    EXPECT_EQ(dew("two.glb", {"--coverage", "0.1", "-q"}).exit_code, 0);
    EXPECT_EQ(readFile(path("two.glb")), files.front()) << "dew is the default";
    EXPECT_EQ(dew("two.glb", {"--coverage", "0.1", "-q", "-j", "1"}).exit_code, 0);
    EXPECT_EQ(readFile(path("two.glb")), files.front()) << "at any number of threads";
}

TEST_F(DewCommand, PreviewsShowDropletsOnTheObjectsOwnColours)
{
    testing::writeFile(path("plate.mtl"), "newmtl red\nKd 0.5 0.02 0.02\n");
    testing::writeFile(path("red.obj"), "mtllib plate.mtl\nusemtl red\n" + std::string(kPlate));
    const auto seen = [&](const std::string& object, std::vector<std::string> more) {
        more.insert(more.begin(), {"dew", path(object), path("a.glb"), "--preview-size", "96x72", "--preview",
                                   path("seen.png"), "--coverage", "0.2", "--smallest", "2mm", "--largest", "3mm"});
        const CommandResult result = runDroplet(more);
        EXPECT_EQ(result.exit_code, 0) << result.error;
        return readPicture(path("seen.png"));
    };
    const Picture red = seen("red.obj", {});
    EXPECT_EQ(red.width, 96);
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < red.rgb.size(); ++i) {
        sum[i % 3] += red.rgb[i];
    }
    EXPECT_GT(sum[0], 1.5 * sum[2]);
    const Picture grey = seen("plate.obj", {});
    EXPECT_NE(grey, red);
    EXPECT_EQ(seen("plate.obj", {"-j", "1"}), grey);
    std::vector<Picture> pictures{grey};
    for (const std::vector<std::string>& change : {std::vector<std::string>{"--view", "top"},
                                                   {"--camera", "-60deg,-30deg"},
                                                   {"--camera", "-60deg,30deg,5cm"},
                                                   {"--look-at", "2cm,0mm,-1cm"},
                                                   {"--material", "ink"},
                                                   {"--environment", path("light.pgm")},
                                                   {"--seed", "2"}}) {
        testing::writeFile(path("light.pgm"), "P5\n2 1\n255\n" + std::string("\xff\x40", 2));
        pictures.push_back(seen("plate.obj", change));
        EXPECT_EQ(std::count(pictures.begin(), pictures.end(), pictures.back()), 1) << change[0] << ' ' << change[1];
    }
    EXPECT_EQ(dew("b.stl",
                  {"--coverage", "0.1", "--preview-size", "32x24", "--preview", path("turn.png"), "--turntable", "2"})
                  .exit_code,
              0);
    EXPECT_NE(readPicture(path("turn-001.png")), readPicture(path("turn-002.png")));
    expectRefused("c.glb", {"--view", "top"}, 2, "--view needs --preview");
    expectRefused("c.glb", {"--turntable", "3"}, 2, "--turntable needs --preview");
    expectRefused("c.glb", {"--preview", path("c.jpg")}, 2, "a file that ends in .png");
    expectRefused("c.glb", {"--preview", path("c.mp4")}, 2, "needs --turntable");
}

TEST_F(DewCommand, TurntableIsAVideo)
{
    EXPECT_EQ(dew("b.stl",
                  {"--coverage", "0.1", "--preview-size", "32x24", "--preview", path("turn.mp4"), "--turntable", "2"})
                  .exit_code,
              0);
    EXPECT_EQ(readFile(path("turn.mp4")).substr(4, 4), "ftyp");
}

TEST_F(DewCommand, DropletsAreWhereTheMaskIs)
{
    testing::writeFile(path("left.pgm"), "P5\n2 1\n255\n" + std::string("\xff\0", 2));
    ASSERT_EQ(dew("left.obj", {"--mask", path("left.pgm"), "-q"}).exit_code, 0);
    for (const Vec3& p : readSurface(path("left.obj")).surface.vertices) {
        EXPECT_LT(p.x, 22e-3);
    }
}

TEST_F(DewCommand, DropletsAreWhereTheWeightsAre)
{
    // Weight 0 on the left, 1 on the right, linear between: none on the left edge, three quarters in the right half.
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\n";
    const std::string end = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const auto sharesOf = [&](const std::string& property, const std::string& one) {
        testing::writeFile(path("w.ply"), head + property + end + "0 0 0 0\n0.04 0 0 " + one + "\n0.04 0.04 0 " + one +
                                              "\n0 0.04 0 0\n4 0 1 2 3\n");
        EXPECT_EQ(runDroplet({"dew", path("w.ply"), path("wet.obj"), "--vertex-weights", "--coverage", "0.1",
                              "--largest", "0.5mm", "--droplets", path("w.csv")})
                      .exit_code,
                  0);
        std::istringstream table(readFile(path("w.csv")));
        std::string line;
        std::getline(table, line);
        std::array<int, 4> quarters{};
        while (std::getline(table, line)) {
            std::istringstream cells(line);
            for (int k = 0; k < 4; ++k) {
                std::getline(cells, line, ',');
            }
            ++quarters.at(static_cast<std::size_t>(std::clamp(std::stod(line) / 0.01, 0.0, 3.0)));
        }
        return quarters;
    };
    const std::array<int, 4> quarters = sharesOf("property float weight\n", "1");
    const double all = quarters[0] + quarters[1] + quarters[2] + quarters[3];
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(quarters.at(k) / all, (2.0 * static_cast<double>(k) + 1.0) / 16.0, 0.06) << k;
    }
    EXPECT_EQ(sharesOf("property uchar red\n", "255"), quarters);
    const CommandResult refused =
        runDroplet({"dew", path("w.ply"), path("x.obj"), "--vertex-weights", "--mask", "m.png"});
    EXPECT_EQ(refused.exit_code, 2);
    testing::writeFile(path("plate.obj"), kPlate);
    expectRefused("x.glb", {"--vertex-weights"}, 2, "--vertex-weights");
}

// A viewer without the extension shows none of so many droplets, so the summary says what to do.
TEST_F(DewCommand, TellsOfInstancesThatNobodyAskedFor)
{
    const auto with = [&](const std::string& output, std::vector<std::string> more) {
        more.insert(more.end(), {"--smallest", "0.06mm", "--largest", "0.1mm", "--coverage", "0.3", "--detail", "low",
                                 "--json", path("dew.json")});
        const CommandResult result = dew(output, more);
        EXPECT_EQ(result.exit_code, 0) << result.error;
        const auto report = nlohmann::json::parse(readFile(path("dew.json")));
        EXPECT_GT(report["droplets"]["count"], 20'000);
        return std::pair(result.error, report["output"]["instancing"]);
    };
    const auto [told, gpu] = with("wet.glb", {});
    EXPECT_EQ(gpu, "gpu");
    EXPECT_THAT(told, HasSubstr("--instancing none writes one mesh"));
    const auto [asked, none] = with("wet.glb", {"--instancing", "none"});
    EXPECT_EQ(none, "none");
    EXPECT_THAT(asked, Not(HasSubstr("--instancing")));
    const auto [mesh, nothing] = with("wet.obj", {});
    EXPECT_TRUE(nothing.is_null());
    EXPECT_THAT(mesh, Not(HasSubstr("--instancing")));
}

// A picture of weights need not look like a footprint, for which dew has no --segment.
TEST_F(DewCommand, TakesAMaskOfAnyLevels)
{
    Picture clouds{64, 64, {}};
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double level = 128.0 + 60.0 * std::sin(0.31 * x + 0.2 * y) + 60.0 * std::sin(0.23 * y - 0.12 * x);
            clouds.rgb.insert(clouds.rgb.end(), 3, static_cast<std::uint8_t>(level));
        }
    }
    std::ostringstream png;
    writePng(clouds, png);
    testing::writeFile(path("clouds.png"), png.str());
    const CommandResult result = dew("wet.obj", {"--mask", path("clouds.png"), "--coverage", "0.05"});
    EXPECT_EQ(result.exit_code, 0) << result.error;
}

TEST_F(DewCommand, ItsTableStartsAFlow)
{
    ASSERT_EQ(dew("wet.glb", {"--droplets", path("drops.csv"), "--coverage", "0.05"}).exit_code, 0);
    const std::string table = readFile(path("drops.csv"));
    const auto rows = static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')) - 1;
    const CommandResult flow = runDroplet({"flow", path("plate.obj"), path("run.glb"), "--start", path("drops.csv"),
                                           "--time", "40ms", "--fps", "25", "--no-merge"});
    EXPECT_EQ(flow.exit_code, 0) << flow.error;
    EXPECT_THAT(flow.error, HasSubstr(std::to_string(rows) + " rest"));
}

TEST_F(DewCommand, ItsReportIsThatOfItsTable)
{
    ASSERT_EQ(
        dew("wet.obj", {"--droplets", path("drops.csv"), "--json", path("dew.json"), "--coverage", "0.05"}).exit_code,
        0);
    const auto report = nlohmann::json::parse(readFile(path("dew.json")));
    std::istringstream table(readFile(path("drops.csv")));
    std::string line;
    std::getline(table, line);
    const auto before = line.substr(0, line.find("volume_m3"));
    const auto column = std::count(before.begin(), before.end(), ',');
    std::size_t count = 0;
    double volume = 0.0;
    while (std::getline(table, line)) {
        std::istringstream cells(line);
        for (auto k = column; k >= 0; --k) {
            std::getline(cells, line, ',');
        }
        volume += std::stod(line);
        ++count;
    }
    const auto& droplets = report["droplets"];
    EXPECT_EQ(droplets["count"], count);
    EXPECT_NEAR(droplets["volume_m3"].get<double>(), volume, 1e-4 * volume) << "the table has few digits";
    EXPECT_NEAR(droplets["covered_m2"].get<double>(), 0.05 * droplets["area_m2"].get<double>(),
                0.005 * droplets["area_m2"].get<double>());
    EXPECT_LT(droplets["smallest_m"], droplets["largest_m"]);
    EXPECT_EQ(report["sizes"]["median_m"], nullptr);
}

TEST_F(DewCommand, ProgressAsJsonHasStagesAndShares)
{
    const CommandResult result = dew("wet.glb", {"--progress", "json"});
    EXPECT_EQ(result.exit_code, 0);
    std::vector<std::string> begun;
    std::vector<std::string> done;
    std::vector<double> shares;
    for (const std::string& line : result.errorLines()) {
        const auto event = nlohmann::json::parse(line);
        if (event.contains("share")) {
            EXPECT_EQ(event["stage"], "solve");
            shares.push_back(event["share"]);
        } else {
            (event["done"].get<bool>() ? done : begun).push_back(event["stage"]);
        }
    }
    EXPECT_THAT(begun, ::testing::ElementsAre("read", "solve", "loft", "write"));
    EXPECT_THAT(done, ::testing::ElementsAre("write"));
    EXPECT_GE(shares.size(), 50U);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_EQ(dew("a.glb", {"-q"}).error, "");
}

TEST_F(DewCommand, WarnsOfLessCoverageWithItsCause)
{
    EXPECT_THAT(dew("a.glb", {"--coverage", "0.7", "--smallest", "0.9mm", "--largest", "1mm"}).error,
                HasSubstr("no room between the others; give a --smallest that is less"));
    EXPECT_THAT(dew("a.glb", {"--smallest", "1mm", "--largest", "4mm", "--gravity-direction", "1,0,0"}).error,
                HasSubstr("run off slopes; give smaller ones, or more --hysteresis"));
}

TEST_F(DewCommand, ReadsAConfiguration)
{
    testing::writeFile(path("dew.toml"), "preset = \"mist\"\ncoverage = 0.05\nquiet = true\n");
    const CommandResult result = dew("mist.glb", {"--config", path("dew.toml")});
    EXPECT_EQ(result.exit_code, 0) << result.error;
    EXPECT_EQ(result.error, "");
}

TEST_F(DewCommand, RefusesWhatCannotBe)
{
    expectRefused("x.dwg", {}, 2, "OUTPUT");
    expectRefused("x.glb", {"--preset", "fog"}, 2, "dew|rain|bottle|shower|mist");
    expectRefused("x.glb", {"--coverage", "0.9"}, 2, "from 0.001 to 0.7");
    expectRefused("x.glb", {"--median", "1mm"}, 2, "--median needs --sizes lognormal");
    expectRefused("x.glb", {"--smallest", "2mm", "--largest", "1mm"}, 2,
                  "--smallest: '2mm' must be at most --largest, 1mm");
    expectRefused("x.glb", {"--preset", "mist", "--smallest", "0.6mm"}, 2,
                  "--smallest: '0.6mm' must be at most --largest, which is 0.5mm by --preset mist");
    expectRefused("x.glb", {"--sizes", "equal"}, 2, "condensation or lognormal");
    expectRefused("x.obj", {"--instancing", "gpu"}, 2, "--instancing needs a .glb");
    expectRefused("x.usda", {"--instancing", "gpu"}, 2, "--instancing gpu needs a .glb or .gltf");
    expectRefused("x.obj", {"--droplets-only"}, 2, "--droplets-only needs a .glb");
    expectRefused("x.obj", {"--compress", "meshopt"}, 2, "--compress");
    expectRefused("x.glb", {"--droplets", path("x.txt")}, 2, ".csv or .json");
    expectRefused("x.glb", {"--smallest", "0.01mm", "--largest", "0.01mm"}, 2, "more than 1000000 droplets");
    expectRefused("x.glb", {"--from", "0,-1,0"}, 3, "plate.obj: the object has no place");
    expectRefused("x.glb", {"--smallest", "15mm", "--largest", "20mm", "--gravity-direction", "1,0,0"}, 3,
                  "plate.obj: no droplet of this size rests on it");
    expectRefused("x.glb", {"--object-size", "1cm", "--scale", "2"}, 2, "--scale");
    expectRefused("x.glb", {"--mask", path("none.png")}, 3, "none.png");
    const CommandResult same = runDroplet({"dew", path("plate.obj"), path("plate.obj")});
    EXPECT_EQ(same.exit_code, 2) << same.error;
    EXPECT_EQ(readFile(path("plate.obj")), kPlate);
}

}  // namespace
}  // namespace droplet
