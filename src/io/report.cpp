// SPDX-License-Identifier: GPL-3.0-or-later
//
// The names are the contract of the schema droplet-shape.report/1: keys may be added, none renamed or left out.
#include "droplet/io/report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/version.h"

namespace droplet {
namespace {

using Json = nlohmann::ordered_json;

const char* nameOf(Channel channel)
{
    switch (channel) {
        case Channel::Alpha:
            return "alpha";
        case Channel::Luma:
            return "luma";
        case Channel::Auto:
            break;
    }
    throw Error(ErrorCode::InvalidArgument, "report: input.channel is not decided, must be alpha or luma");
}

const char* nameOf(FillBy by)
{
    switch (by) {
        case FillBy::Volume:
            return "volume_m3";
        case FillBy::Height:
            return "height_m";
        case FillBy::ContactAngle:
            return "contact_angle_deg";
    }
    throw Error(ErrorCode::InvalidArgument, "report: fill.by is no way to fill");
}

double degrees(double radians)
{
    return radians / kDegree;
}

Json angles(const ContactAngle& angle)
{
    return {{"min", degrees(angle.min)}, {"mean", degrees(angle.mean)}, {"max", degrees(angle.max)}};
}

Json inputSection(const InputReport& input)
{
    return {{"path", input.path},
            {"width_px", input.width_px},
            {"height_px", input.height_px},
            {"pixel_size_m", input.pixel_size},
            {"channel", nameOf(input.channel)},
            {"inverted", input.inverted},
            {"threshold", input.threshold},
            {"level_dry", input.level_dry},
            {"level_liquid", input.level_liquid},
            {"anti_aliased", input.anti_aliased},
            {"specks_dropped", input.specks_dropped},
            {"largest_speck_px2", input.largest_speck_px}};
}

Json outputSection(const OutputReport& output)
{
    return {{"path", output.path},
            {"format", name(output.format)},
            {"bytes", output.bytes},
            {"vertices", output.vertices},
            {"triangles", output.triangles},
            {"closed", output.topology.closed},
            {"manifold", output.topology.manifold},
            {"euler", output.topology.euler},
            {"components", output.topology.components},
            {"boundary_loops", output.topology.boundary_loops}};
}

Json fillSection(const Fill& fill)
{
    return {{"by", nameOf(fill.by)},
            {"amount", fill.by == FillBy::ContactAngle ? degrees(fill.amount) : fill.amount},
            {"sharing", fill.sharing == FillSharing::Each ? "each" : "total"}};
}

Json dropletRow(const DropletReport& droplet)
{
    const ShapeFigures& figures = droplet.figures;
    return {{"footprint_area_m2", figures.footprint_area},
            {"rim_length_m", figures.rim_length},
            {"holes", droplet.holes},
            {"volume_m3", figures.volume},
            {"pressure_pa", droplet.pressure},
            {"height_max_m", figures.height_max},
            {"liquid_area_m2", figures.liquid_area},
            {"surface_energy_j", figures.surface_energy},
            {"gravity_energy_j", figures.gravity_energy},
            {"contact_angle_deg", angles(figures.contact_angle)},
            {"slope_max_deg", degrees(figures.slope_max)}};
}

Json sections(const Report& report)
{
    const ShapeFigures& total = report.total;
    Json json;
    json["schema"] = "droplet-shape.report/1";
    json["version"] = kVersion;
    json["model"] = "linear";
    json["input"] = inputSection(report.input);
    json["output"] = outputSection(report.output);
    json["liquid"] = {{"name", report.physics.liquid.name},
                      {"surface_tension_n_per_m", report.physics.liquid.surface_tension},
                      {"density_kg_per_m3", report.physics.liquid.density},
                      {"gravity_m_per_s2", report.physics.gravity},
                      {"tilt_deg", 0.0}};
    json["fill"] = fillSection(report.physics.fill);
    json["mesh"] = {{"vertices", report.mesh.vertices},
                    {"triangles", report.mesh.triangles},
                    {"min_angle_deg", degrees(report.mesh.min_angle)},
                    {"footprint_area_m2", total.footprint_area},
                    {"rim_length_m", total.rim_length},
                    {"droplets", report.droplets.size()},
                    {"holes", report.mesh.holes}};
    json["solve"] = {{"method", report.solve.method},
                     {"unknowns", report.solve.unknowns},
                     {"iterations", report.solve.iterations},
                     {"residual", report.solve.residual},
                     {"converged", report.solve.usable()}};
    json["shape"] = {{"volume_m3", total.volume},
                     {"pressure_pa", report.pressure ? Json(*report.pressure) : Json()},
                     {"height_max_m", total.height_max},
                     {"liquid_area_m2", total.liquid_area},
                     {"surface_energy_j", total.surface_energy},
                     {"gravity_energy_j", total.gravity_energy},
                     {"contact_angle_deg", angles(total.contact_angle)},
                     {"slope_max_deg", degrees(total.slope_max)}};
    json["droplets"] = Json::array();
    for (const DropletReport& droplet : report.droplets) {
        json["droplets"].push_back(dropletRow(droplet));
    }
    json["warnings"] = report.warnings;
    for (std::size_t stage = 0; stage < kStageCount; ++stage) {
        json["time_s"][name(static_cast<Stage>(stage))] = report.time[stage];
    }
    json["time_s"]["total"] = report.time_total;
    json["peak_memory_bytes"] = report.peak_memory;
    return json;
}

/// JSON has no NaN and no infinity; the library would write null, which a script would take for "not there".
void refuseNonFinite(const Json& value, const std::string& key)
{
    if (value.is_number_float() && !std::isfinite(value.get<double>())) {
        throw Error(ErrorCode::NoSuchDroplet, "report: " + key + " is not finite");
    }
    if (value.is_structured()) {
        for (const auto& [name, member] : value.items()) {
            refuseNonFinite(member, key.empty() ? name : std::string(key).append(".").append(name));
        }
    }
}

}  // namespace

void writeReport(std::ostream& out, const Report& report)
{
    const Json json = sections(report);
    refuseNonFinite(json, "");
    out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace droplet
