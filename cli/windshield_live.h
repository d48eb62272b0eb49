// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command_line.h"
#include "windshield_options.h"

namespace cli {

/// Refuses options that a page which runs by itself cannot have, and OUTPUT.
/// @throws droplet::Error InvalidArgument, naming the option
void checkLive(const CommandLine& line);

/// Writes the page of --live: the template of the build, with the values of the options.
/// @throws droplet::Error InvalidArgument: built without the page; InvalidInput, OutputFailed
void writeLive(const WindshieldOptions& options);

}  // namespace cli
