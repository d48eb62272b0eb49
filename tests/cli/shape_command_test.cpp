// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape` without a command: files, pipes, report, summary.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/image/height_map.h"
#include "support/command.h"
#include "support/gltf_draft.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using testing::CommandOptions;
using testing::CommandResult;
using testing::discPicture;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using testing::greymap;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::readFile;
using testing::runDroplet;
using testing::ScratchDirectory;
using ::testing::SizeIs;
using ::testing::StartsWith;
using testing::writeFile;

/// Two droplets, bright on black; the left one is a ring.
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

    /// Runs quietly with few triangles, and expects success.
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

TEST_F(ShapeCommandTest, FormatOverridesTheExtension)
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

TEST_F(ShapeCommandTest, WritesIntoAFileThatIsStandardOutput)
{
    make({"disc.pgm", "file.stl"});
    CommandOptions options;
    options.output_file = directory() / "redirected.stl";
    EXPECT_EQ(run({"disc.pgm", "-", "--format", "stl", "--triangles", "2k", "-q"}, options).exit_code, 0);
    EXPECT_EQ(bytesOf("redirected.stl"), bytesOf("file.stl"));
}

TEST_F(ShapeCommandTest, StandardOutputContainsOnlyTheReport)
{
    const auto result = run({"disc.pgm", "droplet.glb", "--triangles", "2k", "--json", "-"});
    EXPECT_EQ(result.exit_code, 0);
    const json report = json::parse(result.output);
    EXPECT_EQ(report["output"]["bytes"], fs::file_size(directory() / "droplet.glb"));
}

TEST_F(ShapeCommandTest, ReportDescribesInputAndOutput)
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
    // The base has few triangles, but at least one for every vertex of the rim.
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
    // The area is that of all bright pixels; the picture is 96 pixels and 20 mm wide.
    const std::string picture = bytesOf("two.pgm");
    const auto bright = std::count(picture.begin(), picture.end(), '\xff');
    const double pixel = 20e-3 / 96;
    EXPECT_NEAR(area, static_cast<double>(bright) * pixel * pixel, 0.005 * area);
}

TEST_F(ShapeCommandTest, TotalFillHasOnePressureAndTheGivenTotalVolume)
{
    const json report = this->report({"two.pgm", "two.glb", "--volume", "2uL", "--fill", "total"});
    EXPECT_EQ(report["fill"]["sharing"], "total");
    EXPECT_NEAR(report["shape"]["volume_m3"], 2e-9, 2e-19);
    for (const json& droplet : report["droplets"]) {
        EXPECT_EQ(droplet["pressure_pa"], report["shape"]["pressure_pa"]);
    }
}

TEST_F(ShapeCommandTest, MeetsEveryKindOfFill)
{
    EXPECT_NEAR(report({"disc.pgm", "a.glb"})["shape"]["contact_angle_deg"]["mean"], 40.0, 1e-6);
    EXPECT_NEAR(report({"disc.pgm", "a.glb", "--contact-angle", "0.5rad"})["shape"]["contact_angle_deg"]["mean"],
                0.5 * 180 / std::numbers::pi, 1e-6);
    EXPECT_NEAR(report({"disc.pgm", "a.glb", "--height", "1.25mm"})["shape"]["height_max_m"], 1.25e-3, 1e-12);
    EXPECT_NEAR(report({"disc.pgm", "a.glb", "--volume", "30uL"})["shape"]["volume_m3"], 30e-9, 30e-19);
}

TEST_F(ShapeCommandTest, LiquidAndGravityAreThoseGiven)
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

TEST_F(ShapeCommandTest, TheDefaultModelIsLinearOnlyWhereThatIsRight)
{
    const json flat = report({"disc.pgm", "a.glb", "--contact-angle", "3deg"});
    EXPECT_EQ(flat["model"], "linear");
    EXPECT_EQ(flat["solve"]["newton_steps"], 1);
    make({"disc.pgm", "b.glb", "--contact-angle", "3deg", "--model", "linear", "--gravity", "9.81m/s2"});
    EXPECT_EQ(bytesOf("a.glb"), bytesOf("b.glb"));
    EXPECT_EQ(report({"disc.pgm", "a.glb"})["model"], "exact");
    const json bead = report({"disc.pgm", "a.glb", "--contact-angle", "120deg"});
    EXPECT_EQ(bead["model"], "parametric");
    EXPECT_GT(bead["shape"]["overhang_m"], 1e-4);
}

TEST_F(ShapeCommandTest, TakesTheAngleThatALiquidHasByItself)
{
    const auto angle = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"disc.pgm", "a.glb", "--contact-angle", "natural"});
        return report(options)["shape"]["contact_angle_deg"]["mean"].get<double>();
    };
    EXPECT_NEAR(angle({}), 20.0, 1e-4);
    EXPECT_NEAR(angle({"--on", "ptfe"}), 110.0, 1e-4);
    EXPECT_NEAR(angle({"--liquid", "mercury", "--width", "4mm"}), 140.0, 1e-4);
    for (const char* triangles : {"1000", "4000", "12000"}) {
        const auto made = run({"disc.pgm", "a.glb", "--contact-angle", "natural", "--liquid", "mercury", "--width",
                               "4mm", "--triangles", triangles});
        EXPECT_EQ(made.exit_code, 0);
        EXPECT_THAT(made.output + made.error, HasSubstr("contact angle 140.0°")) << triangles;
    }
    const auto refused = run({"disc.pgm", "b.glb", "--contact-angle", "natural", "--liquid", "ethanol"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.error, HasSubstr("ethanol on glass spreads"));
    EXPECT_EQ(run({"disc.pgm", "b.glb", "--contact-angle", "natural", "--liquid", "honey"}).exit_code, 2);
    EXPECT_THAT(run({"disc.pgm", "b.glb", "--on", "wax"}).error, HasSubstr("--on has no effect"));
}

TEST_F(ShapeCommandTest, ExactModelMakesACap)
{
    const json report =
        this->report({"disc.pgm", "a.glb", "--model", "exact", "--gravity", "0m/s2", "--contact-angle", "60deg"});
    EXPECT_EQ(report["model"], "exact");
    EXPECT_GT(report["solve"]["newton_steps"], 1);
    // A cap has height R tan(θ/2) and pressure 2σ sin θ / R; the disc of pixels is round within 1 %.
    const double radius = std::sqrt(report["mesh"]["footprint_area_m2"].get<double>() / std::numbers::pi);
    EXPECT_NEAR(report["shape"]["height_max_m"], radius / std::sqrt(3.0), 0.01 * radius);
    EXPECT_NEAR(report["shape"]["pressure_pa"], std::sqrt(3.0) * 0.0728 / radius, 0.02 * 0.0728 / radius);
    EXPECT_TRUE(report["liquid"]["capillary_length_m"].is_null());
    EXPECT_EQ(report["shape"]["bond_number"], 0.0);
}

TEST_F(ShapeCommandTest, DerivedFiguresAgreeWithEachOther)
{
    const json report = this->report({"disc.pgm", "a.glb"});
    const json& shape = report["shape"];
    const double area = report["mesh"]["footprint_area_m2"];
    EXPECT_NEAR(shape["volume_ul"], shape["volume_m3"].get<double>() * 1e9, 1e-12 * shape["volume_ul"].get<double>());
    EXPECT_EQ(shape["energy_j"], shape["surface_energy_j"].get<double>() + shape["gravity_energy_j"].get<double>());
    EXPECT_NEAR(report["liquid"]["capillary_length_m"], 2.727e-3, 1e-6);
    const double bond = 998.2 * 9.81 * area / (std::numbers::pi * 0.0728);
    EXPECT_NEAR(shape["bond_number"], bond, 1e-9 * bond);
    EXPECT_EQ(shape["dry_area_m2"], 0.0);
    EXPECT_EQ(shape["depth_max_m"], 0.0);
    EXPECT_TRUE(shape["would_slide"].is_null());
}

TEST_F(ShapeCommandTest, MapsOfOpenExrHaveMetres)
{
    const json made = report({"disc.pgm", "a.glb", "--volume", "100uL", "--map-width", "300", "--maps", "m.exr"});
    EXPECT_TRUE(made["output"]["map_thickness_m"].is_null());
    const double pixel = made["input"]["width_px"].get<double>() * made["input"]["pixel_size_m"].get<double>() / 300.0;
    const std::vector<float> levels = droplet::readHeightMap(directory() / "m-thickness.exr").levels;
    EXPECT_NEAR(std::accumulate(levels.begin(), levels.end(), 0.0) * pixel * pixel, 100e-9, 0.1e-9);
    EXPECT_THAT(bytesOf("m-normal.exr"), StartsWith("v/1\x01"));
}

