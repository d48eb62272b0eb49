// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "flow_options.h"
#include "run_files.h"

namespace cli {

/// Names of the maps of a frame.
inline constexpr std::array kFlowMaps{"normal", "thickness", "age", "wet"};

/// Path of a frame's map: its name before the extension.
std::string flowMapPath(const NumberedPath& maps, std::size_t number, const char* map);

/// All files that a run reads and writes.
RunFiles filesOf(const FlowOptions& options);

/// Whether all files of a frame exist.
bool hasFlowFrame(const FlowOptions& options, std::size_t number);

/// Hash of the options and the files that decide what the frames show.
std::string flowFingerprint(const FlowOptions& options);

}  // namespace cli
