// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_command.h"

#include <fmt/core.h>

#include <string>
#include <variant>

#include "files.h"
#include "flow_files.h"
#include "flow_options.h"
#include "flow_run.h"
#include "run_command.h"
#include "terminal.h"

namespace cli {
namespace {

std::string litres(double volume)
{
    return fmt::format("{:.4g} mL", volume / 1e-6);
}

std::string summaryOf(const droplet::FlowReport& report)
{
    const droplet::FlowBalanceRow& last = report.balance.back();
    const droplet::FlowBalance& liquid = last.balance;
    return fmt::format("{} frame{}; at {:.4g} s {} droplets run, {} rest and {} fall\n", report.frames,
                       report.frames == 1 ? "" : "s", last.time, last.running, last.still, last.airborne) +
           fmt::format("liquid: {} released = {} on the object + {} in the air + {} fallen + {} dried\n",
                       litres(liquid.released), litres(liquid.running + liquid.still + liquid.streaks),
                       litres(liquid.airborne), litres(liquid.left), litres(liquid.dried)) +
           oneLine(report.output) + "\n";
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
    return checkAndRun(options.run, filesOf(options), [&](ProgressDisplay& progress) {
        const droplet::FlowReport report = simulateFlow(options, progress);
        return RunEnd{summaryOf(report), report.warnings};
    });
}

}  // namespace cli
