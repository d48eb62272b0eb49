// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_command.h"

#include <fmt/core.h>
#include <tbb/global_control.h>

#include <iostream>
#include <optional>
#include <string>
#include <variant>

#include "files.h"
#include "flow_files.h"
#include "flow_options.h"
#include "flow_run.h"
#include "progress_display.h"
#include "shape_command.h"
#include "terminal.h"

namespace cli {
namespace {

std::string litres(double volume)
{
    return fmt::format("{:.4g} mL", volume / 1e-6);
}

void printSummary(const droplet::FlowReport& report)
{
    const droplet::FlowBalanceRow& last = report.balance.back();
    const droplet::FlowBalance& liquid = last.balance;
    std::cerr << fmt::format("{} frame{}; at {:.4g} s {} droplets run, {} rest and {} fall\n", report.frames,
                             report.frames == 1 ? "" : "s", last.time, last.running, last.still, last.airborne)
              << fmt::format("liquid: {} released = {} on the object + {} in the air + {} fallen + {} dried\n",
                             litres(liquid.released), litres(liquid.running + liquid.still + liquid.streaks),
                             litres(liquid.airborne), litres(liquid.left), litres(liquid.dried))
              << oneLine(report.output) << "\n";
    std::cerr << std::flush;
}

}  // namespace

int runFlow(int argc, const char* const* argv)
{
    const auto parsed = parseFlow(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    const auto& options = std::get<FlowOptions>(parsed);
    checkFiles(filesOf(options), options.output_options);
    std::optional<tbb::global_control> threads;
    if (options.threads) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, *options.threads);
    }
    const bool is_silent = options.quiet && options.progress == ProgressMode::Auto;
    ProgressDisplay progress(is_silent ? ProgressMode::None : options.progress);
    const droplet::FlowReport report = simulateFlow(options, progress);
    progress.finish();
    if (options.quiet) {
        return 0;
    }
    if (options.progress != ProgressMode::Json) {
        printSummary(report);
    }
    for (const std::string& warning : report.warnings) {
        printWarning(warning, options.progress);
    }
    return 0;
}

}  // namespace cli
