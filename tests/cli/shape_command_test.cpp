// SPDX-License-Identifier: GPL-3.0-or-later
// The main job from the outside: files, pipes, report, words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using testing::CommandOptions;
using testing::CommandResult;
using testing::discPicture;
using ::testing::ElementsAre;
using testing::greymap;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::readFile;
using testing::runDroplet;
using testing::ScratchDirectory;
using ::testing::SizeIs;
using ::testing::StartsWith;
using testing::writeFile;

/// Two droplets, the left one a ring: liquid bright on dry black.
std::string ringAndDisc()
{
    return greymap(96, 64, [](int x, int y) {
        const double ring = std::hypot(x - 30.0, y - 32.0);
        const double disc = std::hypot(x - 76.0, y - 32.0);
        return (ring < 24.0 && ring > 8.0) || disc < 14.0 ? 255 : 0;
    });
}

class ShapeCommandTest : public ::testing::Test {
protected:
    ShapeCommandTest()
    {
        writeFile(directory() / "disc.pgm", discPicture(64, 24.0));
        writeFile(directory() / "two.pgm", ringAndDisc());
    }

    [[nodiscard]] const fs::path& directory() const { return scratch_.path(); }
    [[nodiscard]] std::string bytesOf(const std::string& name) const { return readFile(directory() / name); }
    [[nodiscard]] const ScratchDirectory& scratch() const { return scratch_; }

    [[nodiscard]] CommandResult run(const std::vector<std::string>& arguments, CommandOptions options = {}) const
    {
        options.directory = directory();
        return runDroplet(arguments, options);
    }

    /// A quiet run that must succeed; few triangles keep it quick.
    void make(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.end(), {"--triangles", "2k", "-q"});
        const auto result = run(arguments);
        ASSERT_EQ(result.exit_code, 0) << result.error;
        EXPECT_THAT(result.error, IsEmpty());
        EXPECT_THAT(result.output, IsEmpty());
    }

    [[nodiscard]] json report(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.end(), {"--json", "report.json"});
        make(arguments);
        return json::parse(bytesOf("report.json"));
    }

private:
    ScratchDirectory scratch_;
};

TEST_F(ShapeCommandTest, WritesEveryFormatByItsExtension)
{
    const std::vector<std::pair<std::string, std::string>> beginnings{
        {"a.glb", "glTF"}, {"a.gltf", "{"}, {"a.ply", "ply\n"}, {"a.OBJ", "#"}};
    for (const auto& [name, beginning] : beginnings) {
        make({"disc.pgm", name});
        EXPECT_THAT(bytesOf(name), StartsWith(beginning)) << name;
    }
    const json stl = report({"disc.pgm", "a.stl"});
    const std::string bytes = bytesOf("a.stl");
    std::uint32_t triangles = 0;
    ASSERT_GT(bytes.size(), 84U);
    std::memcpy(&triangles, bytes.data() + 80, sizeof triangles);
    EXPECT_EQ(bytes.size(), 84 + 50 * std::size_t{triangles});
    EXPECT_EQ(stl["output"]["triangles"], triangles);
}

TEST_F(ShapeCommandTest, FormatGoesBeforeTheExtension)
{
    make({"disc.pgm", "droplet.bin", "--format", "stl"});
    make({"disc.pgm", "droplet.stl"});
    EXPECT_EQ(bytesOf("droplet.bin"), bytesOf("droplet.stl"));
    EXPECT_EQ(report({"disc.pgm", "droplet.glb", "--format", "ply"})["output"]["format"], "ply");
}

TEST_F(ShapeCommandTest, ReadsStandardInputAndWritesStandardOutput)
{
    make({"disc.pgm", "file.glb"});
    CommandOptions options;
    options.input = bytesOf("disc.pgm");
    const auto piped = run({"-", "-", "--format", "glb", "--triangles", "2k"}, options);
    EXPECT_EQ(piped.exit_code, 0);
    EXPECT_EQ(piped.output, bytesOf("file.glb"));
    EXPECT_THAT(piped.error, AllOf(HasSubstr("written"), Not(HasSubstr("glTF"))));
}

TEST_F(ShapeCommandTest, StandardOutputThatIsAFileIsWrittenNotReplaced)
{
    make({"disc.pgm", "file.stl"});
    CommandOptions options;
    options.output_file = directory() / "redirected.stl";
    EXPECT_EQ(run({"disc.pgm", "-", "--format", "stl", "--triangles", "2k", "-q"}, options).exit_code, 0);
    EXPECT_EQ(bytesOf("redirected.stl"), bytesOf("file.stl"));
}

