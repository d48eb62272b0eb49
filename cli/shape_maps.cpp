// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "common_options.h"
#include "map_options.h"
#include "surface_files.h"

namespace cli {
namespace {

using droplet::DropletMaps;
using droplet::FloatPicture;

std::array<const FloatPicture*, kShapeMaps.size()> all(const DropletMaps& maps)
{
    return {&maps.height, &maps.normal, &maps.thickness, &maps.coverage, &maps.wetness, &maps.occlusion};
}

/// Levels of values from `black` to `white`.
droplet::DeepPicture deep(const FloatPicture& map, double black, double white)
{
    droplet::DeepPicture picture{map.width, map.height, map.channels, {}};
    picture.levels.reserve(map.values.size());
    for (const float value : map.values) {
        const double share = std::clamp((value - black) / (white - black), 0.0, 1.0);
        picture.levels.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * share)));
    }
    return picture;
}

/// Height of the lowest place, which is black in a PNG [m].
double lowestOf(const DropletMaps& maps)
{
    return *std::min_element(maps.height.values.begin(), maps.height.values.end());
}

}  // namespace

void declareShapeMaps(CommandLine& line, ShapeMapOptions& options)
{
    constexpr const char* kGroup = "Maps";
    line.add(
        kGroup, "--maps", "PATH",
        "Textures of the droplets from straight above, for decals and displacement, such as maps/logo.png or .exr: "
        "six files, -height, -normal, -thickness, -coverage, -wetness and -occlusion");
    line.add(kGroup, "--map-width", "N", "Width of the textures in pixels", into(options.width, {16, 8192, "8192"}));
    line.add(kGroup, "--map-thickness", "LENGTH",
             "Thickness that is white in a PNG, and height above the lowest place [the greatest of both]",
             into(options.full_thickness, kMapThickness));
    line.addFlag(kGroup, "--map-tile", "Textures that repeat: what leans out over an edge comes in at the opposite one",
                 options.is_tile);
    line.exclude({"--maps", "--onto"});
}

std::optional<ShapeMapOptions> readShapeMaps(const CommandLine& line, const ShapeMapOptions& declared)
{
    ShapeMapOptions options = declared;
    options.is_exr =
        areMapsExr(line, {"--map-width", "--map-thickness", "--map-tile"}, "a path that ends in .png or .exr");
    if (const auto maps = line.value("--maps")) {
        options.path = maps->text;
        return options;
    }
    return std::nullopt;
}

std::vector<std::string> mapPaths(const ShapeMapOptions& options)
{
    std::vector<std::string> paths;
    paths.reserve(kShapeMaps.size());
    for (const char* const map : kShapeMaps) {
        paths.push_back(pathBeside(options.path, map));
    }
    return paths;
}

std::optional<double> whiteOf(const DropletMaps& maps, const ShapeMapOptions& options)
{
    if (options.is_exr) {
        return std::nullopt;
    }
    if (options.full_thickness) {
        return options.full_thickness;
    }
    const std::vector<float>& heights = maps.height.values;
    const std::vector<float>& thickness = maps.thickness.values;
    const double most = std::max<double>(*std::max_element(heights.begin(), heights.end()) - lowestOf(maps),
                                         *std::max_element(thickness.begin(), thickness.end()));
    return most > 0.0 ? most : 1.0;  // the window may be beside the droplets
}

std::vector<OutputFile> mapFiles(const std::shared_ptr<const DropletMaps>& maps, const ShapeMapOptions& options,
                                 std::optional<double> white)
{
    const std::vector<std::string> paths = mapPaths(options);
    std::vector<OutputFile> files;
    for (std::size_t k = 0; k < paths.size(); ++k) {
        files.push_back(
            {paths[k], [maps, white, k](std::ostream& out) {
                 const FloatPicture& map = *all(*maps)[k];
                 if (!white) {
                     writeExr(map, out);
                     return;
                 }
                 const bool is_length = &map == &maps->height || &map == &maps->thickness;
                 const double black = &map == &maps->normal ? -1.0 : &map == &maps->height ? lowestOf(*maps) : 0.0;
                 writePng(deep(map, black, is_length ? black + *white : 1.0), out);
             }});
    }
    return files;
}

}  // namespace cli
