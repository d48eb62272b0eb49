// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "command_line.h"
#include "droplet/liquid.h"
#include "option_values.h"

namespace cli {

/// Declares --liquid, --surface-tension and --density.
/// @param group    heading in the help
/// @param density  its range
void declareLiquidProperties(CommandLine& line, const char* group, const Range& density);

/// Reads what declareLiquidProperties() declares. A liquid with a property of its own, but no name, is `custom`.
/// @param liquid  in and out: the command's default
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
void readLiquidProperties(const CommandLine& line, const Range& density, droplet::Liquid& liquid);

/// Declares --material, whose words are the names of all materials.
/// @param text  description
void declareMaterial(CommandLine& line, const char* group, const std::string& text);

}  // namespace cli
