// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace droplet {
namespace {

std::vector<FlowPoint> points()
{
    FlowPoint on_face;
    on_face.id = 18446744073709551615ULL;
    on_face.face = 1234567;
    on_face.axes = {Vec3{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    on_face.radius = 2.5e-3;
    on_face.elongation = 1.25;
    on_face.age = 0.75;
    on_face.place = {0.1 + 0.2, 1.0 / 3.0, -1e-17};
    on_face.velocity = {-0.0, -0.7, 1e300};
    on_face.volume = 1.0 / 7e9;
    FlowPoint falling;
    falling.axes = {Vec3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    falling.id = 3;
    falling.volume = 1e-9;
    return {on_face, falling};
}

TEST(FlowTable, CsvReadsBackToTheSameNumbersWithYUp)
{
    std::ostringstream out;
    FlowTable table(out, TableFormat::Csv);
    table.add(0, 0.1 + 0.2, points());
    table.add(100000, 1.0, {});
    table.finish();
    std::istringstream lines(out.str());
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line,
              "frame,time_s,id,x_m,y_m,z_m,velocity_x_m_per_s,velocity_y_m_per_s,velocity_z_m_per_s,volume_m3,face,"
              "radius_m,elongation,rotation_x,rotation_y,rotation_z,rotation_w,age_s");
    std::vector<std::vector<std::string>> rows;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) {
            rows.back().push_back(cell);
        }
        ASSERT_EQ(rows.back().size(), 18U);
    }
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0][0], "0");
    EXPECT_EQ(rows[0][1], "0.30000000000000004");
    EXPECT_EQ(rows[0][2], "18446744073709551615");
    const std::vector<double> expected{0.1 + 0.2, -1e-17, -1.0 / 3.0, 0.0, 1e300, 0.7, 1.0 / 7e9};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double number = std::stod(rows[0][3 + i]);
        EXPECT_EQ(number, expected[i]) << i;
        EXPECT_EQ(std::signbit(number), std::signbit(expected[i])) << i;
    }
    EXPECT_EQ(rows[0][10], "1234567") << "the number in the mesh";
    EXPECT_EQ(rows[1][10], "-1") << "in the air";
    EXPECT_EQ(rows[0][11], "0.0025");
    EXPECT_EQ(rows[0][12], "1.25");
    EXPECT_EQ(rows[0][17], "0.75");
    // With +Y up x is turned to −z, y to −x and z to y.
    const std::vector<double> turn{-0.5, 0.5, 0.5, 0.5};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(std::stod(rows[0][13 + i]), turn[i], 1e-15) << i;
    }
}

TEST(FlowTable, JsonHasTheSameRows)
{
    std::ostringstream out;
    FlowTable table(out, TableFormat::Json);
    table.add(5, 2.0, points());
    table.add(6, 2.5, points());
    table.finish();
    const auto json = nlohmann::json::parse(out.str());
    EXPECT_EQ(json.at("schema"), "droplet-shape.flow-droplets/1");
    EXPECT_EQ(json.at("columns").size(), 18U);
    ASSERT_EQ(json.at("rows").size(), 4U);
    nlohmann::json row = json.at("rows").at(3);
    ASSERT_EQ(row.size(), 18U);
    EXPECT_NEAR(row.at(13).get<double>(), -std::sqrt(0.5), 1e-15) << "z is turned to y";
    row.erase(row.begin() + 11, row.end());
    EXPECT_EQ(row, nlohmann::json({6, 2.5, 3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-9, -1}));
    EXPECT_EQ(json.at("rows").at(0).at(10), 1234567);
}

}  // namespace
}  // namespace droplet
