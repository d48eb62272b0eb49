// SPDX-License-Identifier: GPL-3.0-or-later
#include "wind_tunnel_command.h"

#include <fmt/core.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "droplet/drawing/drawing.h"
#include "droplet/units.h"
#include "droplet/wind/trace.h"
#include "droplet/wind/tunnel.h"
#include "droplet/wind_io/chart.h"
#include "droplet/wind_io/tunnel_report.h"
#include "files.h"
#include "library_message.h"
#include "run_files.h"
#include "wind_tunnel_options.h"

namespace cli {
namespace {

std::string share(double value)
{
    // Rounding first avoids -0.
    return fmt::format("{:+.1f} %", std::round(1000.0 * value) / 10.0 + 0.0);
}

std::string volume(double value)
{
    return fmt::format("{:.4g}", value / droplet::kMicrolitre) + " µL";
}

/// Heading of all lines with the same slope and hysteresis.
std::string headOf(const droplet::TunnelRun& run, const droplet::TunnelCase& of)
{
    std::string line = run.preset + ": contact angle " +
                       fmt::format("{:.4g}", run.swept.model.wetting.contact_angle / droplet::kDegree) + "°, slope " +
                       fmt::format("{:.4g}", of.slope / droplet::kDegree) + "°, ";
    if (const auto& angle = run.swept.model.wetting.sliding_angle) {
        line += "sliding angle " + fmt::format("{:.4g}", *angle / droplet::kDegree) + "° of every droplet";
    } else {
        line += "hysteresis " + fmt::format("{:.3g}", of.hysteresis);
        if (run.sliding_angle) {
            line += " (sliding angle " + fmt::format("{:.4g}", *run.sliding_angle / droplet::kDegree) + "° of " +
                    volume(*run.sliding_volume) + ")";
        }
    }
    if (of.critical_volume) {
        const double radius = of.cap.contact_radius * std::cbrt(*of.critical_volume / of.cap.volume);
        line += "; without wind droplets run down from " + volume(*of.critical_volume) + ", contact radius " +
                fmt::format("{:.3g}", radius / droplet::kMillimetre) + " mm";
    }
    return line + "\n";
}

std::string lineOf(const droplet::TunnelRun& run, const droplet::TunnelCase& of)
{
    const droplet::Thresholds& found = of.thresholds;
    std::string line = "  " + volume(of.cap.volume) + ": ";
    if (!found.upper) {
        line += found.lower ? "still from " + fmt::format("{:.2f}", *found.lower) + " m/s on" : "no wind moves it";
        return line + "\n";
    }
    line += found.lower ? "still from " + fmt::format("{:.2f}", *found.lower) + " to " : "still up to ";
    line += fmt::format("{:.2f}", *found.upper) + " m/s";
    if (const auto distance = run.measured ? distanceFrom(*run.measured, found) : std::nullopt) {
        line += ", " + share(distance->lower) + " and " + share(distance->upper) + " off the measured " +
                fmt::format("{:.3g}", run.measured->from) + " to " + fmt::format("{:.3g}", run.measured->to) + " m/s";
    }
    return line + "\n";
}

std::string summary(const std::vector<droplet::TunnelRun>& runs)
{
    constexpr std::size_t kMaxLines = 24;
    std::string lines;
    std::size_t count = 0;
    std::size_t left_out = 0;
    for (const droplet::TunnelRun& run : runs) {
        const std::size_t volumes = run.swept.volumes.size();
        for (std::size_t c = 0; c < run.tunnel.cases.size(); ++c) {
            if (count++ >= kMaxLines) {
                ++left_out;
                continue;
            }
            const droplet::TunnelCase& of = run.tunnel.cases[c];
            lines += (c % volumes == 0 ? headOf(run, of) : "") + lineOf(run, of);
        }
    }
    return lines + (left_out > 0 ? "  and " + std::to_string(left_out) + " more\n" : "");
}

droplet::Drawing drawn(const std::vector<droplet::TunnelRun>& runs, bool is_map)
{
    droplet::ChartOptions options;
    for (const droplet::TunnelRun& run : runs) {
        for (const droplet::TunnelRow& row : run.tunnel.rows) {
            options.min = std::min(options.min, row.acceleration);
            options.max = std::max(options.max, row.acceleration);
        }
    }
    std::vector<droplet::Drawing> drawings;
    for (const droplet::TunnelRun& run : runs) {
        options.title = "Droplets in the wind tunnel: " + run.preset;
        options.measured = run.measured;
        drawings.push_back(is_map ? regimeMap(run.swept, run.tunnel, options)
                                  : accelerationChart(run.swept, run.tunnel, options));
    }
    return beside(drawings);
}

droplet::TraceRun traced(const WindTunnelOptions& options)
{
    const droplet::TunnelRun& run = options.runs.front();
    const droplet::TunnelCase& of = run.tunnel.cases.front();
    return {run, options.gust, options.trace, traceMotion(of.forces, of.slope, options.gust, options.trace)};
}

OutputFile fileOf(const TunnelOutput& output, const WindTunnelOptions& options)
{
    const auto with = [&](auto write) { return OutputFile{output.path, std::move(write)}; };
    const std::vector<droplet::TunnelRun>& runs = options.runs;
    const auto svg = [&](bool is_map) {
        return with([&runs, is_map](std::ostream& out) { writeSvg(drawn(runs, is_map), out); });
    };
    const auto png = [&](bool is_map) {
        // Two pixels per point are sharp on high-density screens.
        constexpr double kPixels = 2.0;
        return with([&runs, is_map](std::ostream& out) { writePng(pictureOf(drawn(runs, is_map), kPixels), out); });
    };
    switch (output.kind) {
        case TunnelFile::Csv:
            return with([&runs](std::ostream& out) { writeTunnelCsv(out, runs); });
        case TunnelFile::Json:
            return with([&runs](std::ostream& out) { writeTunnelJson(out, runs); });
        case TunnelFile::ChartSvg:
            return svg(false);
        case TunnelFile::ChartPng:
            return png(false);
        case TunnelFile::MapSvg:
            return svg(true);
        case TunnelFile::MapPng:
            return png(true);
        case TunnelFile::TraceCsv:
            return with([&options](std::ostream& out) { writeTraceCsv(out, traced(options)); });
        case TunnelFile::TraceJson:
            break;
    }
    return with([&options](std::ostream& out) { writeTraceJson(out, traced(options)); });
}

/// Computes all runs, writes the files and prints a summary.
void computeRuns(WindTunnelOptions& options)
{
    std::optional<tbb::global_control> limit;
    if (options.threads) {
        limit.emplace(tbb::global_control::max_allowed_parallelism, *options.threads);
    }

    for (droplet::TunnelRun& run : options.runs) {
        run.tunnel = sweep(run.swept);
    }
    std::vector<OutputFile> files;
    for (const TunnelOutput& output : options.outputs) {
        files.push_back(fileOf(output, options));
    }
    if (!files.empty()) {
        writeTogether(files, options.files);
    }
    if (options.quiet) {
        return;
    }
    if (files.empty()) {
        print(summary(options.runs));  // the summary is the only output
    } else {
        std::cerr << summary(options.runs);
    }
}

}  // namespace

int runWindTunnel(int argc, const char* const* argv)
{
    auto parsed = parseWindTunnel(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    auto& options = std::get<WindTunnelOptions>(parsed);
    RunFiles run_files;
    run_files.reads("--config", options.config);
    for (const TunnelOutput& output : options.outputs) {
        run_files.writes(output.name, output.path);
    }
    checkFiles(run_files, options.files);
    inTermsOf(options.terms, run_files, [&] { computeRuns(options); });
    return 0;
}

}  // namespace cli
