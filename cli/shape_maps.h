// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "droplet/render/droplet_maps.h"
#include "files.h"

namespace cli {

/// Names of the maps of droplets, in the order of droplet::DropletMaps.
inline constexpr std::array kShapeMaps{"height", "normal", "thickness", "coverage", "wetness", "occlusion"};

/// Maps that are written beside droplets.
struct ShapeMapOptions {
    std::string path;     ///< as given; the files' names have the maps' before the ending
    bool is_exr = false;  ///< otherwise PNG
    int width = 1024;     ///< [px]
    bool is_tile = false;
    std::optional<double> full_thickness = {};  ///< whiteOf(); empty: of the maps
};

/// Declares --maps and the options that belong to it.
/// @param options  receives their values
void declareShapeMaps(CommandLine& line, ShapeMapOptions& options);

/// Reads --maps, if it is given.
/// @param declared         of declareShapeMaps
/// @throws droplet::Error InvalidArgument
std::optional<ShapeMapOptions> readShapeMaps(const CommandLine& line, const ShapeMapOptions& declared);

/// Paths of all maps.
std::vector<std::string> mapPaths(const ShapeMapOptions& options);

/// Thickness that is white in PNGs of maps, and height above the lowest place [m]; nothing for OpenEXR.
std::optional<double> whiteOf(const droplet::DropletMaps& maps, const ShapeMapOptions& options);

/// Warning about droplets that the edge of a tile cuts: they fall to the ground there, and the tiles show a seam.
/// Nothing if there are none.
/// @param extent  of the picture [m]
std::optional<std::string> seamWarning(const droplet::DropletMaps& maps, droplet::Vec2 extent);

/// Files of maps.
/// @param white  whiteOf()
std::vector<OutputFile> mapFiles(const std::shared_ptr<const droplet::DropletMaps>& maps,
                                 const ShapeMapOptions& options, std::optional<double> white);

}  // namespace cli
