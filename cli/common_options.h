// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "command_line.h"

namespace cli {

/// --threads, --quiet, --config, --help and --version.
/// @param example  a line of such a configuration file
void declareCommon(CommandLine& line, const char* group, const std::string& example);

/// What --help or --version asks for.
std::optional<std::string> textAskedFor(const CommandLine& line);

/// --threads; empty: all cores.
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::optional<std::size_t> readThreads(const CommandLine& line);

}  // namespace cli
