// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys are a contract, schemas droplet-shape.wind-tunnel/1 and droplet-shape.wind-trace/1: add keys, do not rename or
// remove any.
#include "droplet/wind_io/tunnel_report.h"

#include <tbb/parallel_for.h>

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "droplet/version.h"

namespace droplet {
namespace {

using Json = nlohmann::ordered_json;

Json orNull(const std::optional<double>& value, double unit = 1.0)
{
    return value ? Json(*value / unit) : Json();
}

std::optional<double> criticalRadius(const TunnelCase& tunnel_case)
{
    if (!tunnel_case.critical_volume) {
        return std::nullopt;
    }
    return tunnel_case.cap.contact_radius * std::cbrt(*tunnel_case.critical_volume / tunnel_case.cap.volume);
}

std::optional<double> ratioOf(const Thresholds& thresholds)
{
    return thresholds.lower && thresholds.upper ? std::optional(*thresholds.upper / *thresholds.lower) : std::nullopt;
}

/// Parameters that are common to all cases of a run.
Json parameters(const TunnelRun& run)
{
    const ForceModel& model = run.swept.model;
    const auto& own_angle = model.wetting.sliding_angle;
    Json json = {{"preset", run.preset.empty() ? Json() : Json(run.preset)}};
    json["liquid"] = {{"name", model.liquid.name},
                      {"surface_tension_n_per_m", model.liquid.surface_tension},
                      {"density_kg_per_m3", model.liquid.density}};
    json["gravity_m_per_s2"] = model.gravity;
    json["air"] = {{"density_kg_per_m3", model.air.density},
                   {"drag_coefficient", model.air.drag_coefficient},
                   {"boundary_layer_m", model.air.boundary_layer},
                   {"profile_exponent", model.air.profile_exponent}};
    json["wetting"] = {{"contact_angle_deg", model.wetting.contact_angle / kDegree},
                       {"falling_angle_deg", orNull(own_angle ? own_angle : run.sliding_angle, kDegree)},
                       {"falling_volume_m3", orNull(own_angle ? std::nullopt : run.sliding_volume)},
                       {"kinetic_fraction", model.wetting.kinetic_fraction},
                       {"viscosity_factor_pa_s", model.wetting.viscosity_factor}};
    json["measured_still_m_per_s"] = run.measured ? Json{run.measured->from, run.measured->to} : Json();
    return json;
}

Json caseOf(const TunnelRun& run, const TunnelCase& tunnel_case)
{
    const auto distance = run.measured ? distanceFrom(*run.measured, tunnel_case.thresholds) : std::nullopt;
    Json json = {{"hysteresis", tunnel_case.hysteresis},
                 {"slope_deg", tunnel_case.slope / kDegree},
                 {"volume_m3", tunnel_case.cap.volume},
                 {"contact_radius_m", tunnel_case.cap.contact_radius},
                 {"height_m", tunnel_case.cap.height},
                 {"frontal_area_m2", tunnel_case.cap.frontal_area},
                 {"mass_kg", tunnel_case.forces.mass},
                 {"weight_along_slope_n", tunnel_case.forces.weight * std::sin(tunnel_case.slope)},
                 {"retention_n", tunnel_case.forces.retention},
                 {"sliding_friction_n", tunnel_case.forces.sliding_friction},
                 {"drag_per_wind_squared_n_s2_per_m2", tunnel_case.forces.drag},
                 {"viscous_n_s_per_m", tunnel_case.forces.viscous}};
    json["lower_threshold_m_per_s"] = orNull(tunnel_case.thresholds.lower);
    json["upper_threshold_m_per_s"] = orNull(tunnel_case.thresholds.upper);
    json["threshold_ratio"] = orNull(ratioOf(tunnel_case.thresholds));
    json["distance_from_measured"] = {{"lower_share", distance ? Json(distance->lower) : Json()},
                                      {"upper_share", distance ? Json(distance->upper) : Json()}};
    json["critical_volume_m3"] = orNull(tunnel_case.critical_volume);
    json["critical_radius_m"] = orNull(criticalRadius(tunnel_case));
    json["shedding_wind_m_per_s"] = orNull(tunnel_case.shedding_wind);
    return json;
}

Json runOf(const TunnelRun& run)
{
    Json json = parameters(run);
    const std::size_t winds = run.tunnel.winds.size();
    json["wind_m_per_s"] = run.tunnel.winds;
    json["cases"] = Json::array();
    for (std::size_t c = 0; c < run.tunnel.cases.size(); ++c) {
        Json found = caseOf(run, run.tunnel.cases[c]);
        Json drag = Json::array();
        Json rate = Json::array();
        Json speed = Json::array();
        Json regime = Json::array();
        for (std::size_t w = 0; w < winds; ++w) {
            const TunnelRow& row = run.tunnel.rows[c * winds + w];
            drag.push_back(row.drag);
            rate.push_back(row.acceleration);
            speed.push_back(orNull(row.terminal_velocity));
            regime.push_back(nameOf(row.regime));
        }
        found["drag_n"] = std::move(drag);
        found["acceleration_m_per_s2"] = std::move(rate);
        found["terminal_velocity_m_per_s"] = std::move(speed);
        found["regime"] = std::move(regime);
        json["cases"].push_back(std::move(found));
    }
    return json;
}

// ---------------------------------------------------------------------------------------------------- CSV tables

void append(std::string& line, double value)
{
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value == 0.0 ? 0.0 : value).ptr;
    line.append(text.data(), end);
}

void append(std::string& line, const std::optional<double>& value)
{
    if (value) {
        append(line, *value);
    }
}

template <typename... Values>
void appendCells(std::string& line, const Values&... values)
{
    ((append(line, values), line += ','), ...);
}

/// Writes a line such as `# air.density_kg_per_m3 = 1.204` for every value.
void writeComments(std::ostream& out, const Json& json, const std::string& prefix)
{
    for (const auto& [key, value] : json.items()) {
        if (value.is_object()) {
            writeComments(out, value, prefix + key + ".");
        } else {
            out << "# " << prefix << key << " = " << (value.is_string() ? value.get<std::string>() : value.dump())
                << '\n';
        }
    }
}

constexpr const char* kHeader =
    "preset,hysteresis,slope_deg,volume_m3,contact_radius_m,height_m,frontal_area_m2,mass_kg,weight_along_slope_n,"
    "retention_n,viscous_n_s_per_m,lower_threshold_m_per_s,upper_threshold_m_per_s,wind_m_per_s,drag_n,driving_n,"
    "acceleration_m_per_s2,terminal_velocity_m_per_s,regime\n";

/// Writes the lines of a table; blocks of lines are formatted in parallel.
void writeRows(std::ostream& out, const TunnelRun& run)
{
    const Tunnel& tunnel = run.tunnel;
    const std::size_t winds = tunnel.winds.size();
    constexpr std::size_t kLinesPerBlock = 4096;
    constexpr std::size_t kBlocksAtOnce = 64;
    const std::size_t blocks = (tunnel.rows.size() + kLinesPerBlock - 1) / kLinesPerBlock;
    std::vector<std::string> texts(kBlocksAtOnce);
    for (std::size_t first = 0; first < blocks; first += kBlocksAtOnce) {
        const std::size_t count = std::min(kBlocksAtOnce, blocks - first);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
            std::string& text = texts[k];
            text.clear();
            std::string shared;
            const std::size_t begin = (first + k) * kLinesPerBlock;
            const std::size_t end = std::min(tunnel.rows.size(), begin + kLinesPerBlock);
            for (std::size_t i = begin; i < end; ++i) {
                if (i == begin || i % winds == 0) {
                    const TunnelCase& tunnel_case = tunnel.cases[i / winds];
                    shared = run.preset + ",";
                    appendCells(shared, tunnel_case.hysteresis, tunnel_case.slope / kDegree, tunnel_case.cap.volume,
                                tunnel_case.cap.contact_radius, tunnel_case.cap.height, tunnel_case.cap.frontal_area,
                                tunnel_case.forces.mass, tunnel_case.forces.weight * std::sin(tunnel_case.slope),
                                tunnel_case.forces.retention, tunnel_case.forces.viscous, tunnel_case.thresholds.lower,
                                tunnel_case.thresholds.upper);
                }
                const TunnelRow& row = tunnel.rows[i];
                text += shared;
                appendCells(text, tunnel.winds[i % winds], row.drag, row.driving, row.acceleration,
                            row.terminal_velocity);
                text += nameOf(row.regime);
                text += '\n';
            }
        });
        for (std::size_t k = 0; k < count; ++k) {
            out.write(texts[k].data(), static_cast<std::streamsize>(texts[k].size()));
        }
    }
}

