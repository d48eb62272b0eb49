// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape wind-tunnel`: lists and ranges, tables, charts, traces, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "cli/refusal.h"
#include "droplet/drawing/picture.h"
#include "droplet/units.h"
#include "droplet/wind/tunnel.h"
#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using testing::CommandResult;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::readFile;
using testing::runDroplet;
using ::testing::SizeIs;
using ::testing::StartsWith;
using Json = nlohmann::ordered_json;

CommandResult tunnel(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "wind-tunnel");
    return runDroplet(arguments);
}

Json reportOf(std::vector<std::string> arguments)
{
    arguments.insert(arguments.end(), {"--json", "-", "--quiet"});
    const CommandResult result = tunnel(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.error;
    EXPECT_EQ(result.error, "");
    return result.exit_code == 0 ? Json::parse(result.output) : Json();
}

std::vector<double> windsOf(const std::string& list)
{
    return reportOf({"--volume", "30uL", "--wind-speed", list}).at("runs").at(0).at("wind_m_per_s");
}

std::vector<double> volumesOf(const std::string& list)
{
    const Json report = reportOf({"--wind-speed", "5m/s", "--volume", list});
    std::vector<double> volumes;
    for (const Json& one : report.at("runs").at(0).at("cases")) {
        volumes.push_back(one.at("volume_m3"));
    }
    return volumes;
}

// ---------------------------------------------------------------------------------------------- lists and ranges

TEST(ValueList, UnitIsGivenOnceOrForEachValue)
{
    EXPECT_THAT(windsOf("1m/s,2m/s,3m/s"), ElementsAre(1.0, 2.0, 3.0));
    EXPECT_THAT(windsOf("1,2,3m/s"), ElementsAre(1.0, 2.0, 3.0));
    EXPECT_THAT(windsOf("1m/s,2,3"), ElementsAre(1.0, 2.0, 3.0));
    EXPECT_THAT(windsOf("36,72km/h,5m/s"), ElementsAre(10.0, 20.0, 5.0));
    EXPECT_THAT(windsOf("3m/s, 1 m/s"), ElementsAre(3.0, 1.0));
    EXPECT_THAT(windsOf("0m/s"), ElementsAre(0.0));
}

TEST(ValueList, RangeContainsItsBeginAndItsEndIfAStepMeetsIt)
{
    EXPECT_THAT(windsOf("0..2m/s:0.5"), ElementsAre(0.0, 0.5, 1.0, 1.5, 2.0));
    EXPECT_THAT(windsOf("0..2:0.5m/s"), ElementsAre(0.0, 0.5, 1.0, 1.5, 2.0));
    EXPECT_THAT(windsOf("0m/s..2m/s:0.5m/s"), ElementsAre(0.0, 0.5, 1.0, 1.5, 2.0));
    EXPECT_THAT(windsOf("0..2m/s:0.75"), ElementsAre(0.0, 0.75, 1.5));
    EXPECT_THAT(windsOf("2..2m/s:1"), ElementsAre(2.0));
    EXPECT_THAT(windsOf("1,4..6m/s:1,9"), ElementsAre(1.0, 4.0, 5.0, 6.0, 9.0));
    EXPECT_THAT(windsOf("0..1m/s:500mm/s"), ElementsAre(0.0, 0.5, 1.0));
    EXPECT_THAT(windsOf("0..16m/s:0.25"), SizeIs(65));
}

// Values of a range equal single values to the last bit.
TEST(ValueList, RangesContainExactlyTheWrittenNumbers)
{
    const auto range = volumesOf("10..100uL:10");
    EXPECT_EQ(range, volumesOf("10,20,30,40,50,60,70,80,90,100uL"));
    EXPECT_EQ(range[2], parseQuantity("30uL", Dimension::Volume));
    EXPECT_EQ(windsOf("0..1m/s:0.1")[3], 0.3);
    EXPECT_EQ(windsOf("0..1m/s:0.1").back(), 1.0);
}

TEST(ValueList, PlainNumbersHaveNoUnit)
{
    const Json report = reportOf({"--hysteresis", "0.05,0.1..0.3:0.1", "--volume", "30uL", "--wind-speed", "5m/s"});
    std::vector<double> found;
    for (const Json& one : report.at("runs").at(0).at("cases")) {
        found.push_back(one.at("hysteresis"));
    }
    EXPECT_THAT(found, ElementsAre(0.05, 0.1, 0.2, 0.3));
}

class WindTunnelRefusal : public testing::RefusalTest {
protected:
    void expectRefused(std::vector<std::string> arguments, const std::vector<std::string>& words) const
    {
        arguments.insert(arguments.begin(), "wind-tunnel");
        expectRefusal(arguments, 2, words);
    }
};

TEST_F(WindTunnelRefusal, RefusesWrongLists)
{
    expectRefused({"--volume", "30"}, {"--volume", "no unit"});
    expectRefused({"--volume", "30m/s"}, {"--volume", "not a volume"});
    expectRefused({"--volume", "10..100uL"}, {"--volume", "'10..100uL'", "step"});
    expectRefused({"--volume", ""}, {"--volume"});
    expectRefused({"--volume", "10uL,"}, {"--volume", "10uL,"});
    expectRefused({"--volume", "10,,20uL"}, {"--volume"});
    expectRefused({"--volume", "1e999uL"}, {"--volume", "finite"});
    expectRefused({"--volume", "nanuL"}, {"--volume"});
    expectRefused({"--volume", "0uL"}, {"--volume", "'0uL'", "from 0.001nL to 1L"});
    expectRefused({"--volume", "10uL,2L"}, {"--volume", "'2L'"});
    expectRefused({"--wind-speed", "-1m/s"}, {"--wind-speed", "from 0m/s to 300m/s"});
    expectRefused({"--wind-speed", "0..16m/s:0"}, {"--wind-speed", "step over 0"});
    expectRefused({"--wind-speed", "0..16m/s:-1"}, {"--wind-speed", "step over 0"});
    expectRefused({"--wind-speed", "16..0m/s:1"}, {"--wind-speed", "smaller to a larger"});
    expectRefused({"--wind-speed", "0..300m/s:0.0000001"}, {"--wind-speed", "at most 1000000"});
    expectRefused({"--wind-speed", "0..16m/s:1kg"}, {"--wind-speed", "not a speed"});
    expectRefused({"--wind-speed", "0..8..16m/s:1"}, {"--wind-speed"});
    expectRefused({"--hysteresis", "0.5uL"}, {"--hysteresis", "from 0 to 2"});
    expectRefused({"--hysteresis", "2.1"}, {"--hysteresis", "from 0 to 2"});
    expectRefused({"--slope", "91deg"}, {"--slope", "from 0deg to 90deg"});
    expectRefused({"--volume", "1..1000uL:1", "--wind-speed", "0..100m/s:0.001"},
                  {"--volume", "100001000", "10000000"});
}

TEST_F(WindTunnelRefusal, RefusesWrongParameters)
{
    expectRefused({"--preset", "kaneda"}, {"--preset", "'kaneda'", "thesis, hashimoto"});
    expectRefused({"--preset", "thesis,thesis"}, {"--preset"});
    expectRefused({"--contact-angle", "180deg"}, {"--contact-angle", "from 1deg to 179deg"});
    expectRefused({"--sliding-angle", "95deg"}, {"--sliding-angle"});
    expectRefused({"--sliding-volume", "30uL"}, {"--sliding-volume needs --sliding-angle"});
    expectRefused({"--sliding-angle", "80deg", "--sliding-volume", "10mL"}, {"--sliding-angle", "no contact angles"});
    expectRefused({"--sliding-angle", "10deg", "--hysteresis", "0.1"}, {"--sliding-angle", "--hysteresis"});
    expectRefused({"--drag-coefficient", "-1"}, {"--drag-coefficient", "from 0 to 100"});
    expectRefused({"--boundary-layer", "2m"}, {"--boundary-layer"});
    expectRefused({"--profile-exponent", "0.5mm"}, {"--profile-exponent"});
    expectRefused({"--viscosity-factor", "sticky"}, {"--viscosity-factor", "artistic"});
    expectRefused({"--viscosity-factor", "-1Pa.s"}, {"--viscosity-factor"});
    expectRefused({"--kinetic-fraction", "1.5"}, {"--kinetic-fraction", "from 0 to 1"});
    expectRefused({"--liquid", "tar"}, {"--liquid", "'tar'"});
    expectRefused({"--density", "0kg/m3"}, {"--density"});
    expectRefused({"--gravity", "-1m/s2"}, {"--gravity"});
    expectRefused({"--air-density", "1"}, {"--air-density", "no unit"});
    expectRefused({"--measured", "7m/s"}, {"--measured", "two wind speeds"});
    expectRefused({"--measured", "11..7m/s"}, {"--measured", "two wind speeds"});
    expectRefused({"--measured", "0..7m/s"}, {"--measured", "two wind speeds"});
    expectRefused({"--threads", "0"}, {"--threads"});
}

TEST_F(WindTunnelRefusal, NamesOptionsByTheirNewNamesAndAcceptsTheOld)
{
    const std::vector<std::string> volume{"--volume", "10uL", "--wind-speed", "5m/s"};
    const auto cases = [](std::vector<std::string> arguments, const std::string& prefix) {
        for (const std::string& argument :
             {"--" + prefix + "-angle", std::string("12deg"), "--" + prefix + "-volume", std::string("40uL")}) {
            arguments.push_back(argument);
        }
        return reportOf(arguments).at("runs").at(0).at("cases");
    };
    EXPECT_EQ(cases(volume, "falling"), cases(volume, "sliding"));
    testing::writeFile(directory() / "old.toml", "falling-angle = \"95deg\"\n");
    expectRefused({"--config", "old.toml"}, {"--sliding-angle (old.toml:1)"});
    expectRefused({"--falling-angle", "1deg", "--sliding-angle", "1deg"}, {"--sliding-angle: given 2 times"});
    EXPECT_THAT(runDroplet({"wind-tunnel", "--help"}).output, Not(HasSubstr("--falling")));
}

TEST_F(WindTunnelRefusal, RefusesWrongOutputs)
{
    expectRefused({"out.txt"}, {"OUTPUT", "'out.txt'", ".csv"});
    expectRefused({"--chart", "out.pdf"}, {"--chart", "'out.pdf'", ".svg"});
    expectRefused({"--map", "out.csv"}, {"--map", "'out.csv'"});
    expectRefused({"-", "--json", "-"}, {"-", "different files"});
    expectRefused({"--time", "1s"}, {"--time needs --trace"});
    expectRefused({"--trace", "t.csv"}, {"--trace", "--volume must be one value, not 4"});
    expectRefused({"--trace", "t.csv", "--volume", "30uL", "--wind-speed", "9m/s", "--preset", "thesis,hashimoto"},
                  {"--trace", "--preset"});
    expectRefused({"--trace", "t.csv", "--volume", "30uL", "--wind-speed", "9m/s", "--time", "0s"}, {"--time"});
    expectRefused(
        {"--trace", "t.csv", "--volume", "30uL", "--wind-speed", "9m/s", "--time", "24h", "--trace-step", "1ms"},
        {"--trace-step"});
    expectRefused(
        {"--trace", "t.csv", "--volume", "30uL", "--wind-speed", "9m/s", "--gust", "1m/s", "--gust-period", "0.001ms"},
        {"--gust-period", "100000"});
    expectRefused({"--chart", "c.svg", "--slope", "1..13deg:1"}, {"panel", "12"});
    expectRefusal({"wind-tunnel", "--json", "old.json", "--no-clobber"}, 4, {"old.json"});
    expectRefusal({"wind-tunnel", "nowhere/out.csv"}, 4, {"nowhere"});
}

// ------------------------------------------------------------------------------------------------------ tables

TEST(WindTunnelCommand, ReportHasTheKeysOfItsPage)
{
    const std::string page = readFile(testing::inSource("docs/reports.md"));
    const std::string fence = "```wind-tunnel-report\n";
    ASSERT_THAT(page, HasSubstr(fence));
    const auto begin = page.find(fence) + fence.size();
    std::istringstream shown(page.substr(begin, page.find("```", begin) - begin));
    std::vector<std::string> keys;
    for (std::string key; shown >> key;) {
        keys.push_back(key);
    }
    const Json report = reportOf({"--preset", "thesis"});
    EXPECT_EQ(report.at("schema"), "droplet-shape.wind-tunnel/1");
    std::vector<std::string> found;
    for (const auto& [key, value] : report.at("runs").at(0).at("cases").at(0).items()) {
        found.push_back(key);
    }
    EXPECT_EQ(found, keys);
}

TEST(WindTunnelCommand, ReportHasTheResultsOfTheLibrary)
{
    const Json run = reportOf({"--preset", "hashimoto"}).at("runs").at(0);
    const ForcePreset& preset = forcePresetNamed("hashimoto");
    EXPECT_EQ(run.at("air").at("boundary_layer_m"), preset.model.air.boundary_layer);
    EXPECT_EQ(run.at("wetting").at("falling_angle_deg"), 10.0);
    EXPECT_EQ(run.at("wetting").at("falling_volume_m3"), 30e-9);
    EXPECT_THAT(run.at("measured_still_m_per_s").get<std::vector<double>>(), ElementsAre(7.0, 11.0));
    ASSERT_EQ(run.at("cases").size(), preset.volumes.size());
    for (std::size_t v = 0; v < preset.volumes.size(); ++v) {
        const Json& one = run.at("cases").at(v);
        const DropletForces forces = forcesOn(preset.model, preset.volumes[v]);
        const Thresholds thresholds = thresholdsOf(forces, preset.slope);
        EXPECT_EQ(one.at("volume_m3"), preset.volumes[v]);
        EXPECT_EQ(one.at("lower_threshold_m_per_s"), *thresholds.lower);
        EXPECT_EQ(one.at("upper_threshold_m_per_s"), *thresholds.upper);
        EXPECT_EQ(one.at("critical_volume_m3"), *criticalVolume(preset.model, preset.slope));
        EXPECT_NEAR(one.at("distance_from_measured").at("lower_share").get<double>(), *thresholds.lower / 7.0 - 1.0,
                    1e-15);
        ASSERT_EQ(one.at("acceleration_m_per_s2").size(), 65U);
        EXPECT_EQ(one.at("regime").at(0), "runs down");
        EXPECT_EQ(one.at("regime").at(36), "still");  // 9 m/s
        EXPECT_EQ(one.at("regime").at(64), "climbs");
    }
    EXPECT_NEAR(run.at("cases").at(3).at("threshold_ratio").get<double>(), 1.37, 0.005);
}

// The page quotes the program's lines on the distance from the measurement.
TEST(WindTunnelCommand, PageQuotesTheComputedDistance)
{
    const std::string page = readFile(testing::inSource("docs/cli/wind-tunnel.md"));
    const CommandResult result = tunnel({"--preset", "thesis,hashimoto"});
    ASSERT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, HasSubstr("30 µL: still from 7.70 to 10.52 m/s, +10.0 % and -4.3 % off"));
    EXPECT_THAT(result.output, HasSubstr("30 µL: still from 7.00 to 11.00 m/s, +0.0 % and +0.0 % off"));
    EXPECT_THAT(page, HasSubstr("from 7.70 to 10.52 m/s, +10.0 % and −4.3 % off"));
    const Json report = reportOf({});
    for (const Json& one : report.at("runs").at(0).at("cases")) {
        for (const char* end : {"lower_share", "upper_share"}) {
            EXPECT_LT(std::abs(one.at("distance_from_measured").at(end).get<double>()), 0.1);
        }
    }
}

