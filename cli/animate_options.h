// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "command_line.h"
#include "droplet/io/output.h"
#include "droplet/sequence/sequence.h"
#include "droplet_options.h"
#include "frames.h"
#include "numbered_path.h"
#include "preview.h"

namespace cli {

/// Options of `droplet-shape animate`. All values are in range; no file but the configuration file has been read.
struct AnimateOptions {
    std::vector<std::string> inputs;     ///< one or more, as given
    std::string output;                  ///< as given: path or kStandardStream
    std::optional<std::string> archive;  ///< path of the zip file that holds the frames
    std::optional<NumberedPath> files;   ///< set if every frame gets a file; with `archive`, below its path
    droplet::Format format = droplet::Format::Glb;
    droplet::Compression compression = droplet::Compression::None;
    std::optional<FootprintMotion> motion;  ///< of the one input
    std::size_t frames = 48;                ///< with `motion`
    droplet::VolumeMode volume_mode = droplet::VolumeMode::Total;
    std::optional<double> frames_per_second;
    std::optional<std::string> json;            ///< path or kStandardStream
    std::optional<std::string> contact_sheet;   ///< path or kStandardStream
    std::optional<PreviewOptions> preview;      ///< its path is that of a video or of preview_files
    std::optional<NumberedPath> preview_files;  ///< set if the preview is one picture per frame
    std::optional<std::string> html;            ///< path or kStandardStream
    bool resume = false;
    std::string fingerprint;  ///< all options that decide what the frames show, as of optionsOfFrames()
    FootprintOptions footprint;
    DropletSettings settings;
    RunOptions run;

    /// Whether every frame gets a file of its own on disk.
    [[nodiscard]] bool hasFiles() const { return files && !archive; }
    /// Whether the preview is a video.
    [[nodiscard]] bool hasVideo() const { return preview && !preview_files; }
};

/// Declares the options of an animation: all of `animate` but its files.
void declareAnimation(CommandLine& line, AnimateOptions& options);

/// Reads the options of declareAnimation() that CommandLine::read() does not read, but those of a video's encoding,
/// which the caller may have another use for.
/// @param options         those of declareAnimation(), with the paths of the frames and of the animation
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
void readAnimation(const CommandLine& line, AnimateOptions& options);

/// Reads the command line and the configuration file that it names.
/// @return                the options, or the text that --help or --version prints
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<AnimateOptions, std::string> parseAnimate(int argc, const char* const* argv);

}  // namespace cli
