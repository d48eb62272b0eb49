// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include "run_files.h"
#include "windshield_options.h"

namespace cli {

/// Names of the maps of the glass, as parts of their files' names.
inline constexpr std::array<const char*, 3> kMapNames{"normal", "thickness", "velocity"};

/// All files that a run reads and writes.
RunFiles filesOf(const WindshieldOptions& options);

/// Hash of everything that decides what the frames show: options and input files.
std::string fingerprintOf(const WindshieldOptions& options);

}  // namespace cli
