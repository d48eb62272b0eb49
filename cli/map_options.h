// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "command_line.h"

namespace cli {

/// Reads the kind of --maps' files by their ending, and checks the options that belong to it, --map-thickness among
/// them.
/// @param belonging        options that need --maps
/// @param allowed          in words, what a path is
/// @return                 whether they are OpenEXR, not PNG; false without --maps
/// @throws droplet::Error InvalidArgument
bool areMapsExr(const CommandLine& line, const std::vector<const char*>& belonging, const char* allowed);

}  // namespace cli
