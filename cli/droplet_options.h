// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "droplet/droplet.h"
#include "droplet/footprint/mask.h"
#include "droplet/io/gltf.h"
#include "droplet/io/output.h"
#include "droplet/io/report.h"
#include "droplet/shape/figures.h"

namespace cli {

/// Indices of 32 bits and files of 4 GiB end at some hundred million triangles.
inline constexpr std::size_t kMaxTriangles = 100'000'000;

/// What the help says of units, for footers.
inline constexpr const char* kUnitsText =
    "Quantities carry a unit:\n"
    "  lengths nm um mm cm m in; areas um2 mm2 cm2 m2; angles deg rad;\n"
    "  volumes nL uL mL L mm3 cm3 m3;\n"
    "  surface tension mN/m N/m dyn/cm; density kg/m3 g/cm3 g/mL;\n"
    "  acceleration m/s2 mm/s2 g\n";

/// How a picture becomes an outline.
struct FootprintOptions {
    droplet::MaskOptions mask;
    droplet::TraceOptions trace;
    bool sized = false;                   ///< whether the picture's size is given
    std::optional<std::string> mask_out;  ///< path of the mask that was used, or kStandardStream
};

/// How an outline becomes droplets, and how they look.
struct DropletSettings {
    droplet::DropletOptions droplet;  ///< but for trace and solve.ground
    droplet::GroundReport ground;
    std::optional<std::string> onto;  ///< path of the object that is wetted
    std::optional<droplet::Hysteresis> hysteresis;
    droplet::Material material = droplet::Material::Water;
    droplet::LengthUnit unit = droplet::LengthUnit::Millimetre;  ///< of OBJ and STL
    std::vector<std::string> warnings;                           ///< about options that have no effect together
};

enum class Verbosity { Quiet, Normal, Verbose };

enum class ProgressMode {
    Auto,  ///< a bar on a terminal once a run has taken a second
    None,
    Json,  ///< a line of JSON per stage, and no summary in words
};

/// How a command goes about its work, whatever that is.
struct RunOptions {
    std::optional<std::string> config;  ///< the file options were taken from
    droplet::OutputOptions files;
    std::optional<std::size_t> threads;
    Verbosity verbosity = Verbosity::Normal;
    ProgressMode progress = ProgressMode::Auto;
};

// Each command declares the groups it takes, in the order of its help, and reads them once the line is parsed.

void declareFootprint(CommandLine& line);
/// Of the commands that make one droplet, beside declareFootprint.
void declareMaskOut(CommandLine& line);
void declareLiquid(CommandLine& line);
void declareGround(CommandLine& line);
void declareSurface(CommandLine& line);
void declareRun(CommandLine& line);

// All throw droplet::Error InvalidArgument, naming option, value and what is allowed.

/// Whether a value of --colour is one of --preview-colour, which had that name before.
bool isPreviewColour(const std::string& text);

FootprintOptions readFootprint(const CommandLine& line);
/// Liquid, ground and surface.
DropletSettings readDroplet(const CommandLine& line);
RunOptions readRun(const CommandLine& line);

/// Adds warnings of options that a format has no use for.
/// @param is_shown  whether there is something beside the file that shows the material
void warnOfFormat(const CommandLine& line, droplet::Format format, bool is_shown, DropletSettings& settings);

}  // namespace cli
