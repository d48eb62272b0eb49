// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_maps.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "common_options.h"
#include "droplet/units.h"
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

std::optional<std::string> seamWarning(const DropletMaps& maps, droplet::Vec2 extent)
{
    constexpr float kWhole = 0.97F;  // all but half a place of a pixel's 16: a rim that only touches the edge has less
    const auto width = static_cast<std::size_t>(maps.height.width);
    const auto height = static_cast<std::size_t>(maps.height.height);
    double depth = 0.0;
    // Number of lines that end in a cut droplet.
    // @param place  index of a pixel of a line, from an end inwards
    const auto cuts = [&](std::size_t lines, std::size_t pixels, const auto& place) {
        std::size_t cut = 0;
        for (std::size_t line = 0; line < lines; ++line) {
            bool is_cut = false;
            for (const bool from_end : {false, true}) {
                const auto at = [&](std::size_t k) { return place(line, from_end ? pixels - 1 - k : k); };
                if (maps.wetness.values[at(0)] < kWhole) {
                    continue;
                }
                is_cut = true;
                std::size_t top = 0;
                while (top + 1 < pixels && maps.height.values[at(top + 1)] > maps.height.values[at(top)]) {
                    ++top;
                }
                depth = std::max(depth, double{maps.height.values[at(top)]} - maps.height.values[at(0)]);
            }
            cut += is_cut ? 1 : 0;
        }
        return static_cast<double>(cut);
    };
    const double rows = cuts(height, width, [&](std::size_t row, std::size_t k) { return row * width + k; });
    const double columns = cuts(width, height, [&](std::size_t column, std::size_t k) { return k * width + column; });
    const double length =
        rows * extent.y / static_cast<double>(height) + columns * extent.x / static_cast<double>(width);
    if (length == 0.0) {
        return std::nullopt;
    }
    return fmt::format(
        "--map-tile: the picture's edge cuts droplets along {:.3g} mm, where they fall by up to {:.3g} mm: tiles show "
        "a seam there; keep liquid away from the edge, or draw the picture so that it ends between droplets",
        length / droplet::kMillimetre, depth / droplet::kMillimetre);
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