TEST(WindTunnelCommand, MeasurementIsShownOnlyForTheMeasuredPlane)
{
    const auto measured = [](const std::vector<std::string>& arguments) {
        return reportOf(arguments).at("runs").at(0).at("measured_still_m_per_s");
    };
    EXPECT_FALSE(measured({"--volume", "10uL"}).is_null());
    EXPECT_FALSE(measured({"--slope", "35deg", "--liquid", "water", "--gravity", "9.81m/s2"}).is_null())
        << "the measured plane's own values";
    EXPECT_TRUE(measured({"--slope", "45deg"}).is_null());
    EXPECT_TRUE(measured({"--contact-angle", "90deg"}).is_null());
    EXPECT_EQ(measured({"--slope", "45deg", "--measured", "8..12m/s"}).dump(), "[8.0,12.0]");
}

/// Columns of a table by name, and the comment lines before its header.
struct Table {
    std::vector<std::string> remarks;
    std::map<std::string, std::vector<std::string>> columns;

    explicit Table(const std::string& text)
    {
        std::istringstream lines(text);
        std::vector<std::string> names;
        for (std::string line; std::getline(lines, line);) {
            if (line.rfind('#', 0) == 0) {
                remarks.push_back(line);
                continue;
            }
            std::vector<std::string> cells;
            std::istringstream stream(line);
            for (std::string cell; std::getline(stream, cell, ',');) {
                cells.push_back(cell);
            }
            if (names.empty()) {
                names = cells;
                continue;
            }
            EXPECT_EQ(cells.size(), names.size()) << line;
            for (std::size_t i = 0; i < std::min(cells.size(), names.size()); ++i) {
                columns[names[i]].push_back(cells[i]);
            }
        }
    }

