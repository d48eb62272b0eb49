// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/footprint/mask.h"
#include "droplet/io/gltf.h"
#include "droplet/io/output.h"
#include "droplet/io/report.h"
#include "droplet/shape/figures.h"

namespace cli {

/// Stands for standard input or standard output in place of a path.
inline constexpr const char* kStandardStream = "-";

/// Indices of 32 bits and files of 4 GiB end at some hundred million triangles.
inline constexpr std::size_t kMostTriangles = 100'000'000;

enum class Verbosity { Quiet, Normal, Verbose };

enum class ProgressMode {
    Auto,  ///< a bar on a terminal once a run has taken a second
    None,
    Json,  ///< a line of JSON per stage, and no summary in words
};

/// The main job as asked for: everything in range, nothing looked up on disk yet but the configuration file.
struct ShapeOptions {
    std::string input;                   ///< path or kStandardStream
    std::string output;                  ///< path or kStandardStream
    std::optional<std::string> json;     ///< path or kStandardStream
    std::optional<std::string> evolver;  ///< path or kStandardStream
    std::optional<std::string> onto;     ///< path of the object that is wetted
    std::optional<std::string> config;   ///< the file options were taken from
    droplet::Format format = droplet::Format::Glb;
    droplet::Material material = droplet::Material::Water;
    droplet::MaskOptions mask;
    bool sized = false;               ///< whether the picture's size is given
    droplet::DropletOptions droplet;  ///< but for solve.ground
    droplet::GroundReport ground;
    std::optional<droplet::Hysteresis> hysteresis;
    droplet::OutputOptions files;
    std::optional<std::size_t> threads;
    Verbosity verbosity = Verbosity::Normal;
    ProgressMode progress = ProgressMode::Auto;
    std::vector<std::string> warnings;  ///< about options that have no effect together
};

/// Reads the command line, and the configuration file it names.
/// @return                the job, or text for standard output if --help or --version asked for it
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::variant<ShapeOptions, std::string> parseShape(int argc, const char* const* argv);

}  // namespace cli
