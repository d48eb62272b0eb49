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

void declareHtml(CommandLine& line);

/// The page to be written.
/// @throws droplet::Error InvalidArgument if it is not built in
std::optional<std::string> readHtml(const CommandLine& line);

/// What every command takes that makes droplets: liquid, ground and surface, --format and --fill-range.
void declareDroplets(CommandLine& line);

/// Reads those and the run's options.
/// @param options         with the names of all files that are read and written, or how they are made
/// @param subject         how messages call the output
/// @throws droplet::Error InvalidArgument
ShapeOptions readDroplets(const CommandLine& line, ShapeOptions options, const std::string& subject);

/// What every command takes that makes droplets from pictures: the footprint, too.
void declareShapes(CommandLine& line);

/// Reads those and the run's options, as readDroplets does.
ShapeOptions readShapes(const CommandLine& line, ShapeOptions options, const std::string& subject);

/// Reads the command line, and the configuration file it names.
/// @return                the job, or text for standard output if --help or --version asked for it
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<ShapeOptions, std::string> parseShape(int argc, const char* const* argv);

}  // namespace cli