    [[nodiscard]] double number(const std::string& column, std::size_t row) const
    {
        const std::string& cell = columns.at(column).at(row);
        double value = std::nan("");
        std::from_chars(cell.data(), cell.data() + cell.size(), value);
        return value;
    }
};

TEST(WindTunnelCommand, TableAgreesWithTheReport)
{
    const std::vector<std::string> sweep{
        "--preset", "thesis,hashimoto", "--volume",           "3,30uL", "--wind-speed", "0..16m/s:0.5",
        "--slope",  "20,35deg",         "--viscosity-factor", "wedge"};
    std::vector<std::string> arguments = sweep;
    arguments.insert(arguments.end(), {"-", "-q"});
    const CommandResult result = tunnel(arguments);
    EXPECT_EQ(result.error, "");
    const Table table(result.output);
    const Json report = reportOf(sweep);
    std::size_t row = 0;
    for (const Json& run : report.at("runs")) {
        EXPECT_THAT(table.remarks, Contains("# air.boundary_layer_m = " + run.at("air").at("boundary_layer_m").dump()));
        for (const Json& one : run.at("cases")) {
            for (std::size_t w = 0; w < run.at("wind_m_per_s").size(); ++w, ++row) {
                EXPECT_EQ(table.columns.at("preset").at(row), run.at("preset").get<std::string>());
                EXPECT_EQ(table.columns.at("regime").at(row), one.at("regime").at(w).get<std::string>());
                EXPECT_EQ(table.number("wind_m_per_s", row), run.at("wind_m_per_s").at(w));
                for (const char* key : {"volume_m3", "slope_deg", "hysteresis", "retention_n", "mass_kg"}) {
                    EXPECT_EQ(table.number(key, row), one.at(key)) << key;
                }
                for (const char* key : {"drag_n", "acceleration_m_per_s2", "terminal_velocity_m_per_s"}) {
                    EXPECT_EQ(table.number(key, row), one.at(key).at(w)) << key;
                }
                EXPECT_EQ(table.columns.at("lower_threshold_m_per_s").at(row).empty(),
                          one.at("lower_threshold_m_per_s").is_null());
                EXPECT_NEAR(table.number("driving_n", row),
                            table.number("drag_n", row) - table.number("weight_along_slope_n", row), 1e-18);
            }
        }
    }
    EXPECT_EQ(table.columns.at("regime").size(), row);
    EXPECT_EQ(row, 2U * 2U * 2U * 33U);
}

