// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "common_options.h"
#include "droplet/droplet.h"
#include "droplet/io/gltf.h"
#include "droplet/io/object.h"
#include "droplet/io/output.h"
#include "droplet/io/report.h"
#include "droplet/mask/mask.h"
#include "droplet/shape/figures.h"
#include "materials_file.h"

namespace cli {

/// Limit of triangles: indices of 32 bits and files of 4 GiB hold about a hundred million.
inline constexpr std::size_t kMaxTriangles = 100'000'000;

/// Units of quantities, for the end of help texts.
inline constexpr const char* kUnitsText =
    "Quantities carry a unit:\n"
    "  lengths nm um mm cm m in; areas um2 mm2 cm2 m2; angles deg rad;\n"
    "  volumes nL uL mL L mm3 cm3 m3;\n"
    "  surface tension mN/m N/m dyn/cm; density kg/m3 g/cm3 g/mL;\n"
    "  acceleration m/s2 mm/s2 g\n";

/// Options of droplets by colour.
struct ByColourOptions {
    std::optional<std::size_t> colours = {};  ///< number of colours; empty: as many as stand out
    double gap = 0.0;                         ///< between neighbours [m]
};

/// Options from the picture to the outline.
struct FootprintOptions {
    std::optional<ByColourOptions> by_colour;  ///< replaces the decisions of `mask` but its channel and limits
    droplet::MaskOptions mask;
    droplet::TraceOptions trace;
    bool sized = false;                   ///< whether --width or --pixel-size is given
    std::optional<std::string> seeds;     ///< path of strokes on the picture
    std::optional<std::string> mask_out;  ///< path for the used mask, or kStandardStream
};

/// Options from the outline to the droplets, and their look.
struct DropletSettings {
    droplet::DropletOptions droplet;  ///< all but trace and solve.ground
    droplet::GroundReport ground;
    std::optional<std::string> onto;  ///< path of the wetted object
    droplet::ObjectOptions reading;   ///< of this object
    bool with_object = false;         ///< whether files have this object, too: see hasObject()
    bool page_has_object = false;     ///< whether the page of --html has it
    std::optional<droplet::Hysteresis> hysteresis;
    droplet::Material material = droplet::Material::Water;
    std::optional<Materials> materials;  ///< of single droplets, over `material`
    droplet::Nodes nodes = droplet::Nodes::One;
    double sink = 0.0;                                           ///< of the droplet in its file, below the ground [m]
    std::optional<double> base;                                  ///< thickness of the plate below all droplets [m]
    std::vector<std::size_t> levels;                             ///< triangles of the levels of detail but the first
    bool weld = false;                                           ///< one vertex for each place, in glTF
    bool colour_map = false;                                     ///< the picture tints the liquid
    droplet::LengthUnit unit = droplet::LengthUnit::Millimetre;  ///< unit in OBJ and STL
    std::vector<std::string> warnings;                           ///< options without effect
};

// Each command declares its groups of options in the order of its help, with the structs that CommandLine::read() fills
// after parsing; then it reads the rest.

void declareFootprint(CommandLine& line, FootprintOptions& options);
/// Declares --by-colour, --colours and --gap.
void declareByColour(CommandLine& line);
/// Declares --gap.
void declareGap(CommandLine& line, const char* group);
/// Declares --seeds.
void declareSeeds(CommandLine& line, FootprintOptions& options);
/// Declares --mask-out.
void declareMaskOut(CommandLine& line);
void declareLiquid(CommandLine& line, DropletSettings& settings);
void declareGround(CommandLine& line, DropletSettings& settings);
void declareSurface(CommandLine& line, DropletSettings& settings);
void declareRun(CommandLine& line);

// All read functions throw droplet::Error InvalidArgument, naming option, value and what is allowed.

void readFootprint(const CommandLine& line, FootprintOptions& options);
/// Reads --by-colour and the options that go with it, as far as the command has them; nothing without --by-colour.
/// @param warnings  receives warnings about options without effect
std::optional<ByColourOptions> readByColour(const CommandLine& line, std::vector<std::string>& warnings);
/// Reads the options of liquid, ground and surface.
void readDroplet(const CommandLine& line, DropletSettings& settings);

/// Adds warnings about options that have no effect on a format.
/// @param is_shown  whether another output, such as a preview, shows the material
void warnOfFormat(const CommandLine& line, droplet::Format format, bool is_shown, DropletSettings& settings);

}  // namespace cli