TEST_F(ShapeCommandTest, ReportOnStandardOutputIsNothingButJson)
{
    const auto result = run({"disc.pgm", "droplet.glb", "--triangles", "2k", "--json", "-"});
    EXPECT_EQ(result.exit_code, 0);
    const json report = json::parse(result.output);
    EXPECT_EQ(report["output"]["bytes"], fs::file_size(directory() / "droplet.glb"));
}

TEST_F(ShapeCommandTest, ReportTellsWhatWasReadAndWritten)
{
    const json report = this->report({"two.pgm", "two.glb", "--width", "9.6mm", "--volume", "2uL"});
    EXPECT_EQ(report["input"]["path"], "two.pgm");
    EXPECT_EQ(report["input"]["width_px"], 96);
    EXPECT_EQ(report["input"]["height_px"], 64);
    EXPECT_NEAR(report["input"]["pixel_size_m"], 1e-4, 1e-18);
    EXPECT_EQ(report["input"]["channel"], "luma");
    EXPECT_EQ(report["input"]["inverted"], false);
    EXPECT_EQ(report["input"]["anti_aliased"], false);
    EXPECT_EQ(report["output"]["path"], "two.glb");
    EXPECT_EQ(report["output"]["format"], "glb");
    EXPECT_EQ(report["output"]["bytes"], fs::file_size(directory() / "two.glb"));
    EXPECT_EQ(report["output"]["closed"], true);
    // A ball has Euler number 2, a closed ring of liquid 0.
    EXPECT_EQ(report["output"]["euler"], 2);
    EXPECT_EQ(report["output"]["components"], 2);
    EXPECT_EQ(report["mesh"]["droplets"], 2);
    EXPECT_EQ(report["mesh"]["holes"], 1);
    // The base has few triangles, but one at least for every vertex of the rim that it joins.
    EXPECT_GT(report["output"]["triangles"], report["mesh"]["triangles"].get<int>());
    EXPECT_LT(report["output"]["triangles"], 2 * report["mesh"]["triangles"].get<int>());
    EXPECT_EQ(report["solve"]["converged"], true);
    EXPECT_GT(report["peak_memory_bytes"], 1'000'000);
}

TEST_F(ShapeCommandTest, RowsOfDropletsAddUpToTheShape)
{
    const json report = this->report({"two.pgm", "two.glb", "--volume", "2uL"});
    ASSERT_THAT(report["droplets"], SizeIs(2));
    EXPECT_TRUE(report["shape"]["pressure_pa"].is_null());
    double volume = 0.0;
    double area = 0.0;
    for (const json& droplet : report["droplets"]) {
        EXPECT_NEAR(droplet["volume_m3"], 2e-9, 2e-19);
        EXPECT_GT(droplet["pressure_pa"], 0.0);
        volume += droplet["volume_m3"].get<double>();
        area += droplet["footprint_area_m2"].get<double>();
    }
    EXPECT_NEAR(report["shape"]["volume_m3"], volume, 1e-12 * volume);
    EXPECT_NEAR(report["mesh"]["footprint_area_m2"], area, 1e-12 * area);
    // Every bright pixel of the picture, which is 96 pixels and 20 mm wide.
    const std::string picture = bytesOf("two.pgm");
    const auto bright = std::count(picture.begin(), picture.end(), '\xff');
    const double pixel = 20e-3 / 96;
    EXPECT_NEAR(area, static_cast<double>(bright) * pixel * pixel, 0.005 * area);
}

TEST_F(ShapeCommandTest, OneReservoirHasOnePressureAndTheVolumeInTotal)
{
    const json report = this->report({"two.pgm", "two.glb", "--volume", "2uL", "--fill", "total"});
    EXPECT_EQ(report["fill"]["sharing"], "total");
    EXPECT_NEAR(report["shape"]["volume_m3"], 2e-9, 2e-19);
    for (const json& droplet : report["droplets"]) {
        EXPECT_EQ(droplet["pressure_pa"], report["shape"]["pressure_pa"]);
    }
}

