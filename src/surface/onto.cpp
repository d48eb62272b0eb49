// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/surface/onto.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "blocks.h"
#include "droplet/error.h"
#include "number_text.h"
#include "surface/atlas.h"
#include "surface/place_droplets.h"

namespace droplet {
namespace {

std::string rounded(double value)
{
    return numberText(value, 3);
}

std::string counted(std::size_t count, const std::string& one)
{
    return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

void addWarnings(OntoReport& report)
{
    const auto left_out = [&](std::size_t count, const std::string& why) {
        if (count > 0) {
            report.warnings.push_back(counted(count, "droplet") + " left out: " + why);
        }
    };
    left_out(report.outside, "not completely on a chart of the object's uv");
    left_out(report.across, "across a seam between charts of the object's uv");
    left_out(report.folded, "too high for the hollow of the object below");
    left_out(report.cut_out, "over a place that the alpha of the object's texture cuts out");
    if (report.mirrored > 0) {
        report.warnings.push_back(counted(report.mirrored, "droplet") + " mirrored, on " +
                                  counted(report.flipped_charts, "flipped chart") + " of the object's uv");
    }
    if (report.overlapping_charts > 0) {
        report.warnings.push_back(
            counted(report.overlapping_charts, "chart") +
            " of the object's uv overlap others with droplets, which are on the first one in the file");
    }
    constexpr double kNoticeable = 1.5;
    if (report.max_scale > kNoticeable || report.min_scale < 1.0 / kNoticeable) {
        report.warnings.push_back(
            "the object is " + rounded(report.min_scale) + " to " + rounded(report.max_scale) +
            " times as large as the picture; gravity was computed for the size of the picture. The command "
            "dew covers an object with round droplets, and needs no uv");
    }
}

void requireAnyPlaced(const OntoReport& report, std::size_t count)
{
    if (report.laid == 0) {
        throw Error(ErrorCode::NoSuchDroplet,
                    "none of " + counted(count, "droplet") +
                        " can be placed on the object: " + std::to_string(report.outside) +
                        " not completely on a chart of its uv, " + std::to_string(report.across) + " across a seam, " +
                        std::to_string(report.folded) + " too high for a hollow, " + std::to_string(report.cut_out) +
                        " over a place that the alpha of its texture cuts out");
    }
}

/// Counts charts with vertices of droplets on other charts, flipped charts with droplets, and results.
void countCharts(const Atlas& atlas, const Hits& hits, const DropletNumbers& droplets,
                 const std::vector<DropletPlacement>& placements, OntoReport& report)
{
    std::vector<bool> overlapping(atlas.facing.size(), false);
    std::vector<bool> flipped(atlas.facing.size(), false);
    for (const Hit& hit : hits.all) {
        const std::uint32_t own = droplets.of[hit.vertex];
        const bool is_placed = own != DropletNumbers::kNone && placements[own].result == PlacementResult::Placed;
        if (is_placed && placements[own].chart != hit.chart && hit.depth > atlas.tolerance) {
            overlapping[hit.chart] = true;
        }
    }
    for (const DropletPlacement& placement : placements) {
        switch (placement.result) {
            case PlacementResult::Placed:
                ++report.laid;
                if (atlas.facing[placement.chart] < 0.0) {
                    ++report.mirrored;
                    flipped[placement.chart] = true;
                }
                break;
            case PlacementResult::Outside:
                ++report.outside;
                break;
            case PlacementResult::Across:
                ++report.across;
                break;
            case PlacementResult::Folded:
                ++report.folded;
                break;
            case PlacementResult::CutOut:
                ++report.cut_out;
                break;
        }
    }
    report.overlapping_charts = static_cast<std::size_t>(std::count(overlapping.begin(), overlapping.end(), true));
    report.flipped_charts = static_cast<std::size_t>(std::count(flipped.begin(), flipped.end(), true));
}

/// Volume of liquid and wet area, both on the object.
struct Extent {
    double volume = 0.0;
    double area = 0.0;

    [[nodiscard]] double meanHeight() const { return area > 0.0 ? std::max(0.0, volume / area) : 0.0; }
};

/// Extent of the triangles from `first` to before `end`.
Extent extentOf(const Surface& droplets, const std::vector<PlacedVertex>& placed, const std::vector<bool>& kept,
                std::size_t first, std::size_t end)
{
    double volume = 0.0;
    double area = 0.0;
    for (std::size_t i = first; i < end; ++i) {
        const auto& [a, b, c] = droplets.triangles[i];
        const Vec3 p = droplets.vertices[a];
        const Vec3 q = droplets.vertices[b] - p;
        const Vec3 r = droplets.vertices[c] - p;
        const double flat = cross(Vec2{q.x, q.y}, Vec2{r.x, r.y});
        // The liquid's triangles; those that lean out have a negative area in the plane.
        if (kept[a] && cross(droplets.uvs[c] - droplets.uvs[a], droplets.uvs[b] - droplets.uvs[a]) > 0.0) {
            const double s = (placed[a].scale + placed[b].scale + placed[c].scale) / 3.0;
            const double z = (p.z + droplets.vertices[b].z + droplets.vertices[c].z) / 3.0;
            volume += flat * s * s * s * z;
            area += flat * s * s;
        }
    }
    return {volume, area};
}

/// Droplets with a part on the object.
std::vector<SurfacePart> partsOf(const Surface& droplets, const std::vector<PlacedVertex>& placed,
                                 const std::vector<bool>& kept)
{
    std::vector<SurfacePart> parts;
    SurfacePart next;
    for (const SurfacePart& part : droplets.parts) {
        next.droplet = part.droplet;
        next.vertices = 0;
        next.triangles = 0;
        std::size_t halves = 0;
        for (std::size_t v = part.first_vertex; v < part.first_vertex + part.vertices; ++v) {
            next.vertices += kept[v] ? 1 : 0;
        }
        const std::size_t end = part.first_triangle + part.triangles;
        for (std::size_t t = part.first_triangle; t < end; ++t) {
            const std::size_t count = kept[droplets.triangles[t][0]] ? 1 : 0;
            next.triangles += count;
            halves += t < part.first_triangle + 2 * part.quads ? count : 0;
        }
        next.quads = halves / 2;
        if (next.triangles > 0) {
            const Extent extent = extentOf(droplets, placed, kept, part.first_triangle, end);
            next.volume = std::max(0.0, extent.volume);
            next.area = extent.area;
            parts.push_back(next);
        }
        next.first_vertex += next.vertices;
        next.first_triangle += next.triangles;
    }
    return parts;
}

}  // namespace

void OntoOptions::validate() const
{
    if (!(extent.x > 0.0 && extent.y > 0.0 && std::isfinite(extent.x) && std::isfinite(extent.y))) {
        throw Error(ErrorCode::InvalidArgument,
                    "extent " + numberText(extent.x) + " m × " + numberText(extent.y) + " m must be positive");
    }
}

OntoResult placeOnto(const Surface& droplets, const TexturedMesh& object, const OntoOptions& options)
{
    options.validate();
    droplets.validate();
    object.validate();
    const Atlas atlas = atlasOf(object, options.extent);
    const std::size_t count = droplets.vertices.size();
    std::vector<Vec2> flat(count);
    for (std::size_t v = 0; v < count; ++v) {
        // Texture coordinates of a sheet that leans out are not those of the place below it.
        flat[v] = {droplets.vertices[v].x, droplets.vertices[v].y};
    }
    const DropletNumbers numbers = numberDroplets(droplets);
    const std::vector<std::uint32_t>& droplet = numbers.of;
    const auto is_there = [&](const Facet& facet, Vec2 p) {
        return options.is_there(facet.source, {0.5 + p.x / options.extent.x, 0.5 - p.y / options.extent.y});
    };
    const Hits hits =
        findHits(droplets, atlas, flat, options.is_there ? std::function<bool(const Facet&, Vec2)>(is_there) : nullptr);
    std::vector<DropletPlacement> placements = placeDroplets(hits, numbers);

    const auto is_placed = [&](std::size_t v) {
        return droplet[v] != DropletNumbers::kNone && placements[droplet[v]].result == PlacementResult::Placed;
    };
    std::vector<PlacedVertex> placed(count);
    forBlocks(count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            if (is_placed(v)) {
                const Hit& hit = *hits.on(v, placements[droplet[v]].chart);
                const std::uint32_t first = droplets.weld[v];  // copies must have the same position, bit for bit
                placed[v] = atlas.placeVertex(atlas.facets[hit.facet], flat[first], droplets.vertices[first].z,
                                              droplets.normals[v]);
            }
        }
    });
    for (std::size_t v = 0; v < count; ++v) {
        if (is_placed(v) && !(placed[v].volume_ratio * atlas.facing[placements[droplet[v]].chart] > 0.0)) {
            placements[droplet[v]].result = PlacementResult::Folded;
        }
    }

