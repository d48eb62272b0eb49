// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/windshield/windshield.h"
#include "droplet/windshield_view/view.h"

namespace droplet {

/// Water balance at one time.
struct BalanceRow {
    double time = 0.0;          ///< [s]
    double speed = 0.0;         ///< speed of the vehicle [m/s]
    WaterBalance balance;       ///< water since the start
    std::uint64_t still = 0;    ///< number of still droplets
    std::uint64_t running = 0;  ///< number of running droplets, also those at rest
    std::uint64_t moving = 0;   ///< number of running droplets that move
};

/// Water balance of a state.
/// @param state  state of the windshield
/// @param speed  speed of the vehicle [m/s]
BalanceRow balanceRow(const WindshieldState& state, double speed);

/// Inputs and results of a run.
struct WindshieldReport {
    std::string preset;                      ///< name of the preset
    std::optional<std::string> drive_cycle;  ///< path
    std::optional<std::string> surface;      ///< path
    std::optional<std::string> background;   ///< path
    std::optional<std::string> environment;  ///< path
    std::string output;                      ///< path
    WindshieldParameters parameters;         ///< parameters of the simulation
    ViewOptions view;                        ///< options of the driver's view
    double frames_per_second = 30.0;         ///< > 0
    double warm_up = 0.0;                    ///< rain before the first frame [s]
    double step = 0.0;                       ///< time step of the simulation [s]
    std::size_t frames = 0;                  ///< number of frames
    std::optional<double> map_thickness;     ///< of white in maps that are PNG [m]; empty: there are none
    std::vector<BalanceRow> balance;         ///< water balance over time
    WindshieldCounts counts;                 ///< event counters since the start
    std::vector<std::string> warnings;       ///< all warnings of the run
    double time_total = 0.0;                 ///< run time [s]
    std::uint64_t peak_memory = 0;           ///< [byte]
};

/// Writes the report as one JSON object, schema droplet-shape.windshield/1: SI units; every key is always present. The
/// stream is in a failed state if a write failed.
/// @throws Error NoSuchDroplet if a number is not finite
void writeWindshieldReport(std::ostream& out, const WindshieldReport& report);

}  // namespace droplet