TEST_F(ShapeCommandTest, EveryWayToFillIsMet)
{
    EXPECT_NEAR(report({"disc.pgm", "a.glb"})["shape"]["contact_angle_deg"]["mean"], 40.0, 1e-6);
    EXPECT_NEAR(report({"disc.pgm", "a.glb", "--contact-angle", "0.5rad"})["shape"]["contact_angle_deg"]["mean"],
                0.5 * 180 / std::numbers::pi, 1e-6);
    EXPECT_NEAR(report({"disc.pgm", "a.glb", "--height", "1.25mm"})["shape"]["height_max_m"], 1.25e-3, 1e-12);
    EXPECT_NEAR(report({"disc.pgm", "a.glb", "--volume", "30uL"})["shape"]["volume_m3"], 30e-9, 30e-19);
}

TEST_F(ShapeCommandTest, PhysicsIsAsAskedFor)
{
    const json liquid = report({"disc.pgm", "a.glb", "--liquid", "mercury", "--gravity", "1.62m/s2"})["liquid"];
    EXPECT_EQ(liquid["name"], "mercury");
    EXPECT_EQ(liquid["surface_tension_n_per_m"], 0.4865);
    EXPECT_EQ(liquid["density_kg_per_m3"], 13545.9);
    EXPECT_EQ(liquid["gravity_m_per_s2"], 1.62);

    const json custom = report({"disc.pgm", "a.glb", "--surface-tension", "30mN/m", "--density", "0.9g/cm3"})["liquid"];
    EXPECT_EQ(custom["name"], "custom");
    EXPECT_EQ(custom["surface_tension_n_per_m"], 0.03);
    EXPECT_EQ(custom["density_kg_per_m3"], 900.0);
    EXPECT_EQ(custom["gravity_m_per_s2"], 9.81);

    const json thinned = report({"disc.pgm", "a.glb", "--liquid", "honey", "--density", "1.3g/mL"})["liquid"];
    EXPECT_EQ(thinned["name"], "honey");
    EXPECT_EQ(thinned["surface_tension_n_per_m"], 0.055);
    EXPECT_EQ(thinned["density_kg_per_m3"], 1300.0);

    const json weightless = report({"disc.pgm", "a.glb", "--gravity", "0m/s2"});
    EXPECT_EQ(weightless["shape"]["gravity_energy_j"], 0.0);
}

TEST_F(ShapeCommandTest, FootprintOptionsReachTheOutline)
{
    const double area = report({"disc.pgm", "a.glb"})["mesh"]["footprint_area_m2"];
    EXPECT_NEAR(report({"disc.pgm", "a.glb", "--width", "4cm"})["mesh"]["footprint_area_m2"], 4 * area, 1e-9 * area);
    EXPECT_NEAR(report({"disc.pgm", "a.glb", "--pixel-size", "312.5um"})["mesh"]["footprint_area_m2"], area,
                1e-9 * area);

    const json inverted = report({"disc.pgm", "a.glb", "--invert"});
    EXPECT_EQ(inverted["input"]["inverted"], true);
    EXPECT_NEAR(inverted["mesh"]["footprint_area_m2"], 400e-6 - area, 0.01 * area);
    EXPECT_EQ(inverted["mesh"]["holes"], 1);

    const json dropped = report({"two.pgm", "a.glb", "--speck-size", "700"});
    EXPECT_EQ(dropped["mesh"]["droplets"], 1);
    EXPECT_EQ(dropped["input"]["specks_dropped"], 2);  // the disc, and the hole of the ring

    writeFile(directory() / "grey.pgm", greymap(64, 64, [](int x, int y) {
                  const double r = std::hypot(x - 31.5, y - 31.5);
                  return static_cast<int>(255 * std::min(1.0, std::max(0.0, (28.0 - r) / 16.0)));
              }));
    const double low = report({"grey.pgm", "a.glb", "--threshold", "0.25"})["mesh"]["footprint_area_m2"];
    const double high = report({"grey.pgm", "a.glb", "--threshold", "0.75"})["mesh"]["footprint_area_m2"];
    EXPECT_NEAR(low / high, (24.0 * 24.0) / (16.0 * 16.0), 0.02);
    EXPECT_EQ(report({"grey.pgm", "a.glb"})["input"]["anti_aliased"], true);
    EXPECT_EQ(report({"grey.pgm", "a.glb", "--channel", "luma"})["input"]["channel"], "luma");
}

