// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/flow_io/flow_report.h"
#include "flow_options.h"
#include "progress_display.h"

namespace cli {

/// Lets droplets run over an object and writes all outputs.
/// @throws droplet::Error on any failure
droplet::FlowReport simulateFlow(const FlowOptions& options, ProgressDisplay& progress);

}  // namespace cli
