// SPDX-License-Identifier: GPL-3.0-or-later
#include "sequence/followed_sheets.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "droplet/mesh/follow.h"
#include "mesh/carry_points.h"

namespace droplet {
namespace {

std::vector<Vec2> rimOf(const PlanarMesh& mesh)
{
    return {mesh.vertices.begin(), mesh.vertices.begin() + mesh.rimVertexCount()};
}

/// Footprint of a sheet at its new place: that of the droplet, unless its inner corners are rounded.
std::optional<PlanarMesh> movedFootprint(const SheetOrigin& origin, const PlanarMesh& mesh)
{
    const PlanarMesh& footprint = *origin.sheet.footprint;
    return sameRim(footprint, origin.mesh) ? std::optional(mesh)
                                           : moveRim(footprint, carryPoints(origin.mesh, mesh, rimOf(footprint)));
}

}  // namespace

std::optional<FollowedSheets> followSheets(const SheetOrigins& origins, const Droplet& before,
                                           const std::vector<PlanarMesh>& meshes, std::vector<PlanarMesh> bases,
                                           const SolveOptions& options)
{
    const std::vector<CapillarySurface>& surfaces = before.solution.droplets;
    if (!haveSheets(surfaces) || !options.ground.flat()) {
        return std::nullopt;
    }
    const std::size_t count = meshes.size();
    std::vector<PlanarMesh> footprints(count);
    for (std::size_t k = 0; k < count; ++k) {
        if (surfaces[k].isHeightField()) {
            continue;
        }
        std::optional<PlanarMesh> footprint = movedFootprint(*origins[k], meshes[k]);
        if (!footprint) {
            return std::nullopt;
        }
        footprints[k] = *std::move(footprint);
        if (!bases.empty()) {
            std::optional<PlanarMesh> base = moveRim(*origins[k]->base, rimOf(footprints[k]));
            if (!base) {
                return std::nullopt;
            }
            bases[k] = *std::move(base);
        }
    }
    FollowedSheets followed{{}, std::move(bases)};
    if (options.fill.sharing == FillSharing::Total && count > 1) {
        std::vector<CapillarySurface> first;
        std::vector<CapillarySurface> last;
        for (std::size_t k = 0; k < count; ++k) {
            if (surfaces[k].isHeightField()) {
                return std::nullopt;
            }
            first.push_back(origins[k]->sheet);
            last.push_back(surfaces[k]);
        }
        SheetResult result = follow(join(first), join(last), join(footprints), options);
        if (result.end != SheetEnd::Reached) {
            return std::nullopt;
        }
        followed.sheets.emplace_back(std::move(result));
        return followed;
    }
    followed.sheets.resize(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        if (!surfaces[k].isHeightField()) {
            followed.sheets[k] = follow(origins[k]->sheet, surfaces[k], footprints[k], ownOptions(options, k));
        }
    });
    const bool all_reached = std::all_of(followed.sheets.begin(), followed.sheets.end(), [](const auto& result) {
        return !result || result->end == SheetEnd::Reached;
    });
    return all_reached ? std::optional(std::move(followed)) : std::nullopt;
}

const CapillarySurface* sheetOf(const Droplet& droplet, std::size_t k)
{
    const CapillarySurface& surface = droplet.solution.droplets[k];
    return surface.isHeightField() ? nullptr : &surface;
}

bool isSameSheet(const Droplet& before, const Droplet& after, std::size_t k)
{
    const CapillarySurface* a = sheetOf(before, k);
    const CapillarySurface* b = sheetOf(after, k);
    return a != nullptr && b != nullptr ? a->triangles == b->triangles : a == b;
}

SheetOrigins originsOf(const Droplet& droplet, const SheetOrigins& origins, const std::vector<PlanarMesh>& bases)
{
    if (!haveSheets(droplet.solution.droplets)) {
        return {};
    }
    SheetOrigins result(droplet.solution.droplets.size());
    for (std::size_t k = 0; k < result.size(); ++k) {
        const CapillarySurface& sheet = droplet.solution.droplets[k];
        if (sheet.isHeightField()) {
            continue;
        }
        if (k < origins.size() && origins[k] && origins[k]->sheet.triangles == sheet.triangles) {
            result[k] = origins[k];
            continue;
        }
        std::optional<PlanarMesh> base;
        if (!bases.empty()) {
            base = sameRim(bases[k], *sheet.footprint) ? bases[k] : movableCover(*sheet.footprint);
        }
        result[k] = std::make_shared<const SheetOrigin>(SheetOrigin{sheet, droplet.meshes[k], std::move(base)});
    }
    return result;
}

}  // namespace droplet