TEST(WindTunnelCommand, SameBytesWithAnyNumberOfThreads)
{
    const auto on = [](const char* threads) {
        return tunnel({"--volume", "1..30uL:1", "--wind-speed", "0..16m/s:0.02", "-", "-q", "--threads", threads})
            .output;
    };
    const std::string one = on("1");
    EXPECT_THAT(one, SizeIs(::testing::Gt(1'000'000U)));
    EXPECT_TRUE(one == on("4"));
}

TEST(WindTunnelCommand, FallingAngleAppliesToOneVolumeOrToAll)
{
    const auto cases = [](const std::vector<std::string>& arguments) {
        return reportOf(arguments).at("runs").at(0).at("cases");
    };
    const auto held = [](const Json& one) {
        return std::asin(one.at("retention_n").get<double>() / (9.81 * one.at("mass_kg").get<double>())) / kDegree;
    };
    const Json of_one = cases({"--volume", "10,40uL", "--sliding-angle", "12deg", "--sliding-volume", "40uL"});
    EXPECT_NEAR(held(of_one[1]), 12.0, 1e-9);
    EXPECT_GT(held(of_one[0]), 20.0);
    EXPECT_EQ(of_one[0].at("hysteresis"), of_one[1].at("hysteresis"));
    const Json of_every = cases({"--volume", "10,40uL", "--sliding-angle", "12deg", "--sliding-volume", "every"});
    EXPECT_NEAR(held(of_every[0]), 12.0, 1e-9);
    EXPECT_NEAR(held(of_every[1]), 12.0, 1e-9);
    EXPECT_TRUE(of_every[0].at("critical_volume_m3").is_null());
    // Without wind, at 35° with a sliding angle of 10° (WIND: g (sin 35° − sin 10°)).
    for (const Json& one :
         cases({"--volume", "1..100uL:33", "--sliding-angle", "10deg", "--sliding-volume", "every"})) {
        EXPECT_NEAR(one.at("acceleration_m_per_s2").at(0).get<double>(), -3.92, 0.005);
    }
}

