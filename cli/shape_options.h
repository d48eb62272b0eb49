// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "droplet/io/output.h"
#include "droplet_options.h"
#include "preview.h"

namespace cli {

/// The main job as asked for: everything in range, nothing looked up on disk yet but the configuration file.
struct ShapeOptions {
    std::string input;                   ///< path or kStandardStream
    std::string output;                  ///< path or kStandardStream
    std::optional<std::string> json;     ///< path or kStandardStream
    std::optional<std::string> evolver;  ///< path or kStandardStream
    std::optional<PreviewOptions> preview;
    std::optional<std::string> html;  ///< path or kStandardStream
    droplet::Format format = droplet::Format::Glb;
    FootprintOptions footprint;
    DropletSettings settings;
    RunOptions run;
};

/// Reads the command line, and the configuration file it names.
/// @return                the job, or text for standard output if --help or --version asked for it
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<ShapeOptions, std::string> parseShape(int argc, const char* const* argv);

}  // namespace cli
