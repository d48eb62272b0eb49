// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/liquid2d_io/liquid_report.h"
#include "liquid2d_options.h"
#include "progress_display.h"
#include "run_files.h"

namespace cli {

/// All files that a run reads and writes.
RunFiles filesOf(const Liquid2dOptions& options);

/// Simulates or reads the liquid, draws all frames and writes all files.
/// @throws droplet::Error
droplet::LiquidReport drawLiquid2d(const Liquid2dOptions& options, ProgressDisplay& progress);

}  // namespace cli