TEST_F(ShapeCommandTest, MapsShowTheDroplet)
{
    const std::vector<std::string> options{"disc.pgm", "a.glb", "--volume", "100uL", "--map-width", "300", "--maps"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), options.begin(), options.end());
        return report(more);
    };
    const json made = with({"m.png"});
    const double white = made["output"]["map_thickness_m"].get<double>();
    EXPECT_NEAR(white, made["shape"]["height_max_m"].get<double>(), 1e-6);
    const double pixel = made["input"]["width_px"].get<double>() * made["input"]["pixel_size_m"].get<double>() / 300.0;
    const auto sum = [&](const char* name) {
        const droplet::HeightMap map = droplet::readHeightMap(directory() / name);
        EXPECT_EQ(map.width, 300) << name;
        double total = 0.0;
        for (const float level : map.levels) {
            total += level;
        }
        return total * pixel * pixel;
    };
    EXPECT_NEAR(sum("m-thickness.png") * white, 100e-9, 0.1e-9);
    EXPECT_NEAR(sum("m-wetness.png") / made["mesh"]["footprint_area_m2"].get<double>(), 1.0, 2e-3);
    EXPECT_NEAR(sum("m-coverage.png"), sum("m-wetness.png"), 1e-9);
    EXPECT_NEAR(sum("m-height.png"), sum("m-thickness.png"), 1e-12);
    EXPECT_GT(sum("m-occlusion.png"), 0.9 * 300 * 300 * pixel * pixel);
    EXPECT_EQ(with({"m.png", "--map-thickness", "5mm"})["output"]["map_thickness_m"], 5e-3);
    EXPECT_NEAR(sum("m-thickness.png") * 5e-3, 100e-9, 0.1e-9);

    EXPECT_THAT(with({"m.png"})["output"]["maps"], SizeIs(6));
    EXPECT_TRUE(report({"disc.pgm", "a.glb"})["output"]["maps"].empty());
    EXPECT_THAT(run({"disc.pgm", "a.glb", "--triangles", "2k", "--map-width", "64", "--maps", "n.png"}).error,
                HasSubstr("maps       n-height.png, n-normal.png, n-thickness.png, n-coverage.png, n-wetness.png, "
                          "n-occlusion.png; white is "));

    // Its folder is made, but not by a run that is refused.
    EXPECT_EQ(run({"disc.pgm", "a.glb", "--maps", "new/m.png", "--json", "a.glb"}).exit_code, 2);
    EXPECT_FALSE(fs::exists(directory() / "new"));
    make({"disc.pgm", "a.glb", "--map-width", "32", "--maps", "new/m.png"});
    EXPECT_TRUE(fs::exists(directory() / "new/m-occlusion.png"));

    // On a sphere the ground falls away, and is black where it is lowest.
    const json on_ball = with({"b.png", "--surface", "sphere:R=2cm"});
    EXPECT_GT(on_ball["output"]["map_thickness_m"].get<double>(), 1.5 * white);
    EXPECT_GT(sum("b-height.png"), 0.3 * 300 * 300 * pixel * pixel);

    // Discs at both edges meet in the tile, but each falls to the ground at its own edge: a groove as deep as they are.
    writeFile(directory() / "cut.pgm", greymap(64, 64, [](int x, int y) {
                  return std::hypot(std::min(x + 0.5, 63.5 - x), y - 31.5) < 20.0 ? 255 : 0;
              }));
    const json cut = with({"t.png", "--map-tile"});
    EXPECT_THAT(cut["warnings"], IsEmpty()) << "the disc does not reach the edge";
    const json seam =
        report({"cut.pgm", "a.glb", "--width", "64mm", "--map-width", "256", "--maps", "t.png", "--map-tile"});
    ASSERT_THAT(seam["warnings"], SizeIs(1));
    const std::string words = seam["warnings"][0];
    const std::string along = "cuts droplets along ";
    ASSERT_THAT(words, HasSubstr(along));
    EXPECT_NEAR(std::stod(words.substr(words.find(along) + along.size())), 40.0, 0.5);
    const std::string fall = "fall by up to ";
    EXPECT_NEAR(std::stod(words.substr(words.find(fall) + fall.size())),
                1e3 * seam["shape"]["height_max_m"].get<double>(), 0.2);

    // A tile is the window itself if nothing leans out of it.
    with({"m.png"});
    const std::string height = bytesOf("m-height.png");
    with({"m.png", "--map-tile", "-j", "1"});
    EXPECT_EQ(bytesOf("m-height.png"), height);
}

TEST_F(ShapeCommandTest, TiltMakesTheRimSteepestDownhill)
{
    const auto angles = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"disc.pgm", "a.glb", "--volume", "100uL", "--tilt", "30deg"});
        return report(options)["shape"]["contact_angle_deg"];
    };
    const double rim = 7.5e-3;
    for (const char* model : {"linear", "exact"}) {
        const json down = angles({"--model", model});
        EXPECT_NEAR(down["max_at_m"][0], 0.0, 0.2 * rim) << model;
        EXPECT_NEAR(down["max_at_m"][1], -rim, 0.1 * rim) << model;
        EXPECT_NEAR(down["min_at_m"][1], rim, 0.1 * rim) << model;
        EXPECT_GT(down["max"], down["min"].get<double>() + 10.0) << model;
        const json right = angles({"--model", model, "--tilt-direction", "0deg"});
        EXPECT_NEAR(right["max_at_m"][0], rim, 0.1 * rim) << model;
        EXPECT_NEAR(right["min_at_m"][0], -rim, 0.1 * rim) << model;
        const json up = angles({"--model", model, "--tilt-direction", "-270deg"});
        EXPECT_NEAR(up["max_at_m"][1], rim, 0.1 * rim) << model;
    }
    const json liquid = report({"disc.pgm", "a.glb", "--tilt", "0.5rad", "--tilt-direction", "-30deg"})["liquid"];
    EXPECT_NEAR(liquid["tilt_deg"], 0.5 * 180 / std::numbers::pi, 1e-9);
    EXPECT_NEAR(liquid["tilt_direction_deg"], -30.0, 1e-9);
}

TEST_F(ShapeCommandTest, GravityAwayFromTheGroundMakesDropletsHang)
{
    const auto height = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"disc.pgm", "a.glb", "--volume", "20uL", "--width", "1cm"});
        return report(options)["shape"]["height_max_m"].get<double>();
    };
    const double standing = height({});
    const double weightless = height({"--gravity", "0m/s2"});
    const double hanging = height({"--gravity", "-9.81m/s2"});
    EXPECT_LT(standing, 0.98 * weightless);
    EXPECT_GT(hanging, 1.02 * weightless);
    EXPECT_NEAR(height({"--tilt", "180deg"}), hanging, 1e-6 * hanging);
    EXPECT_NEAR(height({"--tilt", "180deg", "--gravity", "-1g"}), standing, 1e-6 * standing);
}

TEST_F(ShapeCommandTest, ReportsWhetherDropletsWouldSlide)
{
    const auto retained = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"disc.pgm", "a.glb", "--volume", "50uL"});
        return report(options);
    };
    const json steep = retained({"--tilt", "90deg", "--advancing", "60deg", "--receding", "50deg"});
    EXPECT_NEAR(steep["liquid"]["advancing_deg"], 60.0, 1e-9);
    EXPECT_NEAR(steep["liquid"]["receding_deg"], 50.0, 1e-9);
    EXPECT_NEAR(steep["shape"]["driving_force_n"], 998.2 * 50e-9 * 9.81, 1e-9);
    const double width = steep["shape"]["projected_width_m"];
    EXPECT_NEAR(width, 15e-3, 0.02 * 15e-3);
    const double cosines = std::cos(50 * std::numbers::pi / 180) - std::cos(60 * std::numbers::pi / 180);
    EXPECT_NEAR(steep["shape"]["retention_force_n"], 0.0728 * width * cosines, 1e-9);
    EXPECT_EQ(steep["shape"]["would_slide"], true);
    EXPECT_EQ(steep["droplets"][0]["would_slide"], true);
    EXPECT_EQ(retained({"--tilt", "90deg", "--advancing", "100deg", "--receding", "10deg"})["shape"]["would_slide"],
              false);
    const json level = retained({"--advancing", "50deg", "--receding", "50deg"});
    EXPECT_EQ(level["shape"]["would_slide"], false);
    EXPECT_EQ(level["shape"]["driving_force_n"], 0.0);

    const auto sliding = run({"disc.pgm", "a.glb", "--triangles", "2k", "--volume", "50uL", "--tilt", "90deg",
                              "--advancing", "60deg", "--receding", "50deg"});
    EXPECT_THAT(sliding.error, AllOf(HasSubstr("retention  1 droplet would slide"), HasSubstr("µN")));
    EXPECT_THAT(run({"two.pgm", "a.glb", "--triangles", "2k", "--advancing", "60deg", "--receding", "50deg"}).error,
                HasSubstr("retention  no droplet would slide; pulled by 0 µN"));
}

TEST_F(ShapeCommandTest, OneOfTwoDropletsMaySlide)
{
    // On a wall, with the same height, the disc slides; two rims hold the ring.
    const json report = this->report(
        {"two.pgm", "a.glb", "--tilt", "90deg", "--height", "1mm", "--advancing", "65deg", "--receding", "48deg"});
    ASSERT_THAT(report["droplets"], SizeIs(2));
    for (const json& droplet : report["droplets"]) {
        EXPECT_EQ(droplet["would_slide"], droplet["holes"] == 0);
        EXPECT_EQ(droplet["would_slide"], droplet["driving_force_n"] > droplet["retention_force_n"]);
    }
    EXPECT_EQ(report["shape"]["would_slide"], true);
    for (const char* force : {"driving_force_n", "retention_force_n"}) {
        const double sum = report["droplets"][0][force].get<double>() + report["droplets"][1][force].get<double>();
        EXPECT_NEAR(report["shape"][force], sum, 1e-12 * sum) << force;
    }
    EXPECT_LT(report["shape"]["driving_force_n"], report["shape"]["retention_force_n"]) << "together they would stay";
}

TEST_F(ShapeCommandTest, WarnsAboutOptionsWithoutEffect)
{
    const auto warnings = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"disc.pgm", "a.glb", "--contact-angle", "20deg"});
        return report(options)["warnings"].dump();
    };
    EXPECT_EQ(warnings({"--tilt", "10deg", "--tilt-direction", "0deg", "--no-penetration"}), "[]");
    EXPECT_THAT(warnings({"--tilt-direction", "0deg"}), HasSubstr("--tilt-direction has no effect"));
    EXPECT_THAT(warnings({"--tilt-direction", "0deg", "--tilt", "0deg"}), HasSubstr("--tilt-direction has no effect"));
    EXPECT_THAT(warnings({"--tilt-direction", "0deg", "--tilt", "180deg"}),
                HasSubstr("--tilt-direction has no effect"));
    EXPECT_THAT(warnings({"--tilt", "10deg", "--gravity", "0m/s2"}), HasSubstr("--tilt has no effect"));
    EXPECT_THAT(warnings({"--surface-depth", "1mm"}), HasSubstr("--surface-depth has no effect"));
    EXPECT_THAT(warnings({"--surface-depth", "1mm", "--surface", "sphere:R=1m"}),
                HasSubstr("--surface-depth has no effect"));
    EXPECT_THAT(warnings({"--no-penetration"}), HasSubstr("--no-penetration has no effect"));
    EXPECT_EQ(warnings({"--no-penetration", "--surface", "sphere:R=1m"}), "[]");
}

TEST_F(ShapeCommandTest, GroundIsTheOneGiven)
{
    const auto ground = [&](const std::string& surface) {
        return report({"disc.pgm", "a.glb", "--surface", surface})["ground"];
    };
    EXPECT_EQ(report({"disc.pgm", "a.glb"})["ground"]["kind"], "flat");
    EXPECT_EQ(ground("sphere:R=40mm")["kind"], "sphere");
    EXPECT_NEAR(ground("sphere:R=-4cm")["radius_m"], -0.04, 1e-15);
    EXPECT_TRUE(ground("sphere:R=40mm")["axis_deg"].is_null());
    EXPECT_EQ(ground("cylinder:R=33mm,axis=x")["kind"], "cylinder");
    EXPECT_EQ(ground("cylinder:R=33mm,axis=x")["axis_deg"], 0.0);
    EXPECT_NEAR(ground("cylinder:axis=y,R=33mm")["axis_deg"], 90.0, 1e-12);
    EXPECT_NEAR(ground("cylinder:R=33mm,axis=-30deg")["axis_deg"], -30.0, 1e-12);
    EXPECT_NEAR(ground("cylinder:R=33mm,axis=-30deg")["radius_m"], 0.033, 1e-15);
    const json map = report({"disc.pgm", "a.glb", "--surface", "two.pgm", "--surface-depth", "1um"})["ground"];
    EXPECT_EQ(map["kind"], "height map");
    EXPECT_EQ(map["path"], "two.pgm");
    EXPECT_NEAR(map["depth_m"], 1e-6, 1e-18);
}

