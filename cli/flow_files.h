// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "flow_options.h"

namespace cli {

/// Names of the maps of a frame.
inline constexpr std::array kFlowMaps{"normal", "thickness", "age", "wet"};

/// Path of a frame's map: its name before the extension.
std::string flowMapPath(const NumberedPath& maps, std::size_t number, const char* map);

/// Path of the state of an interrupted run, beside its frames.
std::string flowCheckpointPath(const FlowOptions& options);

/// Finds errors before any work is done: outputs that replace inputs or one another, or cannot be written.
/// @throws droplet::Error InvalidArgument, OutputFailed
void checkFlowFiles(const FlowOptions& options);

/// The same for the files of all frames.
void checkFlowFrames(const FlowOptions& options, std::size_t frames);

/// Whether all files of a frame exist.
bool hasFlowFrame(const FlowOptions& options, std::size_t number);

/// Hash of the options and the files that decide what the frames show.
std::string flowFingerprint(const FlowOptions& options);

}  // namespace cli
