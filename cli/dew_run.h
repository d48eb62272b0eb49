// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "dew_options.h"
#include "droplet/flow_io/dew_report.h"
#include "run_files.h"

namespace cli {

/// Files that the command reads and writes.
RunFiles filesOf(const DewCommandOptions& options);

/// Words on the droplets that a file lacks.
std::string lostOf(const droplet::DewReport& report);

/// Covers an object with droplets and writes all outputs.
/// @throws droplet::Error on any failure
droplet::DewReport makeDew(const DewCommandOptions& options);

}  // namespace cli
