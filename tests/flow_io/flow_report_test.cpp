// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "droplet/error.h"
#include "droplet/units.h"

namespace droplet {
namespace {

nlohmann::json written(const FlowReport& report)
{
    std::ostringstream out;
    writeFlowReport(out, report);
    return nlohmann::json::parse(out.str());
}

TEST(FlowReportOf, HasTheBalanceAndTheParameters)
{
    FlowState state;
    state.time = 1.0 / 3.0;
    state.released.add(3e-8);
    for (const FlowContact contact : {FlowContact::Air, FlowContact::Face, FlowContact::Edge, FlowContact::Still}) {
        FlowDroplet droplet;
        droplet.contact = contact;
        droplet.volume = 1e-8;
        state.droplets.push_back(droplet);
    }
    FlowReport report;
    report.input = "leaf.glb";
    report.surface.triangles = 12;
    report.size = {1.0, 2.0, 3.0};
    report.parameters.wind = {1.0, 2.0, 3.0};
    report.parameters.rain.emplace().rainfall = 25.0 * kMillimetrePerHour;
    report.counts.raindrops = 1000;
    report.counts.behind = 3;
    report.counts.behind_volume = 4e-9;
    report.balance.push_back(flowBalanceRow(state));
    const auto json = written(report);
    EXPECT_EQ(json.at("schema"), "droplet-shape.flow/1");
    EXPECT_EQ(json.at("input").at("triangles"), 12);
    EXPECT_EQ(json.at("input").at("size_m"), nlohmann::json({1.0, 3.0, 2.0})) << "+Y up";
    EXPECT_EQ(json.at("forces").at("wind_m_per_s"), nlohmann::json({1.0, 3.0, -2.0}));
    EXPECT_EQ(json.at("forces").at("gravity_m_per_s2"), nlohmann::json({0.0, -kStandardGravity, 0.0}));
    EXPECT_NEAR(json.at("sources").at("rain").at("rainfall_mm_per_h"), 25.0, 1e-12);
    // Most raindrops are small, but have little of the water.
    EXPECT_NEAR(json.at("sources").at("rain").at("small_share"), 0.01, 0.008);
    EXPECT_GT(json.at("counts").at("raindrops_small"), 200);
    EXPECT_EQ(json.at("counts").at("raindrops_behind"), 3);
    EXPECT_EQ(json.at("counts").at("raindrops_behind_m3"), 4e-9);
    EXPECT_TRUE(json.at("sources").at("condensation").is_null());
    const auto& row = json.at("balance").at(0);
    EXPECT_EQ(row.at("time_s"), 0.333333333);
    EXPECT_EQ(row.at("running_droplets"), 2);
    EXPECT_EQ(row.at("still_droplets"), 1);
    EXPECT_EQ(row.at("airborne_droplets"), 1);
    EXPECT_DOUBLE_EQ(row.at("residual"), (3e-8 - 4e-8) / 3e-8);
    EXPECT_DOUBLE_EQ(json.at("largest_residual"), 1.0 / 3.0);
    report.time_total = std::nan("");
    EXPECT_THROW(written(report), Error);
}

}  // namespace
}  // namespace droplet
