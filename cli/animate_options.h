// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "droplet/io/output.h"
#include "droplet/sequence/sequence.h"
#include "droplet_options.h"
#include "numbered_path.h"
#include "preview.h"

namespace cli {

/// A sequence as asked for: everything in range, nothing looked up on disk yet but the configuration file.
struct AnimateOptions {
    std::vector<std::string> inputs;    ///< one or more, as given
    std::string output;                 ///< path or kStandardStream
    std::optional<NumberedPath> files;  ///< where every frame gets a file
    droplet::Format format = droplet::Format::Glb;
    droplet::VolumeMode volume_mode = droplet::VolumeMode::Total;
    std::optional<double> frames_per_second;
    std::optional<std::string> json;            ///< path or kStandardStream
    std::optional<std::string> contact_sheet;   ///< path or kStandardStream
    std::optional<PreviewOptions> preview;      ///< its path is a video's or that of preview_files
    std::optional<NumberedPath> preview_files;  ///< where the preview is a picture for every frame
    std::optional<std::string> html;            ///< path or kStandardStream
    FootprintOptions footprint;
    DropletSettings settings;
    RunOptions run;
};

/// Reads the command line, and the configuration file it names.
/// @return                the job, or text for standard output if --help or --version asked for it
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<AnimateOptions, std::string> parseAnimate(int argc, const char* const* argv);

}  // namespace cli
