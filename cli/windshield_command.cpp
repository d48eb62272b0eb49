// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_command.h"

#include <fmt/core.h>
#include <tbb/global_control.h>

#include <iostream>
#include <optional>
#include <string>
#include <variant>

#include "files.h"
#include "progress_display.h"
#include "shape_command.h"
#include "terminal.h"
#include "windshield_files.h"
#include "windshield_options.h"
#include "windshield_run.h"

namespace cli {
namespace {

std::string litres(double volume)
{
    return fmt::format("{:.4g} mL", volume / 1e-6);
}

void printSummary(const droplet::WindshieldReport& report)
{
    const droplet::BalanceRow& last = report.balance.back();
    const droplet::WaterBalance& water = last.balance;
    std::cerr << fmt::format("{} frame{}; at {:.4g} s {} still droplets, {} larger, of which {} move\n", report.frames,
                             report.frames == 1 ? "" : "s", last.time, last.still, last.running, last.moving)
              << fmt::format("water: {} rained = {} on the glass + {} run off + {} wiped off\n", litres(water.rained),
                             litres(water.on_glass_still + water.on_glass_running), litres(water.left),
                             litres(water.wiped))
              << oneLine(report.output) << "\n";
    std::cerr << std::flush;
}

}  // namespace

int runWindshield(int argc, const char* const* argv)
{
    const auto parsed = parseWindshield(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    const auto& options = std::get<WindshieldOptions>(parsed);
    checkFiles(filesOf(options), options.output_options);
    std::optional<tbb::global_control> threads;
    if (options.threads) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, *options.threads);
    }
    const bool is_silent = options.quiet && options.progress == ProgressMode::Auto;
    ProgressDisplay progress(is_silent ? ProgressMode::None : options.progress);
    const droplet::WindshieldReport report = simulateWindshield(options, progress);
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
