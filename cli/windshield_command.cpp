// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_command.h"

#include <tbb/global_control.h>

#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <variant>

#include "files.h"
#include "terminal.h"
#include "windshield_files.h"
#include "windshield_options.h"
#include "windshield_run.h"

namespace cli {
namespace {

std::string litres(double volume)
{
    std::ostringstream text;
    text << std::setprecision(4) << volume / 1e-6 << " mL";
    return text.str();
}

void tell(const droplet::WindshieldReport& report)
{
    const droplet::BalanceRow& last = report.balance.back();
    const droplet::WaterBalance& water = last.balance;
    std::ostringstream text;
    text << report.frames << (report.frames == 1 ? " frame" : " frames") << "; at " << std::setprecision(4) << last.time
         << " s " << last.still << " still droplets, " << last.running << " larger, of which " << last.moving
         << " move\n"
         << "water: " << litres(water.rained) << " rained = " << litres(water.on_glass_still + water.on_glass_running)
         << " on the glass + " << litres(water.left) << " left + " << litres(water.wiped) << " wiped\n"
         << report.output << "\n";
    std::cerr << text.str();
    for (const std::string& warning : report.warnings) {
        std::cerr << paint("warning: ", Colour::Yellow) << oneLine(warning) << "\n";
    }
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
    checkWindshieldFiles(options);
    std::optional<tbb::global_control> threads;
    if (options.threads) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, *options.threads);
    }
    const droplet::WindshieldReport report = playWindshield(options);
    if (!options.quiet) {
        tell(report);
    }
    return 0;
}

}  // namespace cli
