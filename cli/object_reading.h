// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "command_line.h"
#include "droplet/io/object.h"

namespace cli {

/// Declares --scale, --object-size and --up of a command that reads an object.
/// @param when  words before their help, such as `With --onto: `
void declareReading(CommandLine& line, const char* group, droplet::ObjectOptions& reading,
                    const std::string& when = "");

}  // namespace cli
