// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "windshield_options.h"

namespace cli {

inline constexpr std::array<const char*, 3> kMapNames{"normal", "thickness", "velocity"};

/// Where a map of a frame goes: `maps/00001-normal.png`.
std::string mapPath(const NumberedPath& maps, std::size_t number, const char* map);

std::string checkpointPath(const NumberedPath& files);

/// What is known to fail fails before any work is done.
/// @throws droplet::Error InvalidArgument, InvalidInput, OutputFailed
void checkWindshieldFiles(const WindshieldOptions& options);

/// Frames must not take the place of what is read or written otherwise, nor, if so asked for, of anything.
/// @param frames          how many there will be
/// @throws droplet::Error InvalidArgument, OutputFailed
void checkFrameFiles(const WindshieldOptions& options, std::size_t frames);

/// Whether all files of a frame stand.
bool hasFrame(const WindshieldOptions& options, std::size_t number);

/// What tells runs apart that would show something else: options and what is in the files they name.
std::string fingerprintOf(const WindshieldOptions& options);

}  // namespace cli