/// Lowest and highest z of the binary STL's vertices [mm].
std::pair<double, double> rangeOfZ(const std::string& stl)
{
    std::pair<double, double> range{1e9, -1e9};
    for (std::size_t triangle = 84; triangle + 50 <= stl.size(); triangle += 50) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            float z = 0.0F;
            std::memcpy(&z, stl.data() + triangle + 12 * (corner + 1) + 8, sizeof z);
            range.first = std::min(range.first, static_cast<double>(z));
            range.second = std::max(range.second, static_cast<double>(z));
        }
    }
    return range;
}

TEST_F(ShapeCommandTest, BaseFollowsTheGround)
{
    // At the disc's radius of 7.5 mm, a ball of 20 mm is lower by R − √(R² − r²) = 1.46 mm, and a bowl is higher.
    make({"disc.pgm", "ball.stl", "--surface", "sphere:R=20mm", "--contact-angle", "15deg"});
    EXPECT_NEAR(rangeOfZ(bytesOf("ball.stl")).first, -1.46, 0.03);
    const auto sunk = run({"disc.pgm", "a.stl", "--surface", "sphere:R=20mm", "--contact-angle", "5deg"});
    EXPECT_EQ(sunk.exit_code, 0);
    EXPECT_THAT(sunk.error, HasSubstr("% of the footprint dry"));
    make({"disc.pgm", "bowl.stl", "--surface", "sphere:R=-20mm", "--contact-angle", "5deg"});
    EXPECT_NEAR(rangeOfZ(bytesOf("bowl.stl")).first, 0.0, 0.01);
    EXPECT_NEAR(rangeOfZ(bytesOf("bowl.stl")).second, 1.46, 0.2);
}

// A base just above the ground leaves a film of air. Previews have a ground of their own.
TEST_F(ShapeCommandTest, SinkLowersTheDropletInItsFile)
{
    const std::vector<std::string> picture{"--preview-size", "64x48", "--preview"};
    const auto made = [&](std::vector<std::string> arguments, const std::string& preview) {
        arguments.insert(arguments.end(), picture.begin(), picture.end());
        arguments.push_back(preview);
        make(arguments);
    };
    made({"disc.pgm", "flat.stl"}, "flat.png");
    made({"disc.pgm", "sunk.stl", "--sink", "0.01mm"}, "sunk.png");
    const auto [low, high] = rangeOfZ(bytesOf("flat.stl"));
    const auto [sunk_low, sunk_high] = rangeOfZ(bytesOf("sunk.stl"));
    EXPECT_NEAR(sunk_low, low - 0.01, 1e-6);
    EXPECT_NEAR(sunk_high, high - 0.01, 1e-6);
    EXPECT_EQ(bytesOf("sunk.png"), bytesOf("flat.png"));
    make({"disc.pgm", "cap.glb", "--open", "--width", "6cm"});
    writeFile(directory() / "spot.pgm", discPicture(64, 8.0));
    make({"spot.pgm", "on.stl", "--onto", "cap.glb"});
    make({"spot.pgm", "in.stl", "--onto", "cap.glb", "--sink", "0.01mm"});
    EXPECT_NEAR(rangeOfZ(bytesOf("in.stl")).second, rangeOfZ(bytesOf("on.stl")).second - 0.01, 2e-3);
}

TEST_F(ShapeCommandTest, LevelHeightMapLiftsTheDroplet)
{
    writeFile(directory() / "white.pgm", greymap(8, 8, [](int, int) { return 255; }));
    const json flat = report({"disc.pgm", "flat.stl"});
    const json lifted = report({"disc.pgm", "lifted.stl", "--surface", "white.pgm", "--surface-depth", "3mm"});
    const auto [flat_low, flat_high] = rangeOfZ(bytesOf("flat.stl"));
    const auto [low, high] = rangeOfZ(bytesOf("lifted.stl"));
    EXPECT_NEAR(low, 3.0 + flat_low, 1e-5);
    EXPECT_NEAR(high, 3.0 + flat_high, 1e-5);
    for (const char* key : {"volume_m3", "height_max_m", "liquid_area_m2"}) {
        EXPECT_NEAR(lifted["shape"][key], flat["shape"][key].get<double>(), 1e-8 * flat["shape"][key].get<double>());
    }
}

/// TIFF of one floating-point pixel.
std::string floatTiff(float value)
{
    std::string bytes("II*\0\x08\0\0\0\x09\0", 10);
    const auto put = [&](auto number) {
        std::array<char, sizeof number> raw{};
        std::memcpy(raw.data(), &number, sizeof number);
        bytes.append(raw.data(), raw.size());
    };
    // Width, length, bits, compression, photometric, strip offset, rows, strip bytes, sample format (TIFF 6.0).
    constexpr std::uint32_t kData = 10 + 9 * 12 + 4;
    for (const auto& [tag, entry] : std::vector<std::pair<std::uint16_t, std::uint32_t>>{
             {256, 1}, {257, 1}, {258, 32}, {259, 1}, {262, 1}, {273, kData}, {278, 1}, {279, 4}, {339, 3}}) {
        put(tag);
        put(std::uint16_t{4});
        put(std::uint32_t{1});
        put(entry);
    }
    put(std::uint32_t{0});
    put(value);
    return bytes;
}

TEST_F(ShapeCommandTest, HeightMapOfFloatsIsInMetres)
{
    writeFile(directory() / "up.tif", floatTiff(2e-3F));
    make({"disc.pgm", "up.stl", "--surface", "up.tif"});
    EXPECT_NEAR(rangeOfZ(bytesOf("up.stl")).first, 2.0, 1e-5);
    make({"disc.pgm", "higher.stl", "--surface", "up.tif", "--surface-depth", "3m"});
    EXPECT_NEAR(rangeOfZ(bytesOf("higher.stl")).first, 6.0, 1e-5);
}

TEST_F(ShapeCommandTest, NoPenetrationLeavesGroundDry)
{
    // Thesis, figure 4.14: a tilted puddle, far wider than the capillary length, sinks into the ground uphill. In truth
    // its rim downhill does not hold so much.
    const std::vector<std::string> puddle{"disc.pgm", "a.glb",  "--width", "8cm",     "--volume",
                                          "3mL",      "--tilt", "30deg",   "--model", "linear"};
    const json before = report(puddle);
    EXPECT_EQ(before["no_penetration"], false);
    EXPECT_GT(before["shape"]["depth_max_m"], 1e-4);
    EXPECT_EQ(before["shape"]["dry_area_m2"], 0.0);
    auto kept = puddle;
    kept.emplace_back("--no-penetration");
    const json after = report(kept);
    EXPECT_EQ(after["no_penetration"], true);
    EXPECT_LT(after["shape"]["depth_max_m"], 1e-9);
    EXPECT_GT(after["shape"]["dry_area_m2"], 0.05 * after["mesh"]["footprint_area_m2"].get<double>());
    EXPECT_NEAR(after["shape"]["volume_m3"], 3e-6, 1e-15);
    EXPECT_EQ(after["output"]["closed"], true);
}

TEST_F(ShapeCommandTest, WritesADatafileForSurfaceEvolver)
{
    make({"two.pgm", "a.glb"});
    make({"two.pgm", "b.glb", "--export-evolver", "b.fe"});
    EXPECT_EQ(bytesOf("a.glb"), bytesOf("b.glb"));
    EXPECT_THAT(bytesOf("b.fe").substr(0, 100), HasSubstr("for Surface Evolver"));
    EXPECT_NE(bytesOf("b.fe").find("\nvertices\n"), std::string::npos);
    make({"two.pgm", "c.glb", "--export-evolver", "c.fe", "-j", "1", "--json", "c.json"});
    EXPECT_TRUE(bytesOf("b.fe") == bytesOf("c.fe"));
    const auto piped = run({"two.pgm", "d.glb", "--export-evolver", "-", "-q", "--triangles", "2k"});
    EXPECT_TRUE(piped.output == bytesOf("b.fe"));
    EXPECT_THAT(scratch().names(),
                ElementsAre("a.glb", "b.fe", "b.glb", "c.fe", "c.glb", "c.json", "d.glb", "disc.pgm", "two.pgm"));
}

// What is wrong with strokes names them, not the picture.
TEST_F(ShapeCommandTest, StrokesThatDoNotFitAreNamed)
{
    const auto with = [&](const char* seeds) { return run({"disc.pgm", "x.glb", "--seeds", seeds}); };
    writeFile(directory() / "small.pgm", greymap(8, 8, [](int x, int) { return x < 4 ? 0 : 255; }));
    const auto small = with("small.pgm");
    EXPECT_EQ(small.exit_code, 3);
    EXPECT_THAT(small.error,
                StartsWith("droplet-shape: --seeds: it has 8 x 8 pixels, must be 64 x 64, as the picture"));
    writeFile(directory() / "dark.pgm", greymap(64, 64, [](int x, int) { return x < 4 ? 0 : 128; }));
    EXPECT_THAT(with("dark.pgm").error, StartsWith("droplet-shape: --seeds: it must have a light stroke, on liquid"));
    writeFile(directory() / "photo.pgm", greymap(64, 64, [](int x, int y) { return 2 * (x + y); }));
    const auto photo = with("photo.pgm");
    EXPECT_EQ(photo.exit_code, 0) << photo.error;
    EXPECT_THAT(photo.error, HasSubstr("warning: --seeds: it looks like a photograph"));
}

