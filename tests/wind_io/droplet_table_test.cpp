// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind_io/droplet_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "droplet/wind_io/windshield_report.h"

namespace droplet {
namespace {

WindshieldState twoDroplets()
{
    WindshieldState state;
    state.time = 1.0 / 3.0;
    RunningDroplet droplet;
    droplet.id = 18446744073709551615ULL;
    droplet.position = {0.1 + 0.2, 1e-17};
    droplet.volume = 1.0 / 7e9;
    state.droplets.push_back(droplet);
    droplet.id = 2;
    droplet.velocity = {-0.3, 0.4};
    state.droplets.push_back(droplet);
    return state;
}

TEST(DropletTable, CsvReadsBackToTheSameNumbers)
{
    std::ostringstream out;
    DropletTable table(out, TableFormat::Csv, {});
    table.add(1, twoDroplets());
    table.add(2, WindshieldState());
    table.add(3, twoDroplets());
    table.finish();
    std::istringstream lines(out.str());
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line,
              "frame,time_s,id,x_m,y_m,velocity_x_m_per_s,velocity_y_m_per_s,volume_m3,contact_radius_m,length_m");
    int rows = 0;
    for (; std::getline(lines, line); ++rows) {
        std::istringstream cells(line);
        std::vector<std::string> row;
        for (std::string cell; std::getline(cells, cell, ',');) {
            row.push_back(cell);
        }
        ASSERT_EQ(row.size(), 10U);
        EXPECT_EQ(row[0], rows < 2 ? "1" : "3");
        EXPECT_EQ(row[1], "0.333333333");
        EXPECT_EQ(std::stod(row[3]), 0.1 + 0.2);
        EXPECT_EQ(std::stod(row[4]), 1e-17);
        EXPECT_EQ(std::stod(row[7]), 1.0 / 7e9);
        const bool runs = row[2] == "2";
        EXPECT_EQ(row[2], runs ? "2" : "18446744073709551615");
        EXPECT_EQ(std::stod(row[5]), runs ? -0.3 : 0.0);
        const RunningShape shape = runningShape(1.0 / 7e9, runs ? 0.5 : 0.0);
        EXPECT_EQ(std::stod(row[8]), shape.contact_radius);
        EXPECT_EQ(std::stod(row[9]), 2.0 * (shape.half_length + shape.contact_radius));
    }
    EXPECT_EQ(rows, 4);
}

TEST(DropletTable, TimesAreRoundedToNanoseconds)
{
    const auto time = [](double value) {
        std::ostringstream out;
        DropletTable table(out, TableFormat::Csv, {});
        WindshieldState state = twoDroplets();
        state.time = value;
        table.add(1, state);
        const std::string text = out.str();
        const std::size_t begin = text.find("\n1,") + 3;
        return text.substr(begin, text.find(',', begin) - begin);
    };
    double sum = 0.0;
    for (int k = 0; k < 600; ++k) {
        sum += 1.0 / 60.0;
    }
    ASSERT_NE(sum, 10.0);
    EXPECT_EQ(time(sum), "10");
    EXPECT_EQ(time(2.05), "2.05");
    EXPECT_EQ(time(0.1 + 0.2), "0.3");
    EXPECT_EQ(time(100000.0), "100000") << "not in scientific notation";
    EXPECT_EQ(time(86400.0 + 1.0 / 3.0), "86400.333333333");
}

TEST(DropletTable, WritesOnlyMovingDropletsOnRequest)
{
    std::ostringstream out;
    DropletTable table(out, TableFormat::Csv, {});
    table.add(7, twoDroplets(), DropletRows::Moving);
    table.finish();
    const std::string text = out.str();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << "the header and one row";
    EXPECT_NE(text.find("\n7,0.333333333,2,"), std::string::npos);
}

TEST(DropletTable, JsonHasTheSameRows)
{
    for (const int frames : {0, 1, 3}) {
        std::ostringstream out;
        DropletTable table(out, TableFormat::Json, {});
        for (int k = 0; k < frames; ++k) {
            table.add(static_cast<std::size_t>(k + 1), twoDroplets());
        }
        table.finish();
        const auto json = nlohmann::json::parse(out.str());
        EXPECT_EQ(json.at("schema"), "droplet-shape.windshield-droplets/1");
        EXPECT_EQ(json.at("columns").size(), 10U);
        ASSERT_EQ(json.at("rows").size(), static_cast<std::size_t>(2 * frames));
        for (const auto& row : json.at("rows")) {
            EXPECT_EQ(row.size(), 10U);
            EXPECT_EQ(row.at(3).get<double>(), 0.1 + 0.2);
        }
    }
}

TEST(WindshieldReportOf, HasTheBalance)
{
    WindshieldReport report;
    report.preset = "figure-3.10";
    WindshieldState state = twoDroplets();
    state.rained.add(3e-10);
    report.balance.push_back(balanceRow(state, 12.0));
    std::ostringstream out;
    writeWindshieldReport(out, report);
    const auto json = nlohmann::json::parse(out.str());
    EXPECT_EQ(json.at("schema"), "droplet-shape.windshield/1");
    EXPECT_EQ(json.at("balance").at(0).at("running_droplets"), 2);
    EXPECT_EQ(json.at("balance").at(0).at("moving_droplets"), 1);
    EXPECT_EQ(json.at("balance").at(0).at("rained_m3"), 3e-10);
    EXPECT_EQ(json.at("balance").at(0).at("speed_m_per_s"), 12.0);
    EXPECT_DOUBLE_EQ(json.at("largest_residual"), std::abs(report.balance[0].balance.residual()));
    EXPECT_NEAR(json.at("rain").at("rainfall_mm_per_h"), 5.0, 1e-12);
    EXPECT_TRUE(json.at("glass").at("surface").is_null());
}

}  // namespace
}  // namespace droplet
