// SPDX-License-Identifier: GPL-3.0-or-later
//
// The names are the contract of the schemas droplet-shape.wind-tunnel/1 and droplet-shape.wind-trace/1: keys may be
// added, none renamed or left out.
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

std::optional<double> criticalRadius(const TunnelCase& of)
{
    if (!of.critical_volume) {
        return std::nullopt;
    }
    return of.cap.contact_radius * std::cbrt(*of.critical_volume / of.cap.volume);
}

std::optional<double> ratioOf(const Thresholds& thresholds)
{
    return thresholds.lower && thresholds.upper ? std::optional(*thresholds.upper / *thresholds.lower) : std::nullopt;
}

/// What all cases of a run share.
Json parameters(const TunnelRun& run)
{
    const ForceModel& model = run.swept.model;
    const auto& own_angle = model.wetting.falling_angle;
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
                       {"falling_angle_deg", orNull(own_angle ? own_angle : run.falling_angle, kDegree)},
                       {"falling_volume_m3", orNull(own_angle ? std::nullopt : run.falling_volume)},
                       {"kinetic_fraction", model.wetting.kinetic_fraction},
                       {"viscosity_factor_pa_s", model.wetting.viscosity_factor}};
    json["measured_still_m_per_s"] = run.measured ? Json{run.measured->from, run.measured->to} : Json();
    return json;
}

Json caseOf(const TunnelRun& run, const TunnelCase& of)
{
    const auto distance = run.measured ? distanceFrom(*run.measured, of.thresholds) : std::nullopt;
    Json json = {{"hysteresis", of.hysteresis},
                 {"slope_deg", of.slope / kDegree},
                 {"volume_m3", of.cap.volume},
                 {"contact_radius_m", of.cap.contact_radius},
                 {"height_m", of.cap.height},
                 {"frontal_area_m2", of.cap.frontal_area},
                 {"mass_kg", of.forces.mass},
                 {"weight_along_slope_n", of.forces.weight * std::sin(of.slope)},
                 {"retention_n", of.forces.retention},
                 {"sliding_friction_n", of.forces.sliding_friction},
                 {"drag_per_wind_squared_n_s2_per_m2", of.forces.drag},
                 {"viscous_n_s_per_m", of.forces.viscous}};
    json["lower_threshold_m_per_s"] = orNull(of.thresholds.lower);
    json["upper_threshold_m_per_s"] = orNull(of.thresholds.upper);
    json["threshold_ratio"] = orNull(ratioOf(of.thresholds));
    json["distance_from_measured"] = {{"lower_share", distance ? Json(distance->lower) : Json()},
                                      {"upper_share", distance ? Json(distance->upper) : Json()}};
    json["critical_volume_m3"] = orNull(of.critical_volume);
    json["critical_radius_m"] = orNull(criticalRadius(of));
    json["shedding_wind_m_per_s"] = orNull(of.shedding_wind);
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

// ---------------------------------------------------------------------------------------------------- the tables

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

/// `# air.density_kg_per_m3 = 1.204`, one for every leaf.
void writeRemarks(std::ostream& out, const Json& json, const std::string& prefix)
{
    for (const auto& [key, value] : json.items()) {
        if (value.is_object()) {
            writeRemarks(out, value, prefix + key + ".");
        } else {
            out << "# " << prefix << key << " = " << (value.is_string() ? value.get<std::string>() : value.dump())
                << '\n';
        }
    }
}

constexpr const char* kHead =
    "preset,hysteresis,slope_deg,volume_m3,contact_radius_m,height_m,frontal_area_m2,mass_kg,weight_along_slope_n,"
    "retention_n,viscous_n_s_per_m,lower_threshold_m_per_s,upper_threshold_m_per_s,wind_m_per_s,drag_n,driving_n,"
    "acceleration_m_per_s2,terminal_velocity_m_per_s,regime\n";

/// Lines of a table: long runs of them are put into words side by side.
void writeRows(std::ostream& out, const TunnelRun& run)
{
    const Tunnel& tunnel = run.tunnel;
    const std::size_t winds = tunnel.winds.size();
    constexpr std::size_t kLines = 4096;
    constexpr std::size_t kAtOnce = 64;
    const std::size_t parts = (tunnel.rows.size() + kLines - 1) / kLines;
    std::vector<std::string> texts(kAtOnce);
    for (std::size_t first = 0; first < parts; first += kAtOnce) {
        const std::size_t count = std::min(kAtOnce, parts - first);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
            std::string& text = texts[k];
            text.clear();
            std::string shared;
            const std::size_t begin = (first + k) * kLines;
            const std::size_t end = std::min(tunnel.rows.size(), begin + kLines);
            for (std::size_t i = begin; i < end; ++i) {
                if (i == begin || i % winds == 0) {
                    const TunnelCase& of = tunnel.cases[i / winds];
                    shared = run.preset + ",";
                    appendCells(shared, of.hysteresis, of.slope / kDegree, of.cap.volume, of.cap.contact_radius,
                                of.cap.height, of.cap.frontal_area, of.forces.mass,
                                of.forces.weight * std::sin(of.slope), of.forces.retention, of.forces.viscous,
                                of.thresholds.lower, of.thresholds.upper);
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

Json traced(const TraceRun& run)
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
        writeRemarks(out, parameters(run), "");
    }
    out << kHead;
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
    Json shared = traced(run);
    shared.erase("schema");
    shared.erase("version");
    writeRemarks(out, shared, "");
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
    Json json = traced(run);
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