TEST_F(ShapeCommandTest, ResolutionAndOpenness)
{
    const auto triangles = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"disc.pgm", "a.glb", "-q", "--json", "report.json"});
        EXPECT_EQ(run(options).exit_code, 0);
        return json::parse(bytesOf("report.json"))["mesh"]["triangles"].get<double>();
    };
    EXPECT_NEAR(triangles({"--triangles", "5000"}), 5000, 500);
    EXPECT_NEAR(triangles({"--triangles", "0.02M"}), 20000, 2000);
    EXPECT_EQ(triangles({"--triangles", "5k"}), triangles({"--triangles", "5000"}));
    // An equilateral triangle of edge e covers √3/4 e².
    const double area = json::parse(bytesOf("report.json"))["mesh"]["footprint_area_m2"];
    EXPECT_NEAR(triangles({"--edge", "0.25mm"}), area / (std::sqrt(3.0) / 4 * 0.25e-3 * 0.25e-3),
                0.15 * area / (std::sqrt(3.0) / 4 * 0.25e-3 * 0.25e-3));

    const json open = report({"disc.pgm", "a.glb", "--open"});
    EXPECT_EQ(open["output"]["closed"], false);
    EXPECT_EQ(open["output"]["triangles"], open["mesh"]["triangles"]);
    EXPECT_EQ(open["output"]["vertices"], open["mesh"]["vertices"]);
}

