// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid2d_command.h"

#include <fmt/core.h>
#include <tbb/global_control.h>

#include <iostream>
#include <optional>
#include <string>
#include <variant>

#include "files.h"
#include "liquid2d_options.h"
#include "liquid2d_run.h"
#include "progress_display.h"
#include "terminal.h"

namespace cli {
namespace {

void printSummary(const droplet::LiquidReport& report)
{
    const droplet::LiquidFrameRow& last = report.frames.back();
    std::cerr << fmt::format("{} frame{} of {:.4g} s; {} particles, {} steps\n", report.frames.size(),
                             report.frames.size() == 1 ? "" : "s", last.time, last.particles, last.steps);
    for (const auto& path : {report.output, report.masks}) {
        if (path && !isStream(*path)) {
            std::cerr << oneLine(*path) << "\n";
        }
    }
    std::cerr << std::flush;
}

}  // namespace

int runLiquid2d(int argc, const char* const* argv)
{
    const auto parsed = parseLiquid2d(argc, argv);
    if (const auto* text = std::get_if<std::string>(&parsed)) {
        print(*text);
        return 0;
    }
    const auto& options = std::get<Liquid2dOptions>(parsed);
    std::optional<tbb::global_control> threads;
    if (options.threads) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, *options.threads);
    }
    const bool is_silent = options.quiet && options.progress == ProgressMode::Auto;
    ProgressDisplay progress(is_silent ? ProgressMode::None : options.progress);
    const droplet::LiquidReport report = drawLiquid2d(options, progress);
    progress.finish();
    if (options.quiet) {
        return 0;
    }
    if (options.progress != ProgressMode::Json) {
        printSummary(report);
    }
    return 0;
}

}  // namespace cli
