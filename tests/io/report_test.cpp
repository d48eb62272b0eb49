// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/version.h"

namespace droplet {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// Report in which all numbers differ, so that exchanged keys are found.
Report sampleReport()
{
    Report report;
    report.input = {"in.png", {},   640,   480,   true, true, 3.125e-5, Channel::Alpha,
                    true,     0.25, 0.125, 0.875, true, 7,    2.5};
    report.output = {"out.glb", Format::Glb, 123456, 900, 1700, 0, {true, true, 4, 2, 0}};
    report.physics.liquid = {"honey", 0.055, 1417.0};
    report.physics.gravity = 1.62;
    report.physics.fill = {FillBy::ContactAngle, 30.0 * kDegree, FillSharing::Each};
    report.physics.tilt = 35.0 * kDegree;
    report.physics.tilt_direction = -60.0 * kDegree;
    report.physics.model = Model::Exact;
    report.physics.no_penetration = true;
    report.ground = {GroundKind::Cylinder, std::nullopt, std::nullopt, 0.033, 75.0 * kDegree};
    report.solve = {"simplicial-llt", 321, 1, 6, 3e-16, Termination::Converged};
    report.mesh = {400, 700, 25.0 * kDegree, 3};
    ShapeFigures& total = report.total;
    total.footprint_area = 1.1e-4;
    total.rim_length = 0.21;
    total.dry_area = 2.2e-6;
    total.volume = 3.1e-8;
    total.height_max = 1.5e-3;
    total.depth_max = 1.6e-5;
    total.liquid_area = 1.3e-4;
    total.linear_area = 1.4e-4;
    total.steep_area = 1.1e-5;
    total.surface_energy = 9e-6;
    total.gravity_energy = 4.1e-7;
    total.slope_max = 55.0 * kDegree;
    total.bond_number = 0.75;
    total.projected_width = 0.0125;
    total.contact_angle = {10 * kDegree, 30 * kDegree, 50 * kDegree, {1e-3, 2e-3}, {-3e-3, -4e-3}};
    DropletReport first;
    first.figures = report.total;
    first.figures.volume = 2e-8;
    first.holes = 2;
    first.pressure = 33.5;
    DropletReport second = first;
    second.figures.volume = 1.1e-8;
    second.holes = 1;
    second.pressure = 44.5;
    report.droplets = {first, second};
    report.warnings = {"a \"quoted\" warning"};
    report.time = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
    report.time_total = 2.9;
    report.peak_memory = 987654321;
    return report;
}

std::string written(const Report& report)
{
    std::ostringstream out;
    writeReport(out, report);
    return out.str();
}

std::vector<std::string> keysOf(const std::string& text, const std::string& pointer)
{
    // ordered_json, because "the same bytes" includes the order.
    const auto parsed = nlohmann::ordered_json::parse(text);
    std::vector<std::string> keys;
    for (const auto& item : parsed[nlohmann::ordered_json::json_pointer(pointer)].items()) {
        keys.push_back(item.key());
    }
    return keys;
}

TEST(Report, HoldsEveryKeyOfTheSchema)
{
    using ::testing::IsSupersetOf;
    const std::string text = written(sampleReport());
    EXPECT_THAT(keysOf(text, ""), IsSupersetOf({"schema", "version", "model", "input", "output", "liquid", "ground",
                                                "no_penetration", "onto", "mesh", "solve", "shape", "droplets",
                                                "warnings", "time_s", "peak_memory_bytes"}));
    EXPECT_THAT(keysOf(text, "/input"),
                IsSupersetOf({"path", "width_px", "height_px", "pixel_size_m", "channel", "inverted", "threshold"}));
    EXPECT_THAT(keysOf(text, "/output"), IsSupersetOf({"path", "format", "bytes", "vertices", "triangles", "closed"}));
    EXPECT_THAT(keysOf(text, "/liquid"),
                IsSupersetOf({"name", "surface_tension_n_per_m", "density_kg_per_m3", "gravity_m_per_s2", "tilt_deg",
                              "tilt_direction_deg", "capillary_length_m"}));
    EXPECT_THAT(keysOf(text, "/mesh"), IsSupersetOf({"vertices", "triangles", "min_angle_deg", "footprint_area_m2",
                                                     "rim_length_m", "droplets", "holes"}));
    EXPECT_THAT(keysOf(text, "/solve"),
                IsSupersetOf({"method", "unknowns", "iterations", "newton_steps", "residual", "converged"}));
    EXPECT_THAT(keysOf(text, "/shape"),
                IsSupersetOf({"volume_m3", "volume_ul", "pressure_pa", "height_max_m", "depth_max_m", "dry_area_m2",
                              "liquid_area_m2", "linear_area_m2", "steep_area_m2", "surface_energy_j",
                              "gravity_energy_j", "energy_j", "bond_number", "contact_angle_deg", "slope_max_deg",
                              "projected_width_m", "would_slide", "driving_force_n", "retention_force_n"}));
    EXPECT_THAT(keysOf(text, "/shape/contact_angle_deg"), IsSupersetOf({"min", "mean", "max", "min_at_m", "max_at_m"}));
    EXPECT_THAT(keysOf(text, "/droplets/1"), IsSupersetOf({"footprint_area_m2", "rim_length_m", "holes", "volume_m3",
                                                           "pressure_pa", "height_max_m", "contact_angle_deg"}));
    EXPECT_THAT(keysOf(text, "/droplets/1/contact_angle_deg"), IsSupersetOf({"min", "mean", "max"}));
    EXPECT_THAT(keysOf(text, "/time_s"),
                IsSupersetOf({"read", "trace", "triangulate", "assemble", "solve", "loft", "write", "total"}));
}

TEST(Report, PutsEveryValueUnderItsOwnName)
{
    const json report = json::parse(written(sampleReport()));
    EXPECT_EQ(report["schema"], "droplet-shape.report/1");
    EXPECT_EQ(report["version"], kVersion);
    EXPECT_EQ(report["model"], "exact");

    const json& input = report["input"];
    EXPECT_EQ(input["path"], "in.png");
    EXPECT_EQ(input["width_px"], 640);
    EXPECT_EQ(input["height_px"], 480);
    EXPECT_EQ(input["drawn"], true);
    EXPECT_EQ(input["own_size"], true);
    EXPECT_EQ(input["pixel_size_m"], 3.125e-5);
    EXPECT_EQ(input["channel"], "alpha");
    EXPECT_EQ(input["inverted"], true);
    EXPECT_EQ(input["threshold"], 0.25);
    EXPECT_EQ(input["level_dry"], 0.125);
    EXPECT_EQ(input["level_liquid"], 0.875);
    EXPECT_EQ(input["anti_aliased"], true);
    EXPECT_EQ(input["specks_dropped"], 7);
    EXPECT_EQ(input["largest_speck_px2"], 2.5);

    const json& output = report["output"];
    EXPECT_EQ(output["path"], "out.glb");
    EXPECT_EQ(output["format"], "glb");
    EXPECT_EQ(output["bytes"], 123456);
    EXPECT_EQ(output["vertices"], 900);
    EXPECT_EQ(output["triangles"], 1700);
    EXPECT_EQ(output["closed"], true);
    EXPECT_EQ(output["euler"], 4);
    EXPECT_EQ(output["components"], 2);

    const json& liquid = report["liquid"];
    EXPECT_EQ(liquid["name"], "honey");
    EXPECT_EQ(liquid["surface_tension_n_per_m"], 0.055);
    EXPECT_EQ(liquid["density_kg_per_m3"], 1417.0);
    EXPECT_EQ(liquid["gravity_m_per_s2"], 1.62);
    EXPECT_NEAR(liquid["tilt_deg"], 35.0, 1e-12);
    EXPECT_NEAR(liquid["tilt_direction_deg"], -60.0, 1e-12);
    EXPECT_NEAR(liquid["capillary_length_m"], std::sqrt(0.055 / (1417.0 * 1.62)), 1e-15);

    const json& ground = report["ground"];
    EXPECT_EQ(ground["kind"], "cylinder");
    EXPECT_EQ(ground["radius_m"], 0.033);
    EXPECT_NEAR(ground["axis_deg"], 75.0, 1e-12);
    EXPECT_EQ(report["no_penetration"], true);

    EXPECT_EQ(report["fill"]["by"], "contact_angle_deg");
    EXPECT_NEAR(report["fill"]["amount"], 30.0, 1e-12);
    EXPECT_EQ(report["fill"]["sharing"], "each");

    const json& mesh = report["mesh"];
    EXPECT_EQ(mesh["vertices"], 400);
    EXPECT_EQ(mesh["triangles"], 700);
    EXPECT_NEAR(mesh["min_angle_deg"], 25.0, 1e-12);
    EXPECT_EQ(mesh["footprint_area_m2"], 1.1e-4);
    EXPECT_EQ(mesh["rim_length_m"], 0.21);
    EXPECT_EQ(mesh["droplets"], 2);
    EXPECT_EQ(mesh["holes"], 3);

    EXPECT_EQ(report["solve"], json({{"method", "simplicial-llt"},
                                     {"unknowns", 321},
                                     {"iterations", 1},
                                     {"newton_steps", 6},
                                     {"residual", 3e-16},
                                     {"converged", true}}));

    const json& shape = report["shape"];
    EXPECT_EQ(shape["volume_m3"], 3.1e-8);
    EXPECT_NEAR(shape["volume_ul"], 31.0, 1e-12);
    EXPECT_EQ(shape["height_max_m"], 1.5e-3);
    EXPECT_EQ(shape["depth_max_m"], 1.6e-5);
    EXPECT_EQ(shape["dry_area_m2"], 2.2e-6);
    EXPECT_EQ(shape["liquid_area_m2"], 1.3e-4);
    EXPECT_EQ(shape["linear_area_m2"], 1.4e-4);
    EXPECT_EQ(shape["steep_area_m2"], 1.1e-5);
    EXPECT_EQ(shape["surface_energy_j"], 9e-6);
    EXPECT_EQ(shape["gravity_energy_j"], 4.1e-7);
    EXPECT_EQ(shape["energy_j"], 9e-6 + 4.1e-7);
    EXPECT_EQ(shape["bond_number"], 0.75);
    EXPECT_EQ(shape["projected_width_m"], 0.0125);
    EXPECT_NEAR(shape["slope_max_deg"], 55.0, 1e-12);
    EXPECT_NEAR(shape["contact_angle_deg"]["min"], 10.0, 1e-12);
    EXPECT_NEAR(shape["contact_angle_deg"]["mean"], 30.0, 1e-12);
    EXPECT_NEAR(shape["contact_angle_deg"]["max"], 50.0, 1e-12);
    EXPECT_EQ(shape["contact_angle_deg"]["min_at_m"], json({1e-3, 2e-3}));
    EXPECT_EQ(shape["contact_angle_deg"]["max_at_m"], json({-3e-3, -4e-3}));

    EXPECT_EQ(report["droplets"][0]["volume_m3"], 2e-8);
    EXPECT_EQ(report["droplets"][0]["holes"], 2);
    EXPECT_EQ(report["droplets"][0]["pressure_pa"], 33.5);
    EXPECT_EQ(report["droplets"][1]["volume_m3"], 1.1e-8);
    EXPECT_EQ(report["droplets"][1]["pressure_pa"], 44.5);
    EXPECT_EQ(report["warnings"], json({"a \"quoted\" warning"}));
    EXPECT_EQ(report["time_s"]["read"], 0.1);
    EXPECT_EQ(report["time_s"]["write"], 0.7);
    EXPECT_EQ(report["time_s"]["total"], 2.9);
    EXPECT_EQ(report["peak_memory_bytes"], 987654321);
}

TEST(Report, HasNoCommonPressureIfDropletsDiffer)
{
    Report report = sampleReport();
    EXPECT_TRUE(json::parse(written(report))["shape"]["pressure_pa"].is_null());
    report.pressure = 12.25;
    EXPECT_EQ(json::parse(written(report))["shape"]["pressure_pa"], 12.25);
}

TEST(Report, DropletsHaveTheKeysOfTheShape)
{
    const std::string text = written(sampleReport());
    auto keys = keysOf(text, "/shape");
    keys.insert(keys.begin(), {"footprint_area_m2", "rim_length_m", "holes"});
    keys.insert(keys.end(), {"colour", "limited_by"});
    EXPECT_EQ(keysOf(text, "/droplets/0"), keys);
}

TEST(Report, NamesEveryModelAndGround)
{
    Report report = sampleReport();
    report.physics.model = Model::Linear;
    EXPECT_EQ(json::parse(written(report))["model"], "linear");
    report.ground = {};
    EXPECT_EQ(
        json::parse(written(report))["ground"],
        json(
            {{"kind", "flat"}, {"path", nullptr}, {"depth_m", nullptr}, {"radius_m", nullptr}, {"axis_deg", nullptr}}));
    report.ground = {GroundKind::HeightMap, "hills.png", 1.25e-3, std::nullopt, std::nullopt};
    EXPECT_EQ(json::parse(written(report))["ground"], json({{"kind", "height map"},
                                                            {"path", "hills.png"},
                                                            {"depth_m", 1.25e-3},
                                                            {"radius_m", nullptr},
                                                            {"axis_deg", nullptr}}));
    report.ground = {GroundKind::Sphere, std::nullopt, std::nullopt, -0.04, std::nullopt};
    EXPECT_EQ(json::parse(written(report))["ground"]["kind"], "sphere");
    EXPECT_EQ(json::parse(written(report))["ground"]["radius_m"], -0.04);
}

TEST(Report, HasNoCapillaryLengthWithoutWeight)
{
    Report report = sampleReport();
    report.physics.gravity = 0.0;
    EXPECT_TRUE(json::parse(written(report))["liquid"]["capillary_length_m"].is_null());
}

TEST(Report, SaysWhetherDropletsWouldSlideOnlyWhenAsked)
{
    Report report = sampleReport();
    const json silent = json::parse(written(report));
    for (const json& shape : {silent["shape"], silent["droplets"][0], silent["droplets"][1]}) {
        for (const char* key : {"would_slide", "driving_force_n", "retention_force_n"}) {
            EXPECT_TRUE(shape.at(key).is_null()) << key;
        }
    }
    EXPECT_TRUE(silent["liquid"]["advancing_deg"].is_null());

    // All droplets together are held, but one of them slides.
    report.hysteresis = Hysteresis{100 * kDegree, 20 * kDegree};
    report.retention = Retention{3e-6, 5e-6};
    report.droplets[0].retention = Retention{1e-6, 4e-6};
    report.droplets[1].retention = Retention{2e-6, 1e-6};
    const json asked = json::parse(written(report));
    EXPECT_NEAR(asked["liquid"]["advancing_deg"], 100.0, 1e-12);
    EXPECT_NEAR(asked["liquid"]["receding_deg"], 20.0, 1e-12);
    EXPECT_EQ(asked["shape"]["driving_force_n"], 3e-6);
    EXPECT_EQ(asked["shape"]["retention_force_n"], 5e-6);
    EXPECT_EQ(asked["shape"]["would_slide"], true);
    EXPECT_EQ(asked["droplets"][0]["would_slide"], false);
    EXPECT_EQ(asked["droplets"][1]["would_slide"], true);
    EXPECT_EQ(asked["droplets"][1]["driving_force_n"], 2e-6);
    EXPECT_EQ(asked["droplets"][1]["retention_force_n"], 1e-6);
    report.droplets[1].retention = Retention{1e-6, 1e-6};
    EXPECT_EQ(json::parse(written(report))["shape"]["would_slide"], false);
}

TEST(Report, HoldsTheObjectUnderTheDroplets)
{
    Report report = sampleReport();
    EXPECT_TRUE(json::parse(written(report))["onto"].is_null());
    report.onto = ObjectReport{"can.glb", 5, 3, 2, 1, 0.5, 1.25};
    EXPECT_EQ(json::parse(written(report))["onto"], json({{"path", "can.glb"},
                                                          {"droplets_laid", 5},
                                                          {"droplets_left_out", 3},
                                                          {"flipped_charts", 2},
                                                          {"overlapping_charts", 1},
                                                          {"least_scale", 0.5},
                                                          {"most_scale", 1.25}}));
}

TEST(Report, KeepsEveryDigit)
{
    Report report = sampleReport();
    report.total.volume = 0.1 + 0.2;
    report.total.gravity_energy = std::numeric_limits<double>::denorm_min();
    const json shape = json::parse(written(report))["shape"];
    EXPECT_EQ(shape["volume_m3"].get<double>(), 0.1 + 0.2);
    EXPECT_EQ(shape["gravity_energy_j"].get<double>(), std::numeric_limits<double>::denorm_min());
}

TEST(Report, RefusesNumbersJsonCannotHoldBeforeWritingAnything)
{
    Report report = sampleReport();
    report.droplets[1].figures.contact_angle.max = std::numeric_limits<double>::quiet_NaN();
    std::ostringstream out;
    try {
        writeReport(out, report);
        FAIL() << "NaN was written";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::NoSuchDroplet);
        EXPECT_THAT(error.what(), HasSubstr("droplets.1.contact_angle_deg.max"));
    }
    EXPECT_EQ(out.str(), "");
    report = sampleReport();
    report.pressure = std::numeric_limits<double>::infinity();
    EXPECT_THROW(written(report), Error);
}

TEST(Report, TakesPathsOfAnyBytes)
{
    Report report = sampleReport();
    report.input.path = "caf\xe9.png";  // Latin-1
    EXPECT_EQ(json::parse(written(report))["input"]["path"], "caf\ufffd.png");
    report.input.path = "a\n\"b\\\x01.png";
    EXPECT_EQ(json::parse(written(report))["input"]["path"], report.input.path);
}

TEST(Report, IsTheSameTextEveryTime)
{
    EXPECT_EQ(written(sampleReport()), written(sampleReport()));
}

}  // namespace
}  // namespace droplet