// A plate of 10 cm whose picture cuts out its right two fifths, where the disc would lie.
TEST_F(ShapeCommandTest, LeavesOutDropletsOverHolesOfAnObjectsTexture)
{
    testing::Draft draft;
    draft.addFloats({-0.05F, 0.0F, 0.05F, 0.05F, 0.0F, 0.05F, 0.05F, 0.0F, -0.05F, -0.05F, 0.0F, -0.05F}, "VEC3");
    draft.addFloats({0.0F, 1.0F, 1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 0.0F}, "VEC2");
    draft.add(std::string("\0\1\2\0\2\3", 6), 5121, "SCALAR", 6);
    const auto write = [&](const std::string& name, const std::string& mode) {
        writeFile(
            directory() / name,
            draft.file(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
                       R"({"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],"materials":[{"alphaMode":")" +
                       mode +
                       R"(","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
                       R"("textures":[{"source":0}],"images":[{"uri":"part.png"}])"));
    };
    std::ostringstream png;
    Layer part{5, 1, std::vector<std::uint8_t>(20, 255)};
    part.rgba[15] = 0;
    part.rgba[19] = 0;
    writePng(part, png);
    writeFile(directory() / "part.png", png.str());
    const auto left_out = [&](const std::string& object) {
        return report({"two.pgm", "laid.glb", "--onto", object})["onto"]["droplets_left_out"].get<int>();
    };
    write("leaf.glb", "MASK");
    EXPECT_EQ(left_out("leaf.glb"), 1);
    EXPECT_THAT(run({"two.pgm", "laid.glb", "--onto", "leaf.glb", "--triangles", "2k"}).error,
                HasSubstr("1 droplet left out: over a place that the alpha of the object's texture cuts out"));
    write("veil.glb", "BLEND");
    EXPECT_EQ(left_out("veil.glb"), 1);
    write("plate.glb", "OPAQUE");
    EXPECT_EQ(left_out("plate.glb"), 0);
}

/// Plate of 10 cm with a picture as its texture, and its normal up.
std::string texturedPlate(const std::string& picture)
{
    testing::Draft draft;
    draft.addFloats({-0.05F, 0.0F, 0.05F, 0.05F, 0.0F, 0.05F, 0.05F, 0.0F, -0.05F, -0.05F, 0.0F, -0.05F}, "VEC3");
    draft.addFloats({0.0F, 1.0F, 1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 0.0F}, "VEC2");
    draft.add(std::string("\0\1\2\0\2\3", 6), 5121, "SCALAR", 6);
    return draft.file(
        R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"translation":[0.5,0,0]}],"meshes":[{"primitives":)"
        R"([{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],"materials":)"
        R"([{"name":"wood","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":)"
        R"([{"source":0}],"images":[{"uri":")" +
        picture + R"("}])");
}

/// What a GLB says of itself.
json jsonIn(const std::string& glb)
{
    const auto byte = [&](std::size_t k) { return static_cast<std::size_t>(static_cast<unsigned char>(glb[k])); };
    const std::size_t length = byte(12) + (byte(13) << 8U) + (byte(14) << 16U) + (byte(15) << 24U);
    return json::parse(glb.substr(20, length));
}

/// Smallest and largest coordinates of the mesh of a node.
json boxOf(const json& gltf, const char* node)
{
    for (const json& each : gltf["nodes"]) {
        if (each["name"] == node) {
            const json& mesh = gltf["meshes"][each["mesh"].get<std::size_t>()];
            const json& place = gltf["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
            return {place["min"], place["max"]};
        }
    }
    return nullptr;
}

// The droplets are where they are without the object, below its node; it has its place, its material and its texture.
TEST_F(ShapeCommandTest, FilesOfScenesHaveTheObjectWithItsDroplets)
{
    std::ostringstream png;
    writePng(Layer{2, 1, {200, 100, 50, 255, 100, 50, 25, 255}}, png);
    writeFile(directory() / "wood.png", png.str());
    writeFile(directory() / "plate.glb", texturedPlate("wood.png"));
    const std::vector<std::string> onto{"--onto", "plate.glb"};
    const auto made = [&](const std::string& output, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"two.pgm", output, "--onto", "plate.glb"});
        make(more);
        return bytesOf(output);
    };
    const std::string both = made("both.glb");
    const json scene = jsonIn(both);
    const json alone = jsonIn(made("alone.glb", {"--droplets-only"}));
    EXPECT_EQ(scene["scenes"][0]["nodes"], json::array({0}));
    EXPECT_EQ(scene["nodes"][0]["name"], "object");
    EXPECT_EQ(scene["nodes"][0]["children"], json({1}));
    EXPECT_EQ(scene["nodes"][1]["name"], "droplet");
    EXPECT_EQ(boxOf(scene, "droplet"), boxOf(alone, "droplet"));
    const json box = boxOf(scene, "object");
    EXPECT_NEAR(box[0][0], 0.45, 1e-7) << "by the transform of its node";
    EXPECT_NEAR(box[1][0], 0.55, 1e-7);
    EXPECT_EQ(scene["materials"][0]["name"], "wood");
    EXPECT_EQ(scene["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
    EXPECT_FALSE(scene["materials"][1]["pbrMetallicRoughness"].contains("baseColorTexture"));
    EXPECT_NE(both.find(png.str()), std::string::npos);
    EXPECT_FALSE(alone.contains("images"));
    EXPECT_EQ(boxOf(alone, "object"), nullptr);

    const json tinted = jsonIn(made("tinted.glb", {"--colour-map"}));
    const auto picture_of = [&](std::size_t material) {
        const json& texture = tinted["materials"][material]["pbrMetallicRoughness"]["baseColorTexture"]["index"];
        return tinted["textures"][texture.get<std::size_t>()]["source"];
    };
    EXPECT_NE(picture_of(0), picture_of(1));

    EXPECT_EQ(run({"two.pgm", "each.glb", "--onto", "plate.glb", "--nodes", "each", "--lod", "4k,1k"}).exit_code, 0);
    const json each = jsonIn(bytesOf("each.glb"));
    EXPECT_EQ(each["nodes"][0]["children"], json({1, 2}));
    EXPECT_EQ(each["nodes"][2]["extensions"]["MSFT_lod"]["ids"], json({4}));
    EXPECT_FALSE(each["nodes"][0].contains("extensions"));

    made("both.usda");
    EXPECT_THAT(bytesOf("both.usda"), AllOf(HasSubstr("def Xform \"object\""), HasSubstr("\"droplet\"")));
    made("tinted.usdz", {"--colour-map"});
    EXPECT_EQ(made("both.obj"), [&] {
        std::string text = made("alone.obj");
        return text.replace(text.find("alone.mtl"), 9, "both.mtl");
    }());

    const auto error_of = [&](const char* output, std::vector<std::string> more) {
        more.insert(more.begin(), {"two.pgm", output, "--compress", "meshopt"});
        more.insert(more.end(), onto.begin(), onto.end());
        return report(more)["output"]["position_error_m"].get<double>();
    };
    const double with_object = error_of("both.glb", {});
    EXPECT_GT(with_object, error_of("alone.glb", {"--droplets-only"}));
    EXPECT_LT(with_object, 0.87 * 0.1 / 65535.0);

    const auto refused = run({"two.pgm", "x.stl", "--onto", "plate.glb", "--droplets-only"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.error, HasSubstr("--droplets-only needs a .glb, .gltf, .usda or .usdz as OUTPUT, not 'x.stl'"));
    EXPECT_THAT(run({"two.pgm", "x.glb", "--triangles", "2k", "--droplets-only"}).error,
                HasSubstr("--droplets-only has no effect without --onto"));
}

// The plate of texturedPlate() as OBJ, in millimetres: a polygon with a picture on it.
TEST_F(ShapeCommandTest, LaysDropletsOntoAnObj)
{
    std::ostringstream png;
    writePng(Layer{2, 1, {200, 100, 50, 255, 100, 50, 25, 255}}, png);
    writeFile(directory() / "wood.png", png.str());
    writeFile(directory() / "plate.glb", texturedPlate("wood.png"));
    const auto plate = [](const std::string& lowest, const std::string& size) {
        std::string text = "mtllib plate.mtl\n";
        for (const char* corner : {"< = >", "> = >", "> = <", "< = <"}) {
            text += "v ";
            for (const char* at = corner; *at != '\0'; ++at) {
                text += *at == '<' ? lowest : *at == '>' ? size : *at == '=' ? "0" : " ";
            }
            text += "\n";
        }
        return text + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl wood\nf 1/1 2/2 3/3 4/4\n";
    };
    writeFile(directory() / "plate.obj", plate("-50", "50"));
    writeFile(directory() / "small.obj", plate("-0.05", "0.05"));
    writeFile(directory() / "plate.mtl", "newmtl wood\nKd 1 1 1\nmap_Kd wood.png\n");
    const auto laid = [&](const std::string& object, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"two.pgm", "laid.glb", "--onto", object, "--width", "10cm"});
        make(more);
        return bytesOf("laid.glb");
    };
    const json from_gltf = jsonIn(laid("plate.glb"));
    const std::string file = laid("plate.obj");
    const json from_obj = jsonIn(file);
    EXPECT_NEAR(boxOf(from_obj, "object")[1][0].get<double>(), 0.05, 1e-9);
    const json droplets = boxOf(from_obj, "droplet");
    const json expected = boxOf(from_gltf, "droplet");
    for (std::size_t end = 0; end < 2; ++end) {
        EXPECT_NEAR(droplets[end][0].get<double>(), expected[end][0].get<double>() - 0.5, 1e-7);
        EXPECT_NEAR(droplets[end][1].get<double>(), expected[end][1].get<double>(), 1e-7);
        EXPECT_NEAR(droplets[end][2].get<double>(), expected[end][2].get<double>(), 1e-7);
    }
    EXPECT_EQ(from_obj["materials"][0]["name"], "wood");
    EXPECT_EQ(from_obj["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
    EXPECT_NE(file.find(png.str()), std::string::npos);
    EXPECT_EQ(boxOf(jsonIn(laid("small.obj", {"--object-size", "10cm"})), "object"), boxOf(from_obj, "object"));
    EXPECT_EQ(boxOf(jsonIn(laid("small.obj", {"--scale", "1000"})), "object"), boxOf(from_obj, "object"));

    fs::remove(directory() / "plate.mtl");
    const auto plain = run({"two.pgm", "laid.glb", "--onto", "plate.obj", "--width", "10cm", "--triangles", "2k"});
    EXPECT_EQ(plain.exit_code, 0);
    EXPECT_THAT(plain.error, HasSubstr("plate.mtl is not a file beside it"));
    EXPECT_FALSE(jsonIn(bytesOf("laid.glb")).contains("images"));
    EXPECT_THAT(run({"two.pgm", "x.glb", "--triangles", "2k", "--scale", "2"}).error,
                HasSubstr("--scale has no effect without --onto"));
}

TEST_F(ShapeCommandTest, LaysDropletsOntoAnObject)
{
    // The object is another droplet: an open cap with the texture coordinates of its picture.
    make({"disc.pgm", "cap.glb", "--open", "--width", "6cm"});
    writeFile(directory() / "spot.pgm", discPicture(64, 8.0));
    const json own_size = report({"spot.pgm", "laid.stl", "--onto", "cap.glb"});
    EXPECT_EQ(own_size["onto"]["path"], "cap.glb");
    EXPECT_EQ(own_size["onto"]["droplets_laid"], 1);
    EXPECT_EQ(own_size["onto"]["droplets_left_out"], 0);
    EXPECT_EQ(own_size["output"]["closed"], true);
    // At the object's own size, the picture is as wide as the cap's, except for the cap's slope.
    EXPECT_NEAR(own_size["input"]["pixel_size_m"].get<double>() * 64, 6e-2, 6e-3);
    EXPECT_NEAR(report({"spot.pgm", "a.glb", "--onto", "cap.glb", "--width", "1cm"})["onto"]["most_scale"], 6.0, 1.0);

    const auto range = rangeOfZ(bytesOf("laid.stl"));
    make({"disc.pgm", "cap.stl", "--open", "--width", "6cm"});
    EXPECT_GT(range.second, rangeOfZ(bytesOf("cap.stl")).second);

    make({"spot.pgm", "one.glb", "--onto", "cap.glb", "-j", "1"});
    make({"spot.pgm", "other.glb", "--onto", "cap.glb", "-j", "2"});
    EXPECT_EQ(bytesOf("one.glb"), bytesOf("other.glb"));

    EXPECT_THAT(run({"spot.pgm", "a.glb", "--onto", "cap.glb", "--triangles", "2k"}).error,
                HasSubstr("object     cap.glb: 1 droplet laid on it, 0 left out, lengths "));

    // The droplet lies beside the cap, where there is no object.
    const auto beside = run({"disc.pgm", "b.glb", "--onto", "cap.glb", "--invert"});
    EXPECT_EQ(beside.exit_code, 5);
    EXPECT_THAT(beside.errorLines(), SizeIs(1));
    EXPECT_FALSE(fs::exists(directory() / "b.glb"));
}

TEST_F(ShapeCommandTest, FootprintOptionsReachTheOutline)
{
    const double area = report({"disc.pgm", "a.glb"})["mesh"]["footprint_area_m2"];
    // Wide puddles have graded triangles, and so other points along the rim.
    const json wide = report({"disc.pgm", "a.glb", "--width", "4cm", "--grading", "1"});
    EXPECT_NEAR(wide["mesh"]["footprint_area_m2"], 4 * area, 1e-9 * area);
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

TEST_F(ShapeCommandTest, TriangleOptionsSetTheMesh)
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

TEST_F(ShapeCommandTest, QuadsAreWrittenWhereFilesHoldThem)
{
    const auto faces_of = [&](const std::string& obj) {
        std::istringstream lines(bytesOf(obj));
        std::pair<std::size_t, std::size_t> faces;  // of three and four corners
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("f ")) {
                ++(std::count(line.begin(), line.end(), ' ') == 4 ? faces.second : faces.first);
            }
        }
        return faces;
    };
    // On curved ground, upright, and where liquid hangs over its rim, too.
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"--surface", "sphere:R=40mm"}, {"--contact-angle", "90deg"}, {"--open"}}) {
        std::vector<std::string> options{"two.pgm", "quads.obj", "--quads",    "--triangles",
                                         "8k",      "--json",    "quads.json", "-q"};
        options.insert(options.end(), more.begin(), more.end());
        ASSERT_EQ(run(options).exit_code, 0);
        const json output = json::parse(bytesOf("quads.json"))["output"];
        const auto [triangles, quads] = faces_of("quads.obj");
        EXPECT_EQ(output["quads"], quads);
        EXPECT_EQ(output["triangles"], triangles + 2 * quads);
        EXPECT_GT(static_cast<double>(quads), 0.9 * static_cast<double>(triangles + quads));
    }
    EXPECT_THAT(run({"two.pgm", "quads.ply", "--quads"}).error, HasSubstr(" quadrilaterals and "));
    const json glb = report({"two.pgm", "quads.glb", "--quads"});
    EXPECT_EQ(glb["output"]["quads"], 0);
    EXPECT_THAT(glb["warnings"].dump(), HasSubstr("glb files hold triangles alone"));
    EXPECT_EQ(report({"two.pgm", "plain.obj"})["output"]["quads"], 0);
    EXPECT_EQ(run({"two.pgm", "a.obj", "--quads", "--grading", "4"}).exit_code, 2);
    make({"two.pgm", "one.ply", "--quads", "-j", "1"});
    make({"two.pgm", "other.ply", "--quads", "-j", "2"});
    EXPECT_EQ(bytesOf("one.ply"), bytesOf("other.ply"));
    make({"disc.pgm", "cap.glb", "--open", "--width", "6cm"});
    writeFile(directory() / "spot.pgm", discPicture(64, 8.0));
    const json laid = report({"spot.pgm", "laid.obj", "--onto", "cap.glb", "--quads"});
    EXPECT_GT(laid["output"]["quads"].get<double>(), 0.4 * laid["output"]["triangles"].get<double>());
}

