// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include "common_options.h"
#include "droplet/expression/expression.h"
#include "droplet/liquid2d/fluid.h"
#include "droplet/liquid2d_io/liquid_drawing.h"
#include "droplet/liquid2d_io/particle_file.h"
#include "numbered_path.h"
#include "video_encoding.h"

namespace cli {

/// What the output of `droplet-shape liquid2d` is.
enum class LiquidOutput {
    None,      ///< masks or particles alone
    Drawings,  ///< an .svg or .png for every frame
    Drawing,   ///< an .svg or .png of the last frame
    Video,
    Lottie,  ///< a .json with all frames
};

/// Options of `droplet-shape liquid2d`. All values are in range; no file but the configuration file has been read.
struct Liquid2dOptions {
    std::optional<std::string> output;  ///< path
    LiquidOutput kind = LiquidOutput::None;
    std::optional<NumberedPath> files;        ///< set if every frame gets a drawing
    std::optional<std::string> masks;         ///< path or kStandardStream
    std::optional<NumberedPath> mask_files;   ///< set unless masks go to standard output
    std::optional<NumberedPath> cache_files;  ///< particles of every frame
    std::optional<std::string> cache_file;    ///< path of particles over time
    std::string scene = "splash";             ///< name of a preset, or path of a file
    std::optional<std::size_t> particle_count;
    std::optional<std::string> walls;       ///< path of a mask
    std::optional<double> gravity;          ///< [m/s²]
    std::optional<double> surface_tension;  ///< [N/m]
    droplet::PressureSolver solver = droplet::FluidOptions{}.solver;
    std::optional<std::string> particles;        ///< path or pattern of another simulation instead of a scene
    std::optional<NumberedPath> particle_files;  ///< set if `particles` is a pattern
    droplet::ParticleFileOptions particle_reading;
    std::string style = "cartoon";        ///< by default the preset's
    droplet::ExpressionOptions controls;  ///< of the style, with changes
    droplet::LiquidLook look;
    int width = 1280;  ///< of drawings and masks [px]
    VideoEncoding encoding;
    std::optional<double> duration;  ///< [s]; empty: the preset's, or 4 s
    std::optional<double> begin;     ///< time of the simulation that the first frame shows [s]; empty: 0, or `loop`
    double loop = 0.0;               ///< time in which the end fades to what was before the beginning [s]
    double frames_per_second = 24.0;
    int hold = 1;  ///< frames that a drawing stays
    std::optional<std::string> json;
    bool resume = false;
    std::string fingerprint;  ///< all options that decide what the frames show, as of optionsOfFrames()
    RunOptions run;
};

/// Reads the command line and the configuration file that it names.
/// @return                the options, or the text that --help or --version prints
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<Liquid2dOptions, std::string> parseLiquid2d(int argc, const char* const* argv);

}  // namespace cli
