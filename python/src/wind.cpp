// SPDX-License-Identifier: GPL-3.0-or-later
#include "wind.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "arguments.h"
#include "dew_run.h"
#include "droplet/flow_io/dew_report.h"
#include "droplet/flow_io/flow_report.h"
#include "droplet/wind/tunnel.h"
#include "droplet/wind_io/tunnel_report.h"
#include "droplet/wind_io/windshield_report.h"
#include "flow_files.h"
#include "flow_options.h"
#include "flow_run.h"
#include "progress_display.h"
#include "wind_tunnel_options.h"
#include "windshield_files.h"
#include "windshield_options.h"
#include "windshield_run.h"
#include "work.h"

namespace binding {
namespace {

namespace py = pybind11;

/// Argument with a path, even if the path begins like an option or means standard output.
std::string argumentOf(const std::filesystem::path& path)
{
    const std::string text = path.string();
    return text.starts_with('-') ? "./" + text : text;
}

std::string windTunnel(const Arguments& arguments)
{
    auto options = parsed(cli::parseWindTunnel, arguments);
    const Work work(options.threads);
    for (droplet::TunnelRun& run : options.runs) {
        run.tunnel = sweep(run.swept);
    }
    std::ostringstream out;
    writeTunnelJson(out, options.runs);
    return std::move(out).str();
}

std::string windshield(const std::filesystem::path& output, const Arguments& arguments)
{
    Arguments all = arguments;
    all.insert(all.end(), {"--quiet", argumentOf(output)});
    const auto options = parsed(cli::parseWindshield, all);
    const Work work(options.run.threads);
    checkFiles(filesOf(options), options.run.files);
    cli::ProgressDisplay progress(cli::ProgressMode::None);
    const droplet::WindshieldReport report = cli::simulateWindshield(options, progress);
    progress.finish();
    std::ostringstream out;
    writeWindshieldReport(out, report);
    return std::move(out).str();
}

std::string flow(const std::optional<std::filesystem::path>& object, const std::filesystem::path& output,
                 const Arguments& arguments)
{
    Arguments all = arguments;
    all.emplace_back("--quiet");
    if (object) {
        all.push_back(argumentOf(*object));
    }
    all.push_back(argumentOf(output));
    const auto options = parsed(cli::parseFlow, all);
    const Work work(options.run.threads);
    checkFiles(filesOf(options), options.run.files);
    cli::ProgressDisplay progress(cli::ProgressMode::None);
    const droplet::FlowReport report = cli::simulateFlow(options, progress);
    progress.finish();
    std::ostringstream out;
    writeFlowReport(out, report);
    return std::move(out).str();
}

std::string dew(const std::filesystem::path& object, const std::filesystem::path& output, const Arguments& arguments)
{
    Arguments all = arguments;
    all.insert(all.end(), {"--quiet", argumentOf(object), argumentOf(output)});
    const auto options = parsed(cli::parseDew, all);
    const Work work(options.run.threads);
    checkFiles(filesOf(options), options.run.files);
    const droplet::DewReport report = cli::makeDew(options);
    std::ostringstream out;
    writeDewReport(out, report);
    return std::move(out).str();
}

}  // namespace

void bindWind(py::module_& module)
{
    module.def("wind_tunnel", &windTunnel);
    module.def("windshield", &windshield);
    module.def("flow", &flow);
    module.def("dew", &dew);
}

}  // namespace binding