TEST_F(ShapeCommandTest, BaseMakesOneSolidOfAllDroplets)
{
    const json apart = report({"two.pgm", "apart.stl"});
    EXPECT_EQ(apart["output"]["components"], 2);
    EXPECT_TRUE(apart["output"]["base_m"].is_null());
    for (const std::string file : {"plate.stl", "plate.3mf", "plate.obj", "plate.glb"}) {
        const json plate = report({"two.pgm", file, "--base", "1mm"});
        EXPECT_EQ(plate["output"]["components"], 1);
        EXPECT_EQ(plate["output"]["euler"], 2);
        EXPECT_EQ(plate["output"]["closed"], true);
        EXPECT_EQ(plate["output"]["base_m"], 1e-3);
        EXPECT_EQ(plate["shape"], apart["shape"]);
    }
    EXPECT_THAT(report({"two.pgm", "quads.obj", "--quads", "--base", "1mm"})["output"]["quads"].get<int>(), Gt(1000));
    EXPECT_THAT(report({"two.pgm", "thin.stl", "--base", "0.1mm"})["warnings"].dump(), HasSubstr("two layers"));
    EXPECT_THAT(report({"two.pgm", "small.stl", "--base", "1mm", "--width", "2mm"})["warnings"].dump(),
                HasSubstr("so a print may lose them"));
    // Pictures show the plate: seen from above it covers what lies between the droplets.
    const auto golden = [&](const std::vector<std::string>& more) {
        std::vector<std::string> options{"two.pgm", "a.stl",      "--preview", "a.png",  "--preview-size",
                                         "64x48",   "--material", "gold",      "--view", "top"};
        options.insert(options.end(), more.begin(), more.end());
        make(options);
        const Picture picture = readPicture(directory() / "a.png");
        std::size_t count = 0;
        for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
            count += picture.rgb[i] > picture.rgb[i + 2] ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(golden({"--base", "1mm"}), 2 * golden({}));
    make({"two.pgm", "one.stl", "--base", "1mm", "-j", "1"});
    make({"two.pgm", "other.stl", "--base", "1mm", "-j", "2"});
    EXPECT_EQ(bytesOf("one.stl"), bytesOf("other.stl"));
    for (const std::vector<std::string>& other : {std::vector<std::string>{"--open"},
                                                  {"--surface", "sphere:R=40mm"},
                                                  {"--sink", "1mm"},
                                                  {"--no-penetration"}}) {
        std::vector<std::string> options{"two.pgm", "a.3mf", "--base", "1mm"};
        options.insert(options.end(), other.begin(), other.end());
        const auto refused = run(options);
        EXPECT_EQ(refused.exit_code, 2) << other.front();
        EXPECT_THAT(refused.error, HasSubstr("--base"));
    }
}

TEST_F(ShapeCommandTest, BaseIsABodyBelowDropletsOfSeveralLooks)
{
    const json each = report({"two.pgm", "each.gltf", "--nodes", "each", "--base", "1mm"});
    EXPECT_EQ(each["output"]["components"], 3);
    EXPECT_EQ(each["output"]["closed"], true);
    const json file = json::parse(bytesOf("each.gltf"));
    std::vector<std::string> names;
    for (const json& node : file["nodes"]) {
        names.push_back(node["name"]);
    }
    EXPECT_THAT(names, ElementsAre("droplet_1", "droplet_2", "plate"));
    // Colours keep their filaments, and the plate has the liquid's.
    std::string pixels;
    for (int k = 0; k < 64 * 64; ++k) {
        const bool is_wet = std::abs(k % 64 - 32) < 24 && std::abs(k / 64 - 32) < 24;
        pixels += !is_wet ? "\xff\xff\xff" : k % 64 < 32 ? "\xff\x20\x20" : "\x20\x20\xff";
    }
    writeFile(directory() / "two.ppm", "P6 64 64 255 " + pixels);
    make({"two.ppm", "colours.gltf", "--by-colour", "--base", "1mm", "--width", "40mm", "--material", "milk"});
    const json materials = json::parse(bytesOf("colours.gltf"))["materials"];
    ASSERT_THAT(materials, SizeIs(3));
    EXPECT_EQ(materials.back()["name"], "plate");
    EXPECT_GT(materials.back()["pbrMetallicRoughness"]["baseColorFactor"][0].get<double>(), 0.8) << "of milk";
    // A droplet that has the plate's look is no part of the plate.
    writeFile(directory() / "one.toml", "[[droplet]]\nindex = 1\nmaterial = \"gold\"\n");
    make({"two.pgm", "looks.gltf", "--materials", "one.toml", "--base", "1mm"});
    EXPECT_THAT(json::parse(bytesOf("looks.gltf"))["materials"], SizeIs(3));
    // Formats without nodes have bodies of their own, too.
    const json stl = report({"two.pgm", "a.stl", "--nodes", "each", "--base", "1mm"});
    EXPECT_EQ(stl["output"]["components"], 3);
    EXPECT_THAT(stl["warnings"], IsEmpty());
}

TEST_F(ShapeCommandTest, WeldMakesOneVertexOfEachPlace)
{
    const json ply = report({"two.pgm", "a.ply"})["output"];
    const json split = report({"two.pgm", "split.gltf"})["output"];
    const json one = report({"two.pgm", "one.gltf", "--weld", "--sink", "0.1mm", "--html", "page.html"})["output"];
    EXPECT_GT(split["vertices"], ply["vertices"]);
    EXPECT_EQ(one["vertices"], ply["vertices"]);
    EXPECT_EQ(one["triangles"], split["triangles"]);
    EXPECT_EQ(one["closed"], true);
    const json file = json::parse(bytesOf("one.gltf"));
    const auto position = file["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>();
    EXPECT_EQ(file["accessors"][position]["count"], one["vertices"]);
    EXPECT_FALSE(file["meshes"][0]["primitives"][0].contains("targets"));
    EXPECT_NEAR(file["accessors"][position]["min"][1].get<double>(), -1e-4, 1e-9);
    EXPECT_EQ(report({"two.pgm", "plate.glb", "--weld", "--base", "1mm"})["output"]["components"], 1);
    EXPECT_THAT(report({"two.pgm", "b.ply", "--weld"})["warnings"].dump(), HasSubstr("--weld has no effect"));
}

TEST_F(ShapeCommandTest, LevelsOfDetailAreInTheGlbOrBesideTheFile)
{
    const auto done = [&](std::vector<std::string> options) {
        options.insert(options.begin(), "two.pgm");
        const auto result = run(options);
        return result.exit_code == 0 ? "" : result.error;
    };
    ASSERT_EQ(done({"lod.gltf", "--lod", "8k,2k,500", "--nodes", "each", "--json", "lod.json"}), "");
    const json file = json::parse(bytesOf("lod.gltf"));
    EXPECT_THAT(file["extensionsUsed"].dump(), HasSubstr("MSFT_lod"));
    EXPECT_EQ(file["scenes"][0]["nodes"], json::array({0, 1}));
    EXPECT_EQ(file["materials"].size(), 2U);
    const auto triangles_of = [&](const json& node) {
        const json& mesh = file["meshes"][node["mesh"].get<std::size_t>()];
        const auto indices = mesh["primitives"][0]["indices"].get<std::size_t>();
        return file["accessors"][indices]["count"].get<std::size_t>() / 3;
    };
    std::vector<std::size_t> counts(3);
    for (const json& root : file["scenes"][0]["nodes"]) {
        const json& node = file["nodes"][root.get<std::size_t>()];
        const json& levels = node["extensions"]["MSFT_lod"]["ids"];
        ASSERT_EQ(levels.size(), 2U);
        EXPECT_EQ(node["extras"]["MSFT_screencoverage"].size(), 3U);
        counts[0] += triangles_of(node);
        for (std::size_t k = 0; k < 2; ++k) {
            const json& level = file["nodes"][levels[k].get<std::size_t>()];
            counts[k + 1] += triangles_of(level);
            EXPECT_EQ(level["name"], node["name"].get<std::string>() + "_lod" + std::to_string(k + 1));
        }
    }
    const json output = json::parse(bytesOf("lod.json"))["output"];
    EXPECT_EQ(output["triangles"], counts[0]);
    ASSERT_EQ(output["levels"].size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
        const json& level = output["levels"][k];
        EXPECT_EQ(level["triangles"], counts[k + 1]);
        EXPECT_LE(counts[k + 1], k == 0 ? 2000U : 500U);
        EXPECT_TRUE(level["path"].is_null());
        EXPECT_GT(level["error_rms_m"], 0.0);
        EXPECT_LT(level["error_rms_m"], 1e-3);
    }
    for (const std::string compression : {"quantize", "meshopt"}) {
        ASSERT_EQ(done({"small.glb", "--lod", "8k,2k", "--compress", compression}), "");
        EXPECT_THAT(bytesOf("small.glb"), HasSubstr("MSFT_lod"));
    }
    ASSERT_EQ(done({"lod.obj", "--lod", "8k,2k,500", "--base", "1mm", "--json", "obj.json"}), "");
    const json obj = json::parse(bytesOf("obj.json"))["output"];
    EXPECT_THAT(obj["levels"][1]["path"].get<std::string>(), EndsWith("lod-lod2.obj"));
    for (const std::string name : {"lod-lod1.obj", "lod-lod2.obj"}) {
        EXPECT_THAT(bytesOf(name), HasSubstr("mtllib lod.mtl"));
    }
    EXPECT_LT(bytesOf("lod-lod2.obj").size(), bytesOf("lod-lod1.obj").size());
    const std::string told = run({"two.pgm", "lod.obj", "--lod", "8k,2k,500"}).error;
    for (const char* name : {"lod.obj: ", "lod-lod1.obj: ", "lod-lod2.obj: "}) {
        EXPECT_THAT(told, HasSubstr(name));
    }
    EXPECT_TRUE(report({"two.pgm", "plain.obj"})["output"]["levels"].empty());
    for (const char* list : {"8k", "2k,8k", "8k,8k", "8k,0", "8k,x"}) {
        EXPECT_EQ(run({"two.pgm", "a.glb", "--lod", list}).exit_code, 2) << list;
    }
    EXPECT_EQ(run({"two.pgm", "-", "--format", "stl", "--lod", "8k,2k"}).exit_code, 2);
    EXPECT_EQ(run({"two.pgm", "a.glb", "--lod", "8k,2k", "--triangles", "8k"}).exit_code, 2);
    EXPECT_EQ(run({"two.pgm", "a.obj", "--lod", "8k,2k", "--json", "a-lod1.obj"}).exit_code, 2);
}

// Levels have the triangles that they have with both copies of the rim, and one vertex for each place, whose normal is
// the liquid's.
TEST_F(ShapeCommandTest, LevelsOfAWeldedMeshAreWelded)
{
    const auto output = [&](std::vector<std::string> options) {
        options.insert(options.begin(), "two.pgm");
        options.insert(options.end(), {"--lod", "8k,2k,500", "--json", "lod.json"});
        EXPECT_EQ(run(options).exit_code, 0);
        return json::parse(bytesOf("lod.json"))["output"];
    };
    const json split = output({"split.gltf"});
    const json one = output({"one.gltf", "--weld"});
    const json ply = output({"each.ply"});
    const json file = json::parse(bytesOf("one.gltf"));
    ASSERT_EQ(one["levels"].size(), 2U);
    ASSERT_EQ(file["meshes"].size(), 3U);
    for (std::size_t k = 0; k < 2; ++k) {
        const json& level = one["levels"][k];
        EXPECT_EQ(level["triangles"], split["levels"][k]["triangles"]);
        EXPECT_EQ(level["error_rms_m"], split["levels"][k]["error_rms_m"]);
        EXPECT_EQ(level["vertices"], ply["levels"][k]["vertices"]);
        EXPECT_LT(level["vertices"], split["levels"][k]["vertices"]);
        const auto position = file["meshes"][k + 1]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>();
        EXPECT_EQ(file["accessors"][position]["count"], level["vertices"]);
    }
    EXPECT_EQ(output({"plate.glb", "--weld", "--base", "1mm"})["components"], 1);
    output({"each.obj"});
    const std::string each = bytesOf("each-lod1.obj");
    output({"each.obj", "--weld"});
    EXPECT_EQ(bytesOf("each-lod1.obj"), each);
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

TEST_F(ShapeCommandTest, MaterialChangesTheFileAndHasNoEffectOnStl)
{
    make({"disc.pgm", "water.glb"});
    make({"disc.pgm", "ink.glb", "--material", "ink"});
    EXPECT_NE(bytesOf("water.glb"), bytesOf("ink.glb"));

    const auto stl = run({"disc.pgm", "a.stl", "--material", "ink", "--triangles", "2k", "--json", "report.json"});
    EXPECT_EQ(stl.exit_code, 0);
    EXPECT_THAT(stl.error, HasSubstr("warning: --material ink has no effect"));
    EXPECT_THAT(json::parse(bytesOf("report.json"))["warnings"].dump(), HasSubstr("--material ink has no effect"));
}

TEST_F(ShapeCommandTest, LiquidsHaveTheirOwnLookUnlessAMaterialIsGiven)
{
    const auto made = [&](const std::string& name, std::vector<std::string> options) {
        std::vector<std::string> arguments{"disc.pgm",    name + ".gltf",   "--preview",
                                           name + ".png", "--preview-size", "64x48"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        make(arguments);
        return json::parse(bytesOf(name + ".gltf"))["materials"][0]["name"].get<std::string>();
    };
    for (const std::string liquid : {"honey", "mercury"}) {
        EXPECT_EQ(made("own", {"--liquid", liquid}), liquid);
        EXPECT_EQ(made("named", {"--liquid", liquid, "--material", liquid}), liquid);
        EXPECT_TRUE(bytesOf("own.png") == bytesOf("named.png"));
        EXPECT_EQ(made("other", {"--liquid", liquid, "--material", "ink"}), "ink");
    }
    for (const std::string liquid : {"water", "ethanol", "glycerol"}) {
        EXPECT_EQ(made("clear", {"--liquid", liquid}), "water");
    }
}

TEST_F(ShapeCommandTest, ObjIsWrittenWithItsMaterialOrNotAtAll)
{
    make({"disc.pgm", "a.obj", "--liquid", "honey", "--unit", "cm"});
    EXPECT_THAT(bytesOf("a.obj").substr(0, 200),
                AllOf(HasSubstr("# unit: centimetre"), HasSubstr("mtllib a.mtl\nusemtl honey")));
    EXPECT_THAT(bytesOf("a.mtl"), HasSubstr("newmtl honey"));
    // With --no-clobber, an existing material prevents the droplet, too.
    writeFile(directory() / "b.mtl", "mine");
    const auto kept = run({"disc.pgm", "b.obj", "--triangles", "500", "--no-clobber"});
    EXPECT_EQ(kept.exit_code, 4);
    EXPECT_THAT(kept.error, HasSubstr("b.mtl"));
    EXPECT_FALSE(fs::exists(directory() / "b.obj"));
    EXPECT_EQ(bytesOf("b.mtl"), "mine");
    const auto clash = run({"disc.pgm", "b.obj", "--json", "b.mtl"});
    EXPECT_EQ(clash.exit_code, 2);
    // Standard output has no material file.
    const auto stream = run({"disc.pgm", "-", "--format", "obj", "--triangles", "500"});
    EXPECT_EQ(stream.exit_code, 0);
    EXPECT_THAT(stream.output, Not(HasSubstr("mtllib")));
    EXPECT_THAT(run({"disc.pgm", "a.glb", "--triangles", "500", "--unit", "m"}).error,
                HasSubstr("--unit m has no effect: glb files are in metres"));
}

TEST_F(ShapeCommandTest, GivesTheSameBytesWithAnyNumberOfThreads)
{
    for (const char* format : {"glb", "gltf", "obj", "ply", "stl", "usda", "usdz", "3mf"}) {
        make({"two.pgm", "one", "--format", format, "-j", "1"});
        make({"two.pgm", "other", "--format", format, "-j", "2"});
        make({"two.pgm", "again", "--format", format});
        EXPECT_EQ(bytesOf("one"), bytesOf("other")) << format;
        EXPECT_EQ(bytesOf("one"), bytesOf("again")) << format;
    }
}

TEST_F(ShapeCommandTest, CompressionMakesFilesSmallerAndReportsItsError)
{
    make({"two.pgm", "plain.glb"});
    const json plain = report({"two.pgm", "plain.glb", "--compress", "none"})["output"];
    EXPECT_EQ(plain["compression"], "none");
    EXPECT_TRUE(plain["position_error_m"].is_null());
    EXPECT_TRUE(plain["normal_error_deg"].is_null());
    double size = plain["bytes"];
    for (const std::string compress : {"quantize", "meshopt"}) {
        const json output = report({"two.pgm", compress + ".glb", "--compress", compress})["output"];
        EXPECT_EQ(output["compression"], compress);
        EXPECT_EQ(output["bytes"], bytesOf(compress + ".glb").size());
        EXPECT_LT(output["bytes"], 0.8 * size);
        size = output["bytes"];
        // Half the diagonal of a step, with steps of at most the picture's 20 mm by 65535.
        EXPECT_GT(output["position_error_m"], 0.0);
        EXPECT_LT(output["position_error_m"], 0.87 * 20e-3 / 65535);
        EXPECT_GT(output["normal_error_deg"], 0.0);
        EXPECT_LT(output["normal_error_deg"], 0.1);
        make({"two.pgm", "again.glb", "--compress", compress, "-j", "1"});
        EXPECT_TRUE(bytesOf("again.glb") == bytesOf(compress + ".glb"));
        EXPECT_THAT(run({"two.pgm", "again.glb", "--compress", compress, "--triangles", "2k"}).error,
                    HasSubstr("closed; " + compress + ", vertices off by up to 0."));
        const auto comparison = run({"compare", "plain.glb", compress + ".glb", "--tolerance", "0.5um"});
        EXPECT_EQ(comparison.exit_code, 0) << comparison.error;
    }
}

TEST_F(ShapeCommandTest, FillRangeAddsASliderAndChangesNothingElse)
{
    make({"two.pgm", "plain.gltf", "--model", "linear"});
    const json plain = json::parse(bytesOf("plain.gltf"));
    const json with_range = report({"two.pgm", "slider.gltf", "--fill-range", "0.5..1.5", "--model", "linear"});
    const json slider = json::parse(bytesOf("slider.gltf"));
    EXPECT_EQ(with_range["fill"]["range"], json({0.5, 1.5}));
    EXPECT_EQ(slider["meshes"][0]["extras"], json({{"targetNames", {"volume"}}, {"fill_range", {0.5, 1.5}}}));
    EXPECT_EQ(slider["meshes"][0]["weights"], json({0.0}));
    EXPECT_EQ(slider["meshes"][0]["primitives"][0]["targets"].size(), 1U);
    EXPECT_FALSE(plain["meshes"][0].contains("weights"));
    const auto bounds = [](const json& file) {
        return file["accessors"][file["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
    };
    EXPECT_EQ(bounds(slider), bounds(plain));
    // On level ground, another fill raises the highest point by its height.
    const auto& change =
        slider["accessors"][slider["meshes"][0]["primitives"][0]["targets"][0]["POSITION"].get<std::size_t>()];
    EXPECT_NEAR(change["max"][1].get<double>(), with_range["shape"]["height_max_m"].get<double>(), 1e-9);

    make({"two.pgm", "one.glb", "--fill-range", "0..2", "--tilt", "40deg", "-j", "1"});
    make({"two.pgm", "other.glb", "--fill-range", "0..2", "--tilt", "40deg", "-j", "2"});
    EXPECT_EQ(bytesOf("one.glb"), bytesOf("other.glb"));
    EXPECT_TRUE(report({"two.pgm", "plain.glb"})["fill"]["range"].is_null());
}

/// Report without time and memory, which differ between runs.
json comparable(json report)
{
    report.erase("time_s");
    report.erase("peak_memory_bytes");
    return report;
}

TEST_F(ShapeCommandTest, GivesTheSameBytesOnEveryGroundWithAnyNumberOfThreads)
{
    const std::vector<std::vector<std::string>> physics{
        {"--model", "exact"},
        {"--model", "exact", "--tilt", "20deg", "--surface", "sphere:R=40mm"},
        {"--surface", "cylinder:R=-40mm,axis=30deg", "--no-penetration", "--tilt", "20deg"},
        {"--surface", "two.pgm", "--surface-depth", "0.1mm", "--model", "exact", "--no-penetration"}};
    for (const auto& options : physics) {
        SCOPED_TRACE(::testing::PrintToString(options));
        const auto make_at = [&](const char* name, const char* threads) {
            std::vector<std::string> arguments{"two.pgm", name, "-j", threads, "--contact-angle", "20deg"};
            arguments.insert(arguments.end(), options.begin(), options.end());
            make(arguments);
        };
        make_at("one.glb", "1");
        make_at("other.glb", "2");
        EXPECT_EQ(bytesOf("one.glb"), bytesOf("other.glb"));
    }
}

TEST_F(ShapeCommandTest, ReportsDifferOnlyInTimeAndMemory)
{
    const json first = report({"two.pgm", "a.glb"});
    EXPECT_EQ(comparable(first), comparable(report({"two.pgm", "a.glb"})));
}

TEST_F(ShapeCommandTest, ConfigurationFileIsEquivalentToOptions)
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

TEST_F(ShapeCommandTest, GroundAndGravityMayComeFromAConfigurationFile)
{
    writeFile(directory() / "settings.toml",
              "gravity = \"-1.62m/s2\"\ntilt = \"170deg\"\ntilt-direction = \"-45deg\"\nmodel = \"exact\"\n"
              "surface = \"cylinder:R=33mm,axis=-10deg\"\nno-penetration = true\n");
    make({"disc.pgm", "file.glb", "--config", "settings.toml"});
    make({"disc.pgm", "options.glb", "--gravity", "-1.62m/s2", "--tilt=170deg", "--tilt-direction", "-45deg", "--model",
          "exact", "--surface", "cylinder:axis=-10deg,R=33mm", "--no-penetration"});
    EXPECT_TRUE(bytesOf("file.glb") == bytesOf("options.glb"));
    // An object on the command line overrides the ground of the file.
    make({"disc.pgm", "cap.glb", "--open", "--contact-angle", "10deg"});
    const json report = this->report({"disc.pgm", "a.glb", "--config", "settings.toml", "--onto", "cap.glb", "--width",
                                      "19mm", "--no-penetration=false"});
    EXPECT_EQ(report["ground"]["kind"], "flat");
    EXPECT_EQ(report["onto"]["path"], "cap.glb");
}

TEST_F(ShapeCommandTest, CommandLineOverridesTheConfigurationFile)
{
    writeFile(directory() / "settings.toml", "width = \"9.6mm\"\nvolume = \"2uL\"\nopen = true\nverbose = true\n");
    // A height on the command line also overrides the volume of the file.
    const json report =
        this->report({"two.pgm", "a.glb", "--config", "settings.toml", "--height", "0.5mm", "--open=false"});
    EXPECT_EQ(report["fill"]["by"], "height_m");
    EXPECT_NEAR(report["input"]["pixel_size_m"], 1e-4, 1e-18);
    EXPECT_EQ(report["output"]["closed"], true);
}

TEST_F(ShapeCommandTest, ConfigurationStringsMayContainAnyCharacter)
{
    writeFile(directory() / "settings.toml", "json = \"a#b, \\\"c\\\".json\"\nquiet = true\ntriangles = 2000\n");
    EXPECT_EQ(run({"disc.pgm", "a.glb", "--config", "settings.toml"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(directory() / "a#b, \"c\".json"));
}

TEST_F(ShapeCommandTest, ReplacesOlderFilesCompletelyAndLeavesNoOthers)
{
    writeFile(directory() / "a.glb", std::string(1'000'000, 'x'));
    writeFile(directory() / "report.json", std::string(1'000'000, 'x'));
    const json report = this->report({"disc.pgm", "a.glb"});
    EXPECT_EQ(fs::file_size(directory() / "a.glb"), report["output"]["bytes"]);
    EXPECT_THAT(scratch().names(), ElementsAre("a.glb", "disc.pgm", "report.json", "two.pgm"));
}

TEST_F(ShapeCommandTest, NoClobberWritesNewFiles)
{
    make({"disc.pgm", "a.glb", "--no-clobber", "--json", "a.json"});
    EXPECT_TRUE(fs::exists(directory() / "a.glb"));
    EXPECT_TRUE(fs::exists(directory() / "a.json"));
}

TEST_F(ShapeCommandTest, SummaryShowsTheMainFigures)
{
    const auto result = run({"two.pgm", "two.glb", "--triangles", "2k", "--volume", "2uL", "--speck-size", "250"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, IsEmpty());
    for (const char* text :
         {"96 × 64 pixels", "bright is liquid (luma)", "hard edges", "1 speck dropped", "2 droplets, 0 holes", "mm²",
          "4 µL", "mm high", "contact angle", "smallest angle", "two.glb:", "kB", "closed"}) {
        EXPECT_THAT(result.error, HasSubstr(text));
    }
    EXPECT_THAT(result.error, Not(HasSubstr("memory")));
    EXPECT_THAT(result.error, Not(HasSubstr("\033"))) << "colours are for terminals";
}

TEST_F(ShapeCommandTest, VerboseAddsDropletsTimesAndMemory)
{
    const auto result = run({"two.pgm", "two.glb", "--triangles", "2k", "-v"});
    for (const char* text :
         {"72.8 mN/m", "9.81 m/s²", "tilt 0.0°", "capillary length 2.727 mm", "Bond number", "ground     flat\n", "µJ",
          "exact model, ", "simplicial", "pressure/Pa", "time ", "triangulate", "memory"}) {
        EXPECT_THAT(result.error, HasSubstr(text));
    }
    EXPECT_THAT(result.error, Not(HasSubstr("more, all in")));
    EXPECT_THAT(run({"disc.pgm", "a.glb", "--triangles", "2k", "-v", "--model", "exact", "--tilt", "20deg", "--surface",
                     "cylinder:R=33mm,axis=y", "--no-penetration", "--width", "8mm"})
                    .error,
                AllOf(HasSubstr("exact model"), HasSubstr("Newton step"), HasSubstr("tilt 20.0° downhill to -90.0°"),
                      HasSubstr("cylinder of radius 33 mm, axis at 90.0°, no penetration, 0 mm² left dry")));

    writeFile(directory() / "many.pgm",
              greymap(120, 120, [](int x, int y) { return x % 12 > 2 && y % 12 > 2 ? 255 : 0; }));
    EXPECT_THAT(run({"many.pgm", "many.glb", "-v", "--triangles", "20k"}).error,
                AllOf(HasSubstr("100 droplets"), HasSubstr("and 80 more")));
}

TEST_F(ShapeCommandTest, WarnsAboutSlopesBeyondTheLinearModel)
{
    const auto steep = run({"disc.pgm", "a.glb", "--contact-angle", "75deg", "--model", "linear", "--triangles", "2k"});
    EXPECT_EQ(steep.exit_code, 0);
    EXPECT_THAT(steep.error, HasSubstr("warning: "));
    EXPECT_THAT(
        run({"disc.pgm", "a.glb", "--contact-angle", "60deg", "--model", "linear", "--triangles", "2k", "-q"}).error,
        IsEmpty());
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

TEST_F(ShapeCommandTest, ProgressSaysHowMuchOfTheLiquidIsThere)
{
    const auto result =
        run({"disc.pgm", "a.stl", "--triangles", "2k", "--progress", "json", "--contact-angle", "120deg"});
    EXPECT_EQ(result.exit_code, 0);
    std::vector<double> shares;
    for (const std::string& line : result.errorLines()) {
        const json event = json::parse(line);
        if (event.contains("share")) {
            EXPECT_EQ(event["stage"], "solve");
            EXPECT_EQ(event["done"], false);
            shares.push_back(event["share"]);
        }
    }
    EXPECT_GE(shares.size(), 3U);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_EQ(shares.back(), 1.0);
}

TEST_F(ShapeCommandTest, ProgressOfAFailedRunIsNotDone)
{
    const auto result = run({"missing.pgm", "a.glb", "--progress", "json"});
    EXPECT_EQ(result.exit_code, 3);
    ASSERT_THAT(result.errorLines(), SizeIs(2));
    EXPECT_EQ(json::parse(result.errorLines()[0])["stage"], "read");
    EXPECT_THAT(result.errorLines()[1], StartsWith("droplet-shape: "));
}

TEST_F(ShapeCommandTest, SlowRunShowsABarOnATerminalAndErasesIt)
{
    CommandOptions options;
    options.error_is_terminal = true;
    options.input = bytesOf("disc.pgm");
    options.input_waits_for = "[....";  // the picture is sent after the bar appears
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

TEST_F(ShapeCommandTest, UsesColoursOnATerminalUnlessForbidden)
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

TEST_F(ShapeCommandTest, NamesThatLookLikeOptionsMayFollowTwoDashes)
{
    writeFile(directory() / "-in.pgm", discPicture(64, 24.0));
    make({"--json=r.json", "./-in.pgm", "a.glb"});
    EXPECT_EQ(run({"-q", "--", "-in.pgm", "-out.glb"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(directory() / "-out.glb"));
}

/// A dark blot and a dark ring on paper that is lit from the left; 400 × 300 pixels.
std::string unevenInk()
{
    return greymap(400, 300, [](int x, int y) {
        const double blot = std::hypot(x - 120.0, y - 150.0) - 70.0;
        const double ring = std::max(std::hypot(x - 300.0, y - 160.0) - 50.0, 25.0 - std::hypot(x - 300.0, y - 160.0));
        const double covered = std::clamp(0.5 - std::min(blot, ring), 0.0, 1.0);
        return static_cast<int>(std::lround((240.0 - 0.5 * x) * (1.0 - 0.92 * covered)));
    });
}

TEST_F(ShapeCommandTest, MakesAndWritesTheMaskOfAPhotograph)
{
    writeFile(directory() / "ink.pgm", unevenInk());
    const auto result =
        run({"ink.pgm", "ink.glb", "--mask-out", "mask.png", "--json", "ink.json", "--triangles", "2k", "-v"});
    ASSERT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.error, HasSubstr("by adaptive, "));
    const json report = json::parse(bytesOf("ink.json"));
    EXPECT_EQ(report["input"]["segment"], "adaptive");
    EXPECT_GT(report["input"]["segment_confidence"], 0.5);
    EXPECT_EQ(report["mesh"]["droplets"], 2);
    EXPECT_EQ(report["mesh"]["holes"], 1);
    const double truth = std::numbers::pi * (70 * 70 + 50 * 50 - 25 * 25) * std::pow(20e-3 / 400, 2);
    EXPECT_NEAR(report["mesh"]["footprint_area_m2"].get<double>() / truth, 1.0, 0.01);
    // The written mask gives the same droplet.
    make({"mask.png", "again.glb", "--segment", "threshold", "--json", "again.json"});
    const json again = json::parse(bytesOf("again.json"));
    EXPECT_EQ(again["mesh"]["footprint_area_m2"], report["mesh"]["footprint_area_m2"]);

    make({"ink.pgm", "one.glb", "--keep", "1", "--smooth", "0.2mm", "--fill-holes", "9mm2", "--json", "one.json",
          "--mask-out", "one.png"});
    const json one = json::parse(bytesOf("one.json"));
    EXPECT_EQ(one["mesh"]["droplets"], 1);
    EXPECT_EQ(one["mesh"]["holes"], 0);
    const auto depth_of = [&](const char* png) { return static_cast<int>(bytesOf(png).at(24)); };
    EXPECT_EQ(depth_of("mask.png"), 16) << "of a photograph, rims have levels between those of 8 bits";
    make({"two.pgm", "two.glb", "--mask-out", "two.png"});
    EXPECT_EQ(depth_of("two.png"), 8);
    EXPECT_THAT(run({"ink.pgm", "a.glb", "--mask-out", "a.glb"}).error, HasSubstr("--mask-out"));
    for (const char* segment : {"adaptive", "grabcut"}) {
        make({"ink.pgm", "s.glb", "--segment", segment, "--json", "s.json"});
        EXPECT_EQ(json::parse(bytesOf("s.json"))["input"]["segment"], segment);
    }
}

TEST_F(ShapeCommandTest, RefusesAPictureWithoutAClearMaskUnlessForced)
{
    const std::string glow = greymap(300, 200, [](int x, int y) {
        return std::max(0, 250 - static_cast<int>(1.2 * std::hypot(x - 150.0, y - 90.0)));
    });
    writeFile(directory() / "glow.pgm", glow);
    const auto result = run({"glow.pgm", "glow.glb", "-q"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.error, AllOf(HasSubstr("glow.pgm: does not look like a footprint"), HasSubstr("--segment")));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1);
    EXPECT_FALSE(fs::exists(directory() / "glow.glb"));
    const auto forced = run({"glow.pgm", "glow.glb", "--threshold", "0.5", "--triangles", "2k"});
    EXPECT_EQ(forced.exit_code, 0) << forced.error;
    EXPECT_THAT(forced.error, HasSubstr("hardly a mask"));
    make({"glow.pgm", "glow.glb", "--segment", "threshold"});
}

TEST_F(ShapeCommandTest, WarnsAboutATowerEvenIfQuiet)
{
    const auto result = run(
        {"disc.pgm", "a.glb", "--height", "40mm", "--model", "linear", "--json", "a.json", "--triangles", "2k", "-q"});
    ASSERT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.error, AllOf(HasSubstr("warning: "), HasSubstr("40 mm high, but a puddle")));
    const json report = json::parse(bytesOf("a.json"));
    EXPECT_LT(report["shape"]["height_bound_m"], 4e-3);
    EXPECT_THAT(report["warnings"][0], HasSubstr("puddle"));
    make({"disc.pgm", "b.glb", "--tilt", "20deg", "--json", "b.json"});
    EXPECT_TRUE(json::parse(bytesOf("b.json"))["shape"]["height_bound_m"].is_null());
}

TEST_F(ShapeCommandTest, TakesOneColourAsLiquid)
{
    writeFile(
        directory() / "icon.svg",
        R"(<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">)"
        R"(<circle cx="50" cy="50" r="45" fill="#e30613"/><rect x="20" y="40" width="60" height="20" fill="white"/></svg>)");
    make({"icon.svg", "sign.glb", "--colour", "white", "--json", "sign.json", "--width", "10mm"});
    const json report = json::parse(bytesOf("sign.json"));
    EXPECT_EQ(report["input"]["segment"], "colour");
    EXPECT_NEAR(report["mesh"]["footprint_area_m2"], 12e-6, 0.02e-6);
    const auto lost = run({"icon.svg", "lost.glb", "--colour", "green"});
    EXPECT_EQ(lost.exit_code, 3);
    EXPECT_THAT(lost.error, AllOf(HasSubstr("#008000"), HasSubstr("#ffffff")));
}

TEST_F(ShapeCommandTest, MakesABeadThatHangsOverItsRim)
{
    const std::vector<std::string> bead{"disc.pgm", "bead.glb",  "--model", "exact",    "--contact-angle",
                                        "140deg",   "--gravity", "0m/s2",   "--liquid", "mercury",
                                        "--width",  "4mm",       "--json",  "bead.json"};
    make(bead);
    const json report = json::parse(bytesOf("bead.json"));
    const json& shape = report["shape"];
    EXPECT_TRUE(report["output"]["closed"].get<bool>());
    EXPECT_NEAR(shape["contact_angle_deg"]["mean"].get<double>(), 140.0, 1e-4);
    // A part of a ball on a disc of radius 1.5 mm leans out by 1.5 (1/sin 140° − 1) mm.
    EXPECT_NEAR(shape["overhang_m"].get<double>(), 1.5e-3 * (1.0 / std::sin(140.0 * std::numbers::pi / 180.0) - 1.0),
                1e-5);
    std::vector<std::string> evolver = bead;
    evolver.insert(evolver.end(), {"--export-evolver", "bead.fe"});
    make(evolver);
    EXPECT_THAT(bytesOf("bead.fe"), HasSubstr("\nfreely\n"));
}

TEST_F(ShapeCommandTest, BeadsShareTheirLiquidOnAGutter)
{
    writeFile(directory() / "two.pgm", greymap(96, 64, [](int x, int y) {
                  return std::hypot(x - 24, y - 32) < 14 || std::hypot(x - 70, y - 32) < 10 ? 255 : 0;
              }));
    const json shared = report({"two.pgm", "two.glb", "--fill", "total", "--contact-angle", "95deg", "--width", "12mm",
                                "--surface", "cylinder:R=-20mm,axis=x"});
    EXPECT_EQ(shared["model"], "parametric");
    EXPECT_TRUE(shared["output"]["closed"].get<bool>());
    EXPECT_NEAR(shared["shape"]["contact_angle_deg"]["mean"].get<double>(), 95.0, 1e-4);
    ASSERT_EQ(shared["droplets"].size(), 2U);
    EXPECT_EQ(shared["droplets"][0]["pressure_pa"], shared["droplets"][1]["pressure_pa"]);
    EXPECT_EQ(shared["shape"]["pressure_pa"], shared["droplets"][0]["pressure_pa"]);
    EXPECT_EQ(shared["shape"]["depth_max_m"], 0.0);
}

TEST_F(ShapeCommandTest, LeansOverAnInnerCorner)
{
    writeFile(directory() / "corner.pgm", greymap(64, 64, [](int x, int y) {
                  return x > 8 && y > 8 && x < 56 && y < 56 && (x < 24 || y > 40) ? 255 : 0;
              }));
    make({"corner.pgm", "corner.glb", "--model", "exact", "--contact-angle", "60deg", "--width", "10mm", "--json",
          "corner.json"});
    const json report = json::parse(bytesOf("corner.json"));
    EXPECT_TRUE(report["output"]["closed"].get<bool>());
    EXPECT_THAT(report["warnings"], IsEmpty());
    EXPECT_NEAR(report["shape"]["contact_angle_deg"]["mean"].get<double>(), 60.0, 1e-4);
    EXPECT_GT(report["shape"]["contact_angle_deg"]["max"].get<double>(), 90.0);
    EXPECT_GT(report["shape"]["overhang_m"].get<double>(), 0.0);
}

}  // namespace
}  // namespace droplet