TEST(WindTunnelCommand, EveryOptionReachesTheModel)
{
    const Json run = reportOf({"--volume",
                               "30uL",
                               "--contact-angle",
                               "90deg",
                               "--viscosity-factor",
                               "0.3Pa.s",
                               "--kinetic-fraction",
                               "0.4",
                               "--drag-coefficient",
                               "0.7",
                               "--boundary-layer",
                               "5mm",
                               "--profile-exponent",
                               "0.2",
                               "--air-density",
                               "1.1kg/m3",
                               "--surface-tension",
                               "50mN/m",
                               "--density",
                               "900kg/m3",
                               "--gravity",
                               "5m/s2",
                               "--slope",
                               "50deg",
                               "--hysteresis",
                               "0.3",
                               "--wind-speed",
                               "9m/s"})
                         .at("runs")
                         .at(0);
    ForceModel model;
    model.liquid = {"custom", 0.05, 900.0};
    model.air = {1.1, 0.7, 5e-3, 0.2};
    model.wetting = {90.0 * kDegree, 0.3, {}, 0.4, 0.3};
    model.gravity = 5.0;
    const DropletForces forces = forcesOn(model, 30e-9);
    const double driving = drivingForce(forces, 50.0 * kDegree, 9.0);
    const Json& one = run.at("cases").at(0);
    EXPECT_NEAR(one.at("acceleration_m_per_s2").at(0).get<double>(), acceleration(forces, driving, 0.0), 1e-9);
    EXPECT_NEAR(one.at("terminal_velocity_m_per_s").at(0).get<double>(), *terminalVelocity(forces, driving), 1e-9);
    EXPECT_NE(acceleration(forces, driving, 0.0), 0.0);
    EXPECT_NEAR(one.at("sliding_friction_n").get<double>(), forces.sliding_friction, 1e-15);
    EXPECT_EQ(run.at("liquid").at("name"), "custom");
}

