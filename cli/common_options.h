// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "command_line.h"
#include "droplet/scene/format.h"

namespace cli {

/// Declares --threads, --quiet, --config, --help and --version.
/// @param example  line of a configuration file, for the help
void declareCommon(CommandLine& line, const char* group, const std::string& example);

/// Declares --progress of a command that makes frames; readProgress() reads it.
void declareFrameProgress(CommandLine& line, const char* group);

/// Declares --compress; readCompression() reads it.
void declareCompression(CommandLine& line, const char* group);

/// Compression of a file; Compression::None if --compress is not given.
/// @param format          of the file
/// @throws droplet::Error InvalidArgument, naming the option and what is allowed
droplet::Compression readCompression(const CommandLine& line, droplet::Format format);

/// Text that --help or --version prints, if one of them is given.
std::optional<std::string> requestedText(const CommandLine& line);

/// Value of --threads; empty for all cores.
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::optional<std::size_t> readThreads(const CommandLine& line);

}  // namespace cli
