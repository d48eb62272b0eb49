// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common_options.h"
#include "droplet/body/droplet_body.h"
#include "droplet/flow/flow_parameters.h"
#include "droplet/flow_io/face_properties.h"
#include "droplet/flow_io/floor.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/flow_io/flow_presets.h"
#include "droplet/surface/material.h"
#include "numbered_path.h"
#include "preview.h"
#include "video_encoding.h"

namespace cli {

/// What the output of `droplet-shape flow` is.
enum class FlowOutput {
    Animation,  ///< animated .glb
    Meshes,     ///< a mesh of the droplets for every frame
    Pictures,   ///< a picture for every frame
    Picture,    ///< a picture of the last frame
    Video,
};

/// Options of `droplet-shape flow`. All values are in range; vectors are turned to z up; no file but the configuration
/// file has been read.
struct FlowOptions {
    std::optional<std::string> object;   ///< path; empty: the preset's
    std::optional<NumberedPath> shapes;  ///< set if the object deforms: a mesh for every frame
    std::string output;                  ///< path
    FlowOutput kind = FlowOutput::Animation;
    std::optional<NumberedPath> files;  ///< set if every frame gets a file
    droplet::AnimatedFile file;         ///< form of the animation, or of every mesh
    std::optional<droplet::FlowPreset> preset;
    droplet::ObjectOptions reading;
    std::optional<droplet::Floor> floor;   ///< below the object
    bool keeps_animation = true;           ///< the object moves as its file says
    std::optional<std::string> animation;  ///< of its file, by name
    std::optional<std::string> motion;     ///< path of keys
    droplet::FlowParameters parameters;    ///< without the content of files
    bool has_source = false;               ///< whether any source of droplets is given
    std::size_t drops = 0;
    droplet::VolumeDistribution volumes;
    std::optional<droplet::Vec3> from;
    std::optional<std::string> mask;
    std::optional<std::string> start;
    std::optional<std::string> roughness_map;
    std::optional<std::string> friction_map;
    std::map<std::string, droplet::MaterialProperties> materials;
    droplet::BodyShape shape = droplet::BodyShape::Capillary;
    double deformation = 0.0;  ///< SmallDeformation::amplitude
    std::optional<droplet::Material> material;
    PreviewOptions view;       ///< camera and size of pictures; file and turns of the preview
    bool has_preview = false;  ///< of the last frame, beside meshes
    VideoEncoding encoding;
    std::optional<NumberedPath> maps;
    bool are_maps_exr = false;  ///< otherwise PNG
    int map_width = 1024;
    double full_thickness = 5e-3;  ///< of white in PNG maps [m]
    double full_age = 10.0;        ///< of white in PNG maps [s]
    std::optional<std::string> streaks;
    std::optional<NumberedPath> streak_files;   ///< set if every frame gets a file of streaks
    std::optional<NumberedPath> point_files;    ///< set if `droplets` is a PLY for every frame
    std::optional<droplet::Format> usd_points;  ///< set if `droplets` is points over time
    std::optional<std::string> droplets;
    std::optional<std::string> json;
    std::optional<std::string> html;  ///< path or kStandardStream
    std::optional<double> duration;   ///< [s]; empty: the preset's, that of all shapes or of the animation, or 5 s
    double frames_per_second = 30.0;
    bool resume = false;
    std::string fingerprint;  ///< all options that decide what the frames show, as of optionsOfFrames()
    RunOptions run;
};

/// Reads the command line and the configuration file that it names.
/// @return                the options, or the text that --help or --version prints
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<FlowOptions, std::string> parseFlow(int argc, const char* const* argv);

}  // namespace cli