// ------------------------------------------------------------------------------------------------ charts and summary

TEST(WindTunnelCommand, ExtensionsSelectTheOutputs)
{
    const testing::ScratchDirectory scratch;
    const auto path = [&](const char* name) { return (scratch.path() / name).string(); };
    const CommandResult result = tunnel({path("a.csv"), path("b.json"), path("c.svg"), path("d.png"), "--map",
                                         path("e.svg"), "--json", path("f.json"), "--chart", path("g.svg")});
    ASSERT_EQ(result.exit_code, 0) << result.error;
    EXPECT_EQ(result.output, "");
    EXPECT_THAT(result.error, StartsWith("hashimoto: contact angle 105°, slope 35°, hysteresis 0.212"));
    EXPECT_THAT(scratch.names(), ElementsAre("a.csv", "b.json", "c.svg", "d.png", "e.svg", "f.json", "g.svg"));
    EXPECT_THAT(readFile(path("a.csv")), StartsWith("# droplet-shape wind-tunnel "));
    EXPECT_EQ(readFile(path("b.json")), readFile(path("f.json")));
    EXPECT_EQ(readFile(path("c.svg")), readFile(path("g.svg")));
    EXPECT_NE(readFile(path("c.svg")), readFile(path("e.svg")));
    EXPECT_THAT(readFile(path("c.svg")), HasSubstr(">30 µL</text>"));
    const Picture picture = readPicture(path("d.png"));
    EXPECT_GT(picture.width, 1000);
    EXPECT_NO_THROW(readPicture(path("e.svg"))) << "must be well-formed SVG";
}

