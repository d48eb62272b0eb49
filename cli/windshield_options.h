// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <variant>

#include "common_options.h"
#include "droplet/wind_io/windshield_animation.h"
#include "droplet/windshield/windshield.h"
#include "droplet/windshield_view/glass_maps.h"
#include "droplet/windshield_view/view.h"
#include "numbered_path.h"
#include "video_encoding.h"

namespace cli {

/// The page of --live.
struct LivePage {
    std::string path;             ///< or kStandardStream
    std::set<std::string> given;  ///< options that are given; the page has defaults of its own for some others
};

/// Options of `droplet-shape windshield`. All values are in range; no file but the configuration file has been read.
struct WindshieldOptions {
    std::string output;  ///< path; empty with `live`
    std::optional<LivePage> live;
    std::optional<NumberedPath> files;  ///< set if every frame gets a file
    bool is_video = false;              ///< if neither this nor files is set, the output is the last frame
    std::string preset = "figure-3.12";
    droplet::WindshieldParameters parameters;  ///< without the content of files
    droplet::Glass::Cylinder cylinder;
    std::optional<std::string> surface;
    std::optional<std::string> drive_cycle;
    std::optional<double> wiper;  ///< period [s]
    droplet::ViewOptions view;    ///< without the frame's size, unless `sized`
    bool sized = false;           ///< whether --frame-size is given
    std::optional<std::string> background;
    std::optional<std::string> environment;
    bool fit = false;  ///< scale and crop the background
    bool layer = false;
    VideoEncoding encoding;
    std::optional<NumberedPath> maps;
    bool are_maps_exr = false;  ///< otherwise PNG
    droplet::GlassMapOptions map;
    std::optional<double> duration;  ///< [s]
    double warm_up = 10.0;           ///< [s]
    double frames_per_second = 30.0;
    std::optional<std::string> droplets;
    bool moving_only = false;  ///< leave droplets at rest out of the table
    std::optional<std::string> model;
    droplet::AnimatedFile model_file;  ///< form of the model
    droplet::AnimationMethod model_animation = droplet::AnimationMethod::Nodes;
    std::optional<std::string> json;  ///< path or kStandardStream
    bool resume = false;
    std::string fingerprint;  ///< all options that decide what the frames show, as of optionsOfFrames()
    RunOptions run;
};

/// Reads the command line and the configuration file that it names.
/// @return                the options, or the text that --help or --version prints
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<WindshieldOptions, std::string> parseWindshield(int argc, const char* const* argv);

}  // namespace cli
