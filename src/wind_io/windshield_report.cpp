// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys are a contract, schema droplet-shape.windshield/1: add keys, do not rename or remove any.
#include "droplet/wind_io/windshield_report.h"

#include <algorithm>
#include <ostream>

#include "droplet/version.h"
#include "io/report_sections.h"
#include "io/rounded_time.h"
#include "wind_io/forces_section.h"

namespace droplet {
namespace {

ReportJson placeOrNull(const std::optional<Vec3>& place)
{
    return place ? ReportJson{place->x, place->y, place->z} : ReportJson();
}

ReportJson glassSection(const WindshieldReport& report)
{
    const Glass& glass = report.parameters.glass;
    const auto cylinder = glass.cylinder();
    ReportJson section{{"surface", orNull(report.surface)}, {"width_m", glass.width()}, {"height_m", glass.height()}};
    section["radius_m"] = cylinder && cylinder->radius < 1e300 ? ReportJson(cylinder->radius) : ReportJson();
    section["slope_deg"] = cylinder ? ReportJson(cylinder->slope / kDegree) : ReportJson();
    return section;
}

ReportJson rowOf(const BalanceRow& row)
{
    const WaterBalance& b = row.balance;
    return {{"time_s", roundedTime(row.time)},
            {"speed_m_per_s", row.speed},
            {"rained_m3", b.rained},
            {"on_glass_still_m3", b.on_glass_still},
            {"on_glass_film_m3", b.on_glass_film},
            {"on_glass_running_m3", b.on_glass_running},
            {"left_m3", b.left},
            {"wiped_m3", b.wiped},
            {"merged_m3", b.merged},
            {"swept_m3", b.swept},
            {"shed_m3", b.shed},
            {"residual", b.residual()},
            {"still_droplets", row.still},
            {"running_droplets", row.running},
            {"moving_droplets", row.moving}};
}

}  // namespace

BalanceRow balanceRow(const WindshieldState& state, double speed)
{
    BalanceRow row{state.time, speed, balanceOf(state), state.still.count(), state.droplets.size(), 0};
    row.moving =
        static_cast<std::uint64_t>(std::count_if(state.droplets.begin(), state.droplets.end(), [](const auto& d) {
            return d.velocity.x != 0.0 || d.velocity.y != 0.0;
        }));
    return row;
}

void writeWindshieldReport(std::ostream& out, const WindshieldReport& report)
{
    const WindshieldParameters& parameters = report.parameters;
    ReportJson json;
    json["schema"] = "droplet-shape.windshield/1";
    json["version"] = kVersion;
    json["preset"] = report.preset;
    json["output"] = {
        {"path", report.output},       {"frames", report.frames}, {"frames_per_second", report.frames_per_second},
        {"warm_up_s", report.warm_up}, {"step_s", report.step},   {"map_thickness_m", orNull(report.map_thickness)}};
    json["glass"] = glassSection(report);
    json["vehicle"] = {{"drive_cycle", orNull(report.drive_cycle)},
                       {"speed_at_start_m_per_s", parameters.vehicle.speedAt(0.0)},
                       {"wind", parameters.wind == WindAlongGlass::Turned ? "turned" : "projected"}};
    json["rain"] = {{"rainfall_m_per_s", parameters.rainfall},
                    {"rainfall_mm_per_h", parameters.rainfall / kMillimetrePerHour},
                    {"still_diameter_m", parameters.still_diameter},
                    {"splashes", parameters.splashes},
                    {"seed", parameters.seed}};
    json["forces"] = forcesSection(parameters.forces);
    json["fluctuation"] = {{"acceleration_m_per_s2", parameters.fluctuation.acceleration},
                           {"interval_s", parameters.fluctuation.interval}};
    json["streaks"] = {{"film_m", parameters.streaks.film}, {"spacing_m", parameters.streaks.spacing}};
    json["runoff_s"] = parameters.runoff;
    json["wipers"] = {
        {"count", parameters.wipers.size()},
        {"period_s", parameters.wipers.empty() ? ReportJson() : ReportJson(parameters.wipers.front().period)}};
    json["view"] = {{"background", orNull(report.background)},
                    {"environment", orNull(report.environment)},
                    {"width_px", report.view.width},
                    {"height_px", report.view.height},
                    {"field_of_view_deg", report.view.field_of_view / kDegree},
                    {"eye_distance_m", report.view.eye_distance},
                    {"eye_m", placeOrNull(report.view.eye)},
                    {"look_at_m", placeOrNull(report.view.look_at)},
                    {"ior", report.view.ior},
                    {"background_blur_deg", report.view.background_blur / kDegree},
                    {"shutter_open_s", report.view.shutter_time},
                    {"exposure", report.view.exposure},
                    {"highlight_boost", orNull(report.view.highlight_boost)}};
    json["balance"] = ReportJson::array();
    double worst = 0.0;
    for (const BalanceRow& row : report.balance) {
        json["balance"].push_back(rowOf(row));
        worst = std::max(worst, std::abs(row.balance.residual()));
    }
    json["largest_residual"] = worst;
    json["counts"] = {{"raindrops", report.counts.raindrops}, {"merged", report.counts.merged},
                      {"swept", report.counts.swept},         {"grown", report.counts.grown},
                      {"torn", report.counts.torn},           {"left", report.counts.left},
                      {"wiped", report.counts.wiped}};
    addRunSection(json, {report.warnings, report.time_total, report.peak_memory});
    writeReportJson(out, json);
}

}  // namespace droplet
