// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "command_terms.h"
#include "droplet/io/output.h"
#include "droplet/wind/trace.h"
#include "droplet/wind_io/tunnel_report.h"

namespace cli {

/// Content and format of a wind tunnel's output.
enum class TunnelFile { Csv, Json, ChartSvg, ChartPng, MapSvg, MapPng, TraceCsv, TraceJson };

struct TunnelOutput {
    std::string name;  ///< name of the option, for messages
    std::string path;  ///< or kStandardStream
    TunnelFile kind = TunnelFile::Csv;
};

struct WindTunnelOptions {
    std::vector<droplet::TunnelRun> runs;  ///< without results yet
    std::vector<TunnelOutput> outputs;
    bool traces = false;
    droplet::Gust gust;
    droplet::MotionOptions trace;
    std::optional<std::string> config;
    std::optional<std::size_t> threads;
    droplet::OutputOptions files;
    bool quiet = false;
    CommandTerms terms;  ///< for messages
};

/// Reads the command line; returns the options, or the text that --help or --version prints.
/// @throws droplet::Error InvalidArgument
std::variant<WindTunnelOptions, std::string> parseWindTunnel(int argc, const char* const* argv);

}  // namespace cli
