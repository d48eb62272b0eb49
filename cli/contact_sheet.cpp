// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_sheet.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "droplet/io/read_surface.h"
#include "droplet/picture/contact_sheet.h"
#include "droplet/picture/render.h"

namespace cli {
namespace {

/// Volume over the area that is covered seen from above, which files do not hold: how deep coloured liquid is.
double meanHeight(const droplet::Surface& surface)
{
    double area = 0.0;
    for (const droplet::Triangle& t : surface.triangles) {
        const droplet::Vec3 a = surface.positions[t[0]];
        area += 0.5 * std::max(0.0, cross(surface.positions[t[1]] - a, surface.positions[t[2]] - a).z);
    }
    return area > 0.0 ? std::abs(droplet::enclosedVolume(surface)) / area : 0.0;
}

}  // namespace

void writeContactSheet(const ContactSheet& sheet, const droplet::OutputOptions& options)
{
    if (sheet.droplets.empty()) {
        return;
    }
    // About as many pixels on the sheet, however many share them.
    constexpr int kWidest = 320;
    constexpr int kNarrowest = 48;
    constexpr double kSheet = 7200.0;
    const int width = std::clamp(static_cast<int>(kSheet / std::sqrt(static_cast<double>(sheet.droplets.size()))),
                                 kNarrowest, kWidest);
    const droplet::ContactSheetOptions layout{.tile_width = width, .tile_height = 3 * width / 4};
    std::vector<droplet::Tile> tiles(sheet.droplets.size());
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
        droplet::Surface surface = droplet::readSurface(sheet.droplets[i]).surface;
        surface.mean_height = meanHeight(surface);
        droplet::RenderOptions render;
        render.width = layout.tile_width;
        render.height = layout.tile_height;
        render.look = droplet::lookOf(sheet.material);
        tiles[i] = {droplet::render(surface, render), std::filesystem::path(sheet.droplets[i]).stem().string()};
    });
    const droplet::Picture picture = droplet::contactSheet(tiles, layout);
    droplet::writeWhole(
        sheet.path, [&](std::ostream& out) { droplet::writePng(picture, out); }, options);
}

}  // namespace cli
