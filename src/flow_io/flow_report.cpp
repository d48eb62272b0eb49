// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys are a contract, schema droplet-shape.flow/1: add keys, do not rename or remove any.
#include "droplet/flow_io/flow_report.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/version.h"
#include "droplet/wind/rain.h"
#include "flow_io/object_section.h"
#include "io/report_sections.h"
#include "io/rounded_time.h"
#include "wind_io/forces_section.h"

namespace droplet {
namespace {

const char* nameOf(BodyShape shape)
{
    switch (shape) {
        case BodyShape::Capillary:
            return "capillary";
        case BodyShape::Springs:
            return "springs";
        case BodyShape::Capsule:
            return "capsule";
    }
    throw Error(ErrorCode::InvalidArgument, "unknown shape");
}

ReportJson sizesOf(const VolumeDistribution& volumes)
{
    return {{"median_m3", volumes.median}, {"spread", volumes.spread}};
}

ReportJson forcesOf(const FlowParameters& parameters)
{
    ReportJson section = forcesSection(parameters.forces);
    section["gravity_m_per_s2"] = vectorOf(parameters.gravity);
    section["wind_m_per_s"] = vectorOf(parameters.wind);
    section["friction_kg_per_s"] = orNull(parameters.friction);
    section["adhesion_pa"] = orNull(parameters.adhesion);
    section["roughness_m"] = parameters.roughness;
    section["pinning"] = parameters.pinning.spread;
    section["pinning_length_m"] = parameters.pinning.length;
    return section;
}

/// Raindrops that are simulated, and those that are too small.
std::pair<RainImpacts, RainImpacts> rainOf(const FlowRain& rain)
{
    const double between = std::max(rain.small_diameter, rain.raindrops.min);
    const RaindropSizes sizes = raindropSizes(rain.rainfall);
    return {{sizes, {between, rain.raindrops.max}, 0.0}, {sizes, {rain.raindrops.min, between}, 0.0}};
}

ReportJson sourcesOf(const FlowParameters& parameters)
{
    ReportJson section{{"emitters", ReportJson::array()}, {"rain", nullptr}, {"condensation", nullptr}};
    for (const FlowEmitter& emitter : parameters.emitters) {
        section["emitters"].push_back({{"place_m", vectorOf(emitter.place)},
                                       {"rate_m3_per_s", emitter.rate},
                                       {"volume", sizesOf(emitter.volumes)}});
    }
    if (parameters.rain) {
        const FlowRain& rain = *parameters.rain;
        section["rain"] = {{"rainfall_m_per_s", rain.rainfall},
                           {"rainfall_mm_per_h", rain.rainfall / kMillimetrePerHour},
                           {"from", vectorOf(rain.from)},
                           {"small_diameter_m", rain.small_diameter},
                           {"small_share", nullptr}};
        const auto [large, small] = rainOf(rain);
        if (const double all = large.rainfall() + small.rainfall(); all > 0.0) {
            section["rain"]["small_share"] = small.rainfall() / all;
        }
    }
    if (parameters.condensation) {
        section["condensation"] = {{"rate_m_per_s", parameters.condensation->rate},
                                   {"spacing_m", parameters.condensation->spacing}};
    }
    return section;
}

ReportJson rowOf(const FlowBalanceRow& row)
{
    const FlowBalance& b = row.balance;
    return {{"time_s", roundedTime(row.time)},
            {"released_m3", b.released},
            {"running_m3", b.running},
            {"still_m3", b.still},
            {"airborne_m3", b.airborne},
            {"streaks_m3", b.streaks},
            {"left_m3", b.left},
            {"dried_m3", b.dried},
            {"residual", b.residual()},
            {"running_droplets", row.running},
            {"still_droplets", row.still},
            {"airborne_droplets", row.airborne}};
}

}  // namespace

FlowBalanceRow flowBalanceRow(const FlowState& state)
{
    FlowBalanceRow row{state.time, balanceOf(state)};
    for (const FlowDroplet& droplet : state.droplets) {
        const bool is_still = droplet.contact == FlowContact::Still;
        ++(droplet.contact == FlowContact::Air ? row.airborne : is_still ? row.still : row.running);
    }
    return row;
}

void writeFlowReport(std::ostream& out, const FlowReport& report)
{
    const FlowParameters& parameters = report.parameters;
    const FlowSurfaceReport& surface = report.surface;
    ReportJson json;
    json["schema"] = "droplet-shape.flow/1";
    json["version"] = kVersion;
    json["preset"] = orNull(report.preset);
    json["input"] = objectSection(report.input, surface, report.size);
    json["input"]["start"] = orNull(report.start);
    json["output"] = {{"path", report.output},
                      {"frames", report.frames},
                      {"frames_per_second", report.frames_per_second},
                      {"time_s", roundedTime(report.time)},
                      {"map_thickness_m", nullptr},
                      {"map_age_s", nullptr}};
    if (report.map_scale) {
        json["output"]["map_thickness_m"] = report.map_scale->thickness;
        json["output"]["map_age_s"] = report.map_scale->age;
    }
    json["model"] = {{"motion", parameters.model == FlowModel::Paper ? "paper" : "capillary"},
                     {"shape", nameOf(report.shape)},
                     {"deformation", report.deformation},
                     {"merges", parameters.merges},
                     {"wets", parameters.wets},
                     {"step_s", parameters.step},
                     {"small_volume_m3", parameters.small_volume},
                     {"seed", parameters.seed}};
    json["forces"] = forcesOf(parameters);
    json["streaks"] = {{"film_m", parameters.streaks.film},
                       {"spacing_m", parameters.streaks.spacing},
                       {"drying_s", orNull(parameters.drying)}};
    json["object"] = {{"spin_rad_per_s", vectorOf(parameters.motion.spin)},
                      {"pivot_m", vectorOf(parameters.motion.pivot)},
                      {"keys", parameters.motion.keys.size()}};
    json["sources"] = sourcesOf(parameters);
    json["balance"] = ReportJson::array();
    double worst = 0.0;
    for (const FlowBalanceRow& row : report.balance) {
        json["balance"].push_back(rowOf(row));
        worst = std::max(worst, std::abs(row.balance.residual()));
    }
    json["largest_residual"] = worst;
    json["counts"] = {{"released", report.counts.released},
                      {"crossings", report.counts.crossings},
                      {"launches", report.counts.launches},
                      {"landings", report.counts.landings},
                      {"merged", report.counts.merged},
                      {"beads", report.counts.beads},
                      {"left", report.counts.left},
                      {"dried", report.counts.dried},
                      {"stuck", report.counts.stuck},
                      {"overflows", report.counts.overflows},
                      {"raindrops", report.counts.raindrops},
                      {"raindrops_behind", report.counts.behind},
                      {"raindrops_behind_m3", report.counts.behind_volume}};
    json["counts"]["raindrops_small"] = 0;
    if (parameters.rain && report.counts.raindrops > 0) {
        const auto [large, small] = rainOf(*parameters.rain);
        json["counts"]["raindrops_small"] =
            std::llround(static_cast<double>(report.counts.raindrops) * small.bound() / large.bound());
    }
    addRunSection(json, {report.warnings, report.time_total, report.peak_memory});
    writeReportJson(out, json);
}

}  // namespace droplet