Json traceHeader(const TraceRun& run)
{
    Json json = {{"schema", "droplet-shape.wind-trace/1"}, {"version", kVersion}};
    json.update(parameters(run.run));
    json["droplet"] = caseOf(run.run, run.run.tunnel.cases.front());
    json["wind"] = {
        {"mean_m_per_s", run.wind.mean}, {"gust_m_per_s", run.wind.amplitude}, {"gust_period_s", run.wind.period}};
    json["duration_s"] = run.options.duration;
    json["interval_s"] = run.options.interval;
    json["initial_velocity_m_per_s"] = run.options.velocity;
    json["tolerance"] = run.options.tolerance;
    return json;
}

}  // namespace

void writeTunnelCsv(std::ostream& out, const std::vector<TunnelRun>& runs)
{
    out << "# droplet-shape wind-tunnel " << kVersion << '\n';
    for (const TunnelRun& run : runs) {
        writeComments(out, parameters(run), "");
    }
    out << kHeader;
    for (const TunnelRun& run : runs) {
        writeRows(out, run);
    }
}

void writeTunnelJson(std::ostream& out, const std::vector<TunnelRun>& runs)
{
    Json json = {{"schema", "droplet-shape.wind-tunnel/1"}, {"version", kVersion}, {"runs", Json::array()}};
    for (const TunnelRun& run : runs) {
        json["runs"].push_back(runOf(run));
    }
    out << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

void writeTraceCsv(std::ostream& out, const TraceRun& run)
{
    out << "# droplet-shape wind-tunnel " << kVersion << '\n';
    Json shared = traceHeader(run);
    shared.erase("schema");
    shared.erase("version");
    writeComments(out, shared, "");
    for (const MotionEvent& event : run.motion.events) {
        std::string line = event.moves ? "# moves_at_s = " : "# caught_at_s = ";
        append(line, event.time);
        out << line << '\n';
    }
    out << "time_s,wind_m_per_s,position_m,velocity_m_per_s,acceleration_m_per_s2\n";
    std::string lines;
    constexpr std::size_t kEnough = 1 << 20;
    for (const MotionPoint& point : run.motion.points) {
        appendCells(lines, point.time, point.wind, point.position, point.velocity, point.acceleration);
        lines.back() = '\n';
        if (lines.size() > kEnough) {
            out << lines;
            lines.clear();
        }
    }
    out << lines;
}

void writeTraceJson(std::ostream& out, const TraceRun& run)
{
    Json json = traceHeader(run);
    json["steps"] = run.motion.steps;
    json["steps_rejected"] = run.motion.rejected;
    json["events"] = Json::array();
    for (const MotionEvent& event : run.motion.events) {
        json["events"].push_back({{"time_s", event.time}, {"what", event.moves ? "moves" : "caught"}});
    }
    const auto column = [&](const char* name, double MotionPoint::*member) {
        Json values = Json::array();
        for (const MotionPoint& point : run.motion.points) {
            values.push_back(point.*member);
        }
        json[name] = std::move(values);
    };
    column("time_s", &MotionPoint::time);
    column("wind_m_per_s", &MotionPoint::wind);
    column("position_m", &MotionPoint::position);
    column("velocity_m_per_s", &MotionPoint::velocity);
    column("acceleration_m_per_s2", &MotionPoint::acceleration);
    out << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace droplet
