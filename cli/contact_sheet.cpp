// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_sheet.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <vector>

#include "droplet/io/read_surface.h"
#include "droplet/render/contact_sheet.h"
#include "droplet/render/render.h"
#include "droplet/surface/simplify.h"

namespace cli {
namespace {

/// Mean height: volume over the area seen from above. Files do not contain it; coloured liquids need it.
double meanHeight(const droplet::Surface& surface)
{
    double area = 0.0;
    for (const droplet::Triangle& t : surface.triangles) {
        const droplet::Vec3 a = surface.vertices[t[0]];
        area += 0.5 * std::max(0.0, cross(surface.vertices[t[1]] - a, surface.vertices[t[2]] - a).z);
    }
    return area > 0.0 ? std::abs(droplet::enclosedVolume(surface)) / area : 0.0;
}

/// Boxes of one size, each centred on its droplet and standing on the ground.
std::vector<droplet::ViewBox> boxesOfOneSize(const std::vector<std::string>& droplets)
{
    std::vector<droplet::ViewBox> boxes(droplets.size());
    tbb::parallel_for(std::size_t{0}, droplets.size(), [&](std::size_t i) {
        boxes[i] = droplet::around(droplet::readSurface(droplets[i]).surface).value();
    });
    droplet::Vec3 max;
    for (const auto& [low, high] : boxes) {
        max = {std::max(max.x, high.x - low.x), std::max(max.y, high.y - low.y), std::max(max.z, high.z - low.z)};
    }
    for (auto& [low, high] : boxes) {
        const droplet::Vec3 middle = 0.5 * (low + high);
        const droplet::Vec3 half = 0.5 * max;
        low = {middle.x - half.x, middle.y - half.y, low.z};
        high = {middle.x + half.x, middle.y + half.y, low.z + max.z};
    }
    return boxes;
}

}  // namespace

void writeContactSheet(const ContactSheet& sheet, const droplet::OutputOptions& options,
                       const std::function<void(std::size_t)>& drawn)
{
    const std::size_t count = sheet.droplets.size();
    if (count == 0) {
        return;
    }
    // The sheet has about as many pixels as a large screen, whatever the number of tiles.
    constexpr int kWidest = 320;
    constexpr int kNarrowest = 48;
    constexpr double kSheet = 3200.0;
    const int width = std::clamp(static_cast<int>(kSheet / std::sqrt(static_cast<double>(count))), kNarrowest, kWidest);
    const droplet::ContactSheetOptions layout{.tile_width = width, .tile_height = 3 * width / 4};
    const droplet::TileSize size = droplet::tileSize(count, layout);
    std::vector<droplet::ViewBox> boxes;
    if (sheet.one_scale) {
        boxes = boxesOfOneSize(sheet.droplets);
    }
    droplet::RenderOptions alike;
    if (sheet.object) {
        sheet.object->showIn(alike);
    }
    std::mutex mutex;
    std::size_t done = 0;
    std::vector<droplet::Tile> tiles(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        droplet::Surface surface = droplet::readSurface(sheet.droplets[i]).surface;
        if (sheet.object) {
            // The file begins with the object's triangles.
            const auto first =
                surface.triangles.begin() + static_cast<std::ptrdiff_t>(sheet.object->mesh.triangles.size());
            surface = droplet::withTriangles(surface, {first, surface.triangles.end()});
        }
        surface.mean_height = meanHeight(surface);
        droplet::RenderOptions render = alike;
        render.width = size.width;
        render.height = size.height;
        render.look = droplet::lookOf(sheet.material);
        if (!boxes.empty()) {
            render.framed = boxes[i];
        }
        tiles[i] = {droplet::render(surface, render), std::filesystem::path(sheet.droplets[i]).stem().string()};
        const std::lock_guard lock(mutex);
        drawn(++done);
    });
    const droplet::Picture picture = droplet::contactSheet(tiles, layout);
    droplet::writeAtomically(
        sheet.path, [&](std::ostream& out) { droplet::writePng(picture, out); }, options);
}

}  // namespace cli
