// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command_line.h"
#include "run_command.h"
#include "run_files.h"
#include "windshield_options.h"

namespace cli {

/// Refuses options that a page which runs by itself cannot have, and OUTPUT.
/// @throws droplet::Error InvalidArgument, naming the option
void checkLive(const CommandLine& line);

/// Files that the page of --live is made of, and the page.
RunFiles filesOfLive(const WindshieldOptions& options);

/// Writes the page of --live: the template of the build, with the values of the options.
/// @throws droplet::Error InvalidArgument: built without the page; InvalidInput, OutputFailed
RunEnd writeLive(const WindshieldOptions& options);

}  // namespace cli