TEST(WindTunnelCommand, WithoutOutputItPrintsTheThresholds)
{
    const CommandResult result = tunnel({"--volume", "0.1,30uL", "--slope", "0,35deg"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.error, "");
    EXPECT_THAT(result.output, HasSubstr("30 µL: still from "));
    EXPECT_THAT(result.output, HasSubstr("0.1 µL: still up to "));
    EXPECT_THAT(result.output, HasSubstr("without wind droplets run down from 4.997 µL, contact radius 1.16 mm"));
    EXPECT_THAT(tunnel({"--air-density", "0kg/m3", "--volume", "1uL"}).output, HasSubstr("no wind moves it"));
    EXPECT_EQ(tunnel({"--quiet"}).output, "");
}

TEST(WindTunnelCommand, TakesOptionsFromAFile)
{
    const testing::ScratchDirectory scratch;
    const std::string config = (scratch.path() / "tunnel.toml").string();
    testing::writeFile(config, "volume = \"10,20uL\"\nwind = \"0..4m/s:2\"\nslope = \"45deg\"\n");
    const Json run = reportOf({"--config", config, "--slope", "50deg"}).at("runs").at(0);
    ASSERT_EQ(run.at("cases").size(), 2U);
    EXPECT_EQ(run.at("wind_m_per_s").size(), 3U);
    EXPECT_NEAR(run.at("cases").at(0).at("slope_deg").get<double>(), 50.0, 1e-12);
}

TEST(WindTunnelCommand, TraceFollowsOneDroplet)
{
    const std::vector<std::string> droplet{"--volume", "30uL",   "--wind-speed", "9.3m/s",       "--gust",
                                           "2m/s",     "--time", "3s",           "--trace-step", "50ms"};
    const testing::ScratchDirectory scratch;
    const std::string path = (scratch.path() / "run.json").string();
    std::vector<std::string> arguments = droplet;
    arguments.insert(arguments.end(), {"--trace", path, "-q"});
    ASSERT_EQ(tunnel(arguments).exit_code, 0);
    const Json json = Json::parse(readFile(path));
    EXPECT_EQ(json.at("schema"), "droplet-shape.wind-trace/1");
    EXPECT_EQ(json.at("time_s").size(), 61U);
    ASSERT_GE(json.at("events").size(), 5U);
    for (std::size_t e = 0; e < json.at("events").size(); ++e) {
        EXPECT_EQ(json.at("events").at(e).at("what"), e % 2 == 0 ? "moves" : "caught");
    }
    arguments = droplet;
    arguments.insert(arguments.end(), {"--trace", "-", "-q"});
    const Table table(tunnel(arguments).output);
    ASSERT_EQ(table.columns.at("time_s").size(), 61U);
    for (std::size_t k = 0; k < 61; ++k) {
        EXPECT_EQ(table.number("velocity_m_per_s", k), json.at("velocity_m_per_s").at(k));
        EXPECT_EQ(table.number("position_m", k), json.at("position_m").at(k));
    }
    EXPECT_EQ(std::ranges::count_if(table.remarks, [](const std::string& line) { return line.starts_with("# moves"); }),
              (static_cast<std::ptrdiff_t>(json.at("events").size()) + 1) / 2);
}

// WIND: 30 µL with a sliding angle of 10° reach 0.11 m/s at 35°.
TEST(WindTunnelCommand, TraceEndsAtTheTerminalSpeed)
{
    const Table table(
        tunnel({"--volume", "30uL", "--wind-speed", "0m/s", "--viscosity-factor", "artistic", "--trace", "-", "-q"})
            .output);
    EXPECT_NEAR(table.number("velocity_m_per_s", 100), -0.11, 0.005);
    EXPECT_NEAR(table.number("acceleration_m_per_s2", 0), -3.92, 0.005);
}

}  // namespace
}  // namespace droplet
