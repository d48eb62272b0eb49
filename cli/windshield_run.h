// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/wind_io/windshield_report.h"
#include "progress_display.h"
#include "windshield_options.h"

namespace cli {

/// Simulates rain on a windshield and writes all outputs.
/// @param progress  shows how many frames are finished
/// @throws droplet::Error on any failure
droplet::WindshieldReport simulateWindshield(const WindshieldOptions& options, ProgressDisplay& progress);

}  // namespace cli
