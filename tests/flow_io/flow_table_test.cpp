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

/// A surface whose second face is triangle 1234567 of the mesh.
FlowSurface surface()
{
    FlowSurface surface;
    surface.faces.resize(2);
    surface.faces[1].source = 1234567;
    return surface;
}

std::vector<FlowSample> samples()
{
    FlowSample on_face;
    on_face.id = 18446744073709551615ULL;
    on_face.contact = FlowContact::Face;
    on_face.face = 1;
    on_face.place = {0.1 + 0.2, 1.0 / 3.0, -1e-17};
    on_face.velocity = {-0.0, -0.7, 1e300};
    on_face.volume = 1.0 / 7e9;
    FlowSample falling;
    falling.id = 3;
    falling.volume = 1e-9;
    return {on_face, falling};
}

TEST(FlowTable, CsvReadsBackToTheSameNumbersWithYUp)
{
    std::ostringstream out;
    FlowTable table(out, TableFormat::Csv);
    table.add(0, 0.1 + 0.2, samples(), surface());
    table.add(100000, 1.0, {}, surface());
    table.finish();
    std::istringstream lines(out.str());
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line,
              "frame,time_s,id,x_m,y_m,z_m,velocity_x_m_per_s,velocity_y_m_per_s,velocity_z_m_per_s,volume_m3,face");
    std::vector<std::vector<std::string>> rows;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) {
            rows.back().push_back(cell);
        }
        ASSERT_EQ(rows.back().size(), 11U);
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
}

TEST(FlowTable, JsonHasTheSameRows)
{
    std::ostringstream out;
    FlowTable table(out, TableFormat::Json);
    table.add(5, 2.0, samples(), surface());
    table.add(6, 2.5, samples(), surface());
    table.finish();
    const auto json = nlohmann::json::parse(out.str());
    EXPECT_EQ(json.at("schema"), "droplet-shape.flow-droplets/1");
    EXPECT_EQ(json.at("columns").size(), 11U);
    ASSERT_EQ(json.at("rows").size(), 4U);
    EXPECT_EQ(json.at("rows").at(3), nlohmann::json({6, 2.5, 3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-9, -1}));
    EXPECT_EQ(json.at("rows").at(0).at(10), 1234567);
}

}  // namespace
}  // namespace droplet
