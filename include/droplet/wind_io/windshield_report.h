// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/view/view.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

/// Where the water is at a time.
struct BalanceRow {
    double time = 0.0;   ///< [s]
    double speed = 0.0;  ///< of the vehicle [m/s]
    WaterBalance balance;
    std::uint64_t still = 0;    ///< still droplets
    std::uint64_t running = 0;  ///< droplets that may run
    std::uint64_t moving = 0;   ///< of those, how many do
};

/// @param speed  of the vehicle [m/s]
BalanceRow balanceRow(const WindshieldState& state, double speed);

/// How a windshield was played.
struct WindshieldReport {
    std::string preset;
    std::optional<std::string> drive_cycle;  ///< path
    std::optional<std::string> surface;      ///< path
    std::optional<std::string> background;   ///< path
    std::optional<std::string> environment;  ///< path
    std::string output;
    WindshieldParameters parameters;
    ViewOptions view;
    double frames_per_second = 30.0;
    double warm_up = 0.0;  ///< [s]
    double step = 0.0;     ///< [s]
    std::size_t frames = 0;
    std::vector<BalanceRow> balance;
    WindshieldCounts counts;
    std::vector<std::string> warnings;
    double time_total = 0.0;  ///< [s]
    std::uint64_t peak_memory = 0;
};

/// Writes the report as one JSON object of the schema droplet-shape.windshield/1: SI numbers, every key always there.
/// The stream is left failed if it did not take everything.
/// @throws Error NoSuchDroplet if a number is not finite
void writeWindshieldReport(std::ostream& out, const WindshieldReport& report);

}  // namespace droplet
