// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include "flow_options.h"
#include "run_files.h"

namespace cli {

/// Names of the maps of a frame.
inline constexpr std::array kFlowMaps{"normal", "thickness", "age", "wet"};

/// All files that a run reads and writes.
RunFiles filesOf(const FlowOptions& options);

/// Hash of the options and the files that decide what the frames show.
std::string flowFingerprint(const FlowOptions& options);

}  // namespace cli
