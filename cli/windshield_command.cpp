// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_command.h"

#include <fmt/core.h>

#include <string>
#include <variant>

#include "files.h"
#include "run_command.h"
#include "terminal.h"
#include "windshield_files.h"
#include "windshield_live.h"
#include "windshield_options.h"
#include "windshield_run.h"

namespace cli {
namespace {

std::string litres(double volume)
{
    return fmt::format("{:.4g} mL", volume / 1e-6);
}

std::string summaryOf(const droplet::WindshieldReport& report)
{
    const droplet::BalanceRow& last = report.balance.back();
    const droplet::WaterBalance& water = last.balance;
    return fmt::format("{} frame{}; at {:.4g} s {} still droplets, {} larger, of which {} move\n", report.frames,
                       report.frames == 1 ? "" : "s", last.time, last.still, last.running, last.moving) +
           fmt::format("water: {} rained = {} on the glass + {} run off + {} wiped off\n", litres(water.rained),
                       litres(water.on_glass_still + water.on_glass_film + water.on_glass_running), litres(water.left),
                       litres(water.wiped)) +
           fmt::format("on the glass: {} in the film, {} in still droplets, {} in larger ones\n",
                       litres(water.on_glass_film), litres(water.on_glass_still), litres(water.on_glass_running)) +
           oneLine(report.output) + "\n";
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
    if (options.live) {
        return checkAndRun(options.run, filesOfLive(options), [&](ProgressDisplay&) { return writeLive(options); });
    }
    return checkAndRun(options.run, filesOf(options), [&](ProgressDisplay& progress) {
        const droplet::WindshieldReport report = simulateWindshield(options, progress);
        return RunEnd{summaryOf(report), report.warnings};
    });
}

}  // namespace cli
