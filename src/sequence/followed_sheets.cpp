// SPDX-License-Identifier: GPL-3.0-or-later
#include "sequence/followed_sheets.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "droplet/mesh/follow.h"
#include "mesh/carry_points.h"
#include "pipeline.h"

namespace droplet {
namespace {

bool isWhole(const PlanarMesh& mesh)
{
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                       [&](const Triangle& t) { return doubleArea(mesh, t) > 0.0; });
}

std::vector<Vec2> rimOf(const PlanarMesh& mesh)
{
    return {mesh.vertices.begin(), mesh.vertices.begin() + mesh.rimVertexCount()};
}

/// Footprint of a sheet at its new place: that of the droplet, unless its inner corners are rounded.
PlanarMesh movedFootprint(const SheetOrigin& origin, const PlanarMesh& mesh)
{
    const PlanarMesh& footprint = origin.sheet.footprint;
    return sameRim(footprint, origin.mesh) ? mesh
                                           : moveRim(footprint, carryPoints(origin.mesh, mesh, rimOf(footprint)));
}

SolveOptions ownOptions(const SolveOptions& options, std::size_t k)
{
    SolveOptions own = options;
    if (!options.volumes.empty()) {
        own.volumes.clear();
        own.fill = {FillBy::Volume, options.volumes[k], FillSharing::Each};
    }
    return own;
}

}  // namespace

std::optional<FollowedSheets> followSheets(const SheetOrigins& origins, const Droplet& before,
                                           const std::vector<PlanarMesh>& meshes, std::vector<PlanarMesh> bases,
                                           const SolveOptions& options)
{
    const bool is_single = options.fill.sharing == FillSharing::Each || meshes.size() == 1;
    if (before.sheets.empty() || !is_single || !options.ground.flat()) {
        return std::nullopt;
    }
    FollowedSheets followed{std::vector<std::optional<SheetResult>>(meshes.size()), std::move(bases)};
    std::vector<std::uint8_t> is_lost(meshes.size(), 0);
    tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t k) {
        if (!before.sheets[k]) {
            return;
        }
        is_lost[k] = 1;
        const SheetOrigin& origin = *origins[k];
        const PlanarMesh footprint = movedFootprint(origin, meshes[k]);
        if (!isWhole(footprint)) {
            return;
        }
        if (!followed.bases.empty()) {
            followed.bases[k] = moveRim(*origin.base, rimOf(footprint));
            if (!isWhole(followed.bases[k])) {
                return;
            }
        }
        SheetResult result = follow(origin.sheet, *before.sheets[k], footprint, ownOptions(options, k));
        if (result.end == SheetEnd::Reached) {
            followed.sheets[k] = std::move(result);
            is_lost[k] = 0;
        }
    });
    return std::count(is_lost.begin(), is_lost.end(), 1) == 0 ? std::optional(std::move(followed)) : std::nullopt;
}

const ParametricSheet* sheetOf(const Droplet& droplet, std::size_t k)
{
    return !droplet.sheets.empty() && droplet.sheets[k] ? &*droplet.sheets[k] : nullptr;
}

bool isSameSheet(const Droplet& before, const Droplet& after, std::size_t k)
{
    const ParametricSheet* a = sheetOf(before, k);
    const ParametricSheet* b = sheetOf(after, k);
    return a != nullptr && b != nullptr ? a->triangles == b->triangles : a == b;
}

SheetOrigins originsOf(const Droplet& droplet, const SheetOrigins& origins, const std::vector<PlanarMesh>& bases)
{
    SheetOrigins result(droplet.sheets.size());
    for (std::size_t k = 0; k < droplet.sheets.size(); ++k) {
        if (!droplet.sheets[k]) {
            continue;
        }
        const ParametricSheet& sheet = *droplet.sheets[k];
        if (k < origins.size() && origins[k] && origins[k]->sheet.triangles == sheet.triangles) {
            result[k] = origins[k];
            continue;
        }
        std::optional<PlanarMesh> base;
        if (!bases.empty()) {
            base = sameRim(bases[k], sheet.footprint) ? bases[k] : cover(sheet.footprint);
        }
        result[k] = std::make_shared<const SheetOrigin>(SheetOrigin{sheet, droplet.meshes[k], std::move(base)});
    }
    return result;
}

}  // namespace droplet
