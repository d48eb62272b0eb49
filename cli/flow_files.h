// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "flow_options.h"
#include "run_files.h"

namespace cli {

/// Names of the maps of a frame.
inline constexpr std::array kFlowMaps{"normal", "thickness", "age", "wet"};

/// Path of a frame's map: its name before the extension.
std::string flowMapPath(const NumberedPath& maps, std::size_t number, const char* map);

/// All files that a run reads and writes.
RunFiles filesOf(const FlowOptions& options);

/// Files of every frame, if each has one: these and the maps.
std::vector<NumberedPath> flowFrames(const FlowOptions& options);

/// Hash of the options and the files that decide what the frames show.
std::string flowFingerprint(const FlowOptions& options);

}  // namespace cli
