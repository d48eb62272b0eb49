// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid2d_command.h"

#include <fmt/core.h>

#include <cstddef>
#include <string>
#include <variant>

#include "files.h"
#include "liquid2d_options.h"
#include "liquid2d_run.h"
#include "run_command.h"
#include "terminal.h"

namespace cli {
namespace {

std::string summaryOf(const droplet::LiquidReport& report)
{
    const droplet::LiquidFrameRow& last = report.frames.back();
    const std::size_t frames = report.frames.size();
    std::string text = fmt::format(
        "{} frame{}, {:.4g} s; {} particles{}, {} steps\n", frames, frames == 1 ? "" : "s",
        static_cast<double>(frames) / report.frames_per_second, last.particles,
        report.removed > 0 ? fmt::format(" at the end, {} left the window", report.removed) : "", last.steps);
    for (const auto& path : {report.output, report.masks}) {
        if (path && !isStream(*path)) {
            text += oneLine(*path) + "\n";
        }
    }
    return text;
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
    return checkAndRun(options.run, filesOf(options), [&](ProgressDisplay& progress) {
        return RunEnd{summaryOf(drawLiquid2d(options, progress))};  // warnings were printed at once
    });
}

}  // namespace cli
