// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_sheet.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <mutex>
#include <vector>

#include "droplet/io/read_surface.h"
#include "droplet/render/contact_sheet.h"
#include "droplet/render/render.h"

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

/// The droplets of a file that begins with the triangles of the object that they lie on.
/// @param count  of these triangles
droplet::Surface withoutFirst(const droplet::Surface& all, std::size_t count)
{
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    droplet::Surface droplets;
    droplets.triangles.assign(all.triangles.begin() + static_cast<std::ptrdiff_t>(count), all.triangles.end());
    std::vector<bool> is_kept(all.vertices.size(), false);
    for (const droplet::Triangle& triangle : droplets.triangles) {
        for (const std::uint32_t v : triangle) {
            is_kept[v] = true;
        }
    }
    std::vector<std::uint32_t> number(all.vertices.size(), kNone);
    std::vector<std::uint32_t> first(all.vertices.size(), kNone);  // of those that are kept, at the place of a vertex
    droplets.weld.reserve(all.vertices.size());
    for (std::size_t v = 0; v < all.vertices.size(); ++v) {
        if (is_kept[v]) {
            number[v] = static_cast<std::uint32_t>(droplets.vertices.size());
            droplets.vertices.push_back(all.vertices[v]);
            droplets.normals.push_back(all.normals[v]);
            droplets.uvs.push_back(all.uvs[v]);
            std::uint32_t& place = first[all.weld[v]];
            place = place == kNone ? number[v] : place;
            droplets.weld.push_back(place);
        }
    }
    for (droplet::Triangle& triangle : droplets.triangles) {
        triangle = {number[triangle[0]], number[triangle[1]], number[triangle[2]]};
    }
    return droplets;
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
            surface = withoutFirst(surface, sheet.object->mesh.triangles.size());
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