TEST_F(ShapeCommandTest, ReportedVerticesAreThoseOfTheFile)
{
    const json ply = report({"two.pgm", "a.ply"});
    EXPECT_THAT(bytesOf("a.ply"),
                HasSubstr("element vertex " + std::to_string(ply["output"]["vertices"].get<int>()) + "\n"));
    EXPECT_THAT(bytesOf("a.ply"),
                HasSubstr("element face " + std::to_string(ply["output"]["triangles"].get<int>()) + "\n"));

    const json gltf = report({"two.pgm", "a.gltf"});
    const json file = json::parse(bytesOf("a.gltf"));
    const auto position = file["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>();
    EXPECT_EQ(file["accessors"][position]["count"], gltf["output"]["vertices"]);
}

TEST_F(ShapeCommandTest, MaterialChangesTheFileAndIsSaidToBeOfNoUseInStl)
{
    make({"disc.pgm", "water.glb"});
    make({"disc.pgm", "ink.glb", "--material", "ink"});
    EXPECT_NE(bytesOf("water.glb"), bytesOf("ink.glb"));

    const auto stl = run({"disc.pgm", "a.stl", "--material", "ink", "--triangles", "2k", "--json", "report.json"});
    EXPECT_EQ(stl.exit_code, 0);
    EXPECT_THAT(stl.error, HasSubstr("warning: --material ink has no effect"));
    EXPECT_THAT(json::parse(bytesOf("report.json"))["warnings"].dump(), HasSubstr("--material ink has no effect"));
}

TEST_F(ShapeCommandTest, GivesTheSameBytesAtAnyNumberOfThreads)
{
    for (const char* format : {"glb", "gltf", "obj", "ply", "stl"}) {
        make({"two.pgm", "one", "--format", format, "-j", "1"});
        make({"two.pgm", "other", "--format", format, "-j", "2"});
        make({"two.pgm", "again", "--format", format});
        EXPECT_EQ(bytesOf("one"), bytesOf("other")) << format;
        EXPECT_EQ(bytesOf("one"), bytesOf("again")) << format;
    }
}

/// A report without what no two runs share.
json comparable(json report)
{
    report.erase("time_s");
    report.erase("peak_memory_bytes");
    return report;
}

TEST_F(ShapeCommandTest, ReportsAreTheSameButForTimeAndMemory)
{
    const json first = report({"two.pgm", "a.glb"});
    EXPECT_EQ(comparable(first), comparable(report({"two.pgm", "a.glb"})));
}

TEST_F(ShapeCommandTest, ConfigurationFileMeansTheSameAsOptions)
{
    writeFile(directory() / "settings.toml",
              "# A comment, and an empty line\n\n"
              "width = \"9.6mm\"        # another\r\n"
              "volume='2uL'\n"
              "fill = \"total\"\n"
              "threshold = 0.4\n"
              "speck-size = 5\n"
              "invert = false\n"
              "open = true\n"
              "liquid = \"honey\"\n");
    const json by_file = report({"two.pgm", "file.glb", "--config", "settings.toml"});
    const json by_options = report({"two.pgm", "options.glb", "--width", "9.6mm", "--volume", "2uL", "--fill", "total",
                                    "--threshold", "0.4", "--speck-size", "5", "--open", "--liquid", "honey"});
    EXPECT_EQ(bytesOf("file.glb"), bytesOf("options.glb"));
    EXPECT_EQ(by_file["liquid"], by_options["liquid"]);
    EXPECT_EQ(by_file["shape"], by_options["shape"]);
}

TEST_F(ShapeCommandTest, CommandLineGoesBeforeTheConfigurationFile)
{
    writeFile(directory() / "settings.toml", "width = \"9.6mm\"\nvolume = \"2uL\"\nopen = true\nverbose = true\n");
    // A height on the command line also settles what the file says of volume.
    const json report =
        this->report({"two.pgm", "a.glb", "--config", "settings.toml", "--height", "1mm", "--open=false"});
    EXPECT_EQ(report["fill"]["by"], "height_m");
    EXPECT_NEAR(report["input"]["pixel_size_m"], 1e-4, 1e-18);
    EXPECT_EQ(report["output"]["closed"], true);
}

TEST_F(ShapeCommandTest, ConfigurationStringsMayHoldAnything)
{
    writeFile(directory() / "settings.toml", "json = \"a#b, \\\"c\\\".json\"\nquiet = true\ntriangles = 2000\n");
    EXPECT_EQ(run({"disc.pgm", "a.glb", "--config", "settings.toml"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(directory() / "a#b, \"c\".json"));
}

TEST_F(ShapeCommandTest, ReplacesOlderFilesWholeAndLeavesNothingElse)
{
    writeFile(directory() / "a.glb", std::string(1'000'000, 'x'));
    writeFile(directory() / "report.json", std::string(1'000'000, 'x'));
    const json report = this->report({"disc.pgm", "a.glb"});
    EXPECT_EQ(fs::file_size(directory() / "a.glb"), report["output"]["bytes"]);
    EXPECT_THAT(scratch().names(), ElementsAre("a.glb", "disc.pgm", "report.json", "two.pgm"));
}

TEST_F(ShapeCommandTest, NoClobberWritesWhereNothingStands)
{
    make({"disc.pgm", "a.glb", "--no-clobber", "--json", "a.json"});
    EXPECT_TRUE(fs::exists(directory() / "a.glb"));
    EXPECT_TRUE(fs::exists(directory() / "a.json"));
}

TEST_F(ShapeCommandTest, SummaryTellsWhatMatters)
{
    const auto result = run({"two.pgm", "two.glb", "--triangles", "2k", "--volume", "2uL", "--speck-size", "250"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, IsEmpty());
    for (const char* words :
         {"96 × 64 pixels", "bright is liquid (luma)", "hard edges", "1 speck dropped", "2 droplets, 0 holes", "mm²",
          "4 µL", "mm high", "contact angle", "smallest angle", "two.glb:", "kB", "closed"}) {
        EXPECT_THAT(result.error, HasSubstr(words));
    }
    EXPECT_THAT(result.error, Not(HasSubstr("memory")));
    EXPECT_THAT(result.error, Not(HasSubstr("\033"))) << "colours are for terminals";
}

TEST_F(ShapeCommandTest, VerboseAddsDropletsTimesAndMemory)
{
    const auto result = run({"two.pgm", "two.glb", "--triangles", "2k", "-v"});
    for (const char* words : {"72.8 mN/m", "simplicial", "pressure/Pa", "time ", "triangulate", "memory"}) {
        EXPECT_THAT(result.error, HasSubstr(words));
    }
    EXPECT_THAT(result.error, Not(HasSubstr("more, all in")));

    writeFile(directory() / "many.pgm",
              greymap(120, 120, [](int x, int y) { return x % 12 > 2 && y % 12 > 2 ? 255 : 0; }));
    EXPECT_THAT(run({"many.pgm", "many.glb", "-v", "--triangles", "20k"}).error,
                AllOf(HasSubstr("100 droplets"), HasSubstr("and 80 more")));
}

TEST_F(ShapeCommandTest, WarnsOfSlopesBeyondTheModel)
{
    const auto steep = run({"disc.pgm", "a.glb", "--contact-angle", "75deg", "--triangles", "2k"});
    EXPECT_EQ(steep.exit_code, 0);
    EXPECT_THAT(steep.error, HasSubstr("warning: "));
    EXPECT_THAT(run({"disc.pgm", "a.glb", "--contact-angle", "75deg", "--triangles", "2k", "-q"}).error, IsEmpty());
}

TEST_F(ShapeCommandTest, ProgressAsJsonIsOneObjectPerLine)
{
    const auto result =
        run({"disc.pgm", "a.stl", "--triangles", "2k", "--progress", "json", "--material", "ink", "-v"});
    EXPECT_EQ(result.exit_code, 0);
    std::vector<std::string> begun;
    std::vector<std::string> done;
    std::vector<std::string> warnings;
    double last = 0.0;
    for (const std::string& line : result.errorLines()) {
        const json event = json::parse(line);
        if (event.contains("warning")) {
            warnings.push_back(event["warning"]);
            continue;
        }
        EXPECT_GE(event["elapsed_s"].get<double>(), last);
        last = event["elapsed_s"];
        (event["done"].get<bool>() ? done : begun).push_back(event["stage"]);
    }
    EXPECT_THAT(begun, ElementsAre("read", "trace", "triangulate", "assemble", "solve", "loft", "write"));
    EXPECT_THAT(done, ElementsAre("write"));
    EXPECT_THAT(warnings, SizeIs(1));
}

TEST_F(ShapeCommandTest, ProgressThatFailsIsNeverDone)
{
    const auto result = run({"missing.pgm", "a.glb", "--progress", "json"});
    EXPECT_EQ(result.exit_code, 3);
    ASSERT_THAT(result.errorLines(), SizeIs(2));
    EXPECT_EQ(json::parse(result.errorLines()[0])["stage"], "read");
    EXPECT_THAT(result.errorLines()[1], StartsWith("droplet-shape: "));
}

TEST_F(ShapeCommandTest, BarShowsOnATerminalWhenARunIsSlowAndGoesAway)
{
    CommandOptions options;
    options.error_is_terminal = true;
    options.input = bytesOf("disc.pgm");
    options.input_waits_for = "[....";  // the picture comes only when the bar has been seen
    const auto result = run({"-", "a.glb", "--triangles", "2k"}, options);
    EXPECT_EQ(result.exit_code, 0) << result.error;
    const auto bar = result.error.rfind("[....");
    ASSERT_NE(bar, std::string::npos);
    EXPECT_THAT(result.error.substr(bar), HasSubstr("read"));
    const auto erased = result.error.rfind("\r\033[K");
    ASSERT_NE(erased, std::string::npos);
    EXPECT_GT(erased, bar);
    EXPECT_THAT(result.error.substr(erased), HasSubstr("written"));
}

TEST_F(ShapeCommandTest, BarIsErasedBeforeAnError)
{
    CommandOptions options;
    options.error_is_terminal = true;
    options.input = "no picture";
    options.input_waits_for = "[....";
    options.environment = {{"NO_COLOR", "1"}};
    const auto result = run({"-", "a.glb"}, options);
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.error.substr(result.error.rfind('[')), StartsWith("[Kdroplet-shape: standard input"));
}

TEST_F(ShapeCommandTest, ColoursOnATerminalUnlessToldOtherwise)
{
    CommandOptions options;
    options.error_is_terminal = true;
    const std::vector<std::string> arguments{"disc.pgm", "a.glb", "--triangles", "2k", "--progress", "none"};
    EXPECT_THAT(run(arguments, options).error, HasSubstr("\033[1mwritten\033[0m"));
    options.environment = {{"NO_COLOR", ""}};
    EXPECT_THAT(run(arguments, options).error, HasSubstr("\033[1mwritten\033[0m"));
    options.environment = {{"NO_COLOR", "1"}};
    EXPECT_THAT(run(arguments, options).error, AllOf(HasSubstr("written"), Not(HasSubstr("\033"))));
    options.environment = {{"TERM", "dumb"}};
    EXPECT_THAT(run(arguments, options).error, AllOf(HasSubstr("written"), Not(HasSubstr("\033"))));
}

TEST_F(ShapeCommandTest, NamesThatLookLikeOptionsStandBehindTwoDashes)
{
    writeFile(directory() / "-in.pgm", discPicture(64, 24.0));
    make({"--json=r.json", "./-in.pgm", "a.glb"});
    EXPECT_EQ(run({"-q", "--", "-in.pgm", "-out.glb"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(directory() / "-out.glb"));
}

}  // namespace
}  // namespace droplet