    OntoResult result;
    OntoReport& report = result.report;
    countCharts(atlas, hits, numbers, placements, report);
    requireAnyPlaced(report, numbers.count);
    Surface& surface = result.surface;
    std::vector<std::uint32_t> renamed(count, DropletNumbers::kNone);
    std::vector<bool> kept(count, false);
    report.min_scale = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < count; ++v) {
        if (!is_placed(v)) {
            continue;
        }
        kept[v] = true;
        renamed[v] = static_cast<std::uint32_t>(surface.vertices.size());
        surface.vertices.push_back(placed[v].position);
        surface.normals.push_back(placed[v].normal);
        surface.uvs.push_back(droplets.uvs[v]);
        surface.weld.push_back(renamed[droplets.weld[v]]);
        if (!droplets.contact_angle.empty()) {
            const double angle = std::acos(std::clamp(dot(placed[v].normal, placed[v].ground_normal), -1.0, 1.0));
            surface.contact_angle.push_back(droplets.contact_angle[v] > 0.0F ? static_cast<float>(angle) : 0.0F);
        }
        report.min_scale = std::min(report.min_scale, placed[v].scale);
        report.max_scale = std::max(report.max_scale, placed[v].scale);
    }
    for (const auto& [a, b, c] : droplets.triangles) {
        if (kept[a]) {
            const bool mirrored = atlas.facing[placements[droplet[a]].chart] < 0.0;
            surface.triangles.push_back(mirrored ? Triangle{renamed[a], renamed[c], renamed[b]}
                                                 : Triangle{renamed[a], renamed[b], renamed[c]});
        }
    }
    surface.texture_map = droplets.texture_map;
    surface.mean_height = extentOf(droplets, placed, kept, 0, droplets.triangles.size()).meanHeight();
    surface.parts = partsOf(droplets, placed, kept);
    for (const std::uint32_t t : quadrilaterals(surface)) {
        if (surface.triangles[t][2] != surface.triangles[t + 1][1]) {
            std::swap(surface.triangles[t], surface.triangles[t + 1]);  // mirrored, they go round the other way
        }
    }
    addWarnings(report);
    return result;
}

}  // namespace droplet
