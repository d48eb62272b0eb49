// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "animate_options.h"
#include "droplet/liquid2d_io/liquid_drawing.h"
#include "numbered_path.h"
#include "video_encoding.h"

namespace cli {

/// What the output of `droplet-shape morph` is.
enum class MorphOutput {
    Model,       ///< droplets, as `animate` makes them
    Masks,       ///< a .png for every frame
    MaskStream,  ///< .png files on standard output
    Drawings,    ///< an .svg for every frame
    Video,
};

/// Options of `droplet-shape morph`. All values are in range; no file but the configuration file has been read.
struct MorphCommandOptions {
    std::vector<std::string> inputs;  ///< pictures, in order
    std::optional<std::string> text;  ///< footprint before those of the pictures
    std::string font = "sans-serif";  ///< family of the text
    std::string output;               ///< path or kStandardStream
    MorphOutput kind = MorphOutput::Model;
    std::optional<NumberedPath> files;  ///< set if every frame gets a mask or drawing
    std::size_t frames = 120;
    std::size_t particles = 12000;
    double rounding = 1.0;
    std::optional<int> width;  ///< of masks and drawings [px]; empty: that of the first picture
    droplet::LiquidLook look;
    VideoEncoding encoding;
    AnimateOptions animation;  ///< footprint options for pictures; with Model, all the rest for the droplets
};

/// Reads the command line and the configuration file that it names.
/// @return                the options, or the text that --help or --version prints
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<MorphCommandOptions, std::string> parseMorph(int argc, const char* const* argv);

}  // namespace cli
