// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "droplet/droplet.h"
#include "pipeline.h"

namespace droplet {

/// A sheet as it was solved anew: the beginning of a run of frames.
struct SheetOrigin {
    CapillarySurface sheet;
    PlanarMesh mesh;                 ///< of the droplet then
    std::optional<PlanarMesh> base;  ///< movableCover() of the sheet's footprint, if surfaces are closed
};

/// Origins of the sheets of a frame, one per droplet; null where it is none.
using SheetOrigins = std::vector<std::shared_ptr<const SheetOrigin>>;

/// Sheets that followed their rims into a frame, and the bases of all droplets.
struct FollowedSheets {
    std::vector<std::optional<SheetResult>> sheets;  ///< one per droplet, or one for all at one pressure
    std::vector<PlanarMesh> bases;                   ///< as given, but of the sheets' footprints
};

/// Moves all sheets of a frame with the meshes of their droplets.
/// @param origins  of the sheets
/// @param before   the frame before
/// @param meshes   of the frame, the moved ones of the frame before
/// @param bases    of the meshes, or empty
/// @param options  of the frame
/// @return         none unless all of them can be moved
std::optional<FollowedSheets> followSheets(const SheetOrigins& origins, const Droplet& before,
                                           const std::vector<PlanarMesh>& meshes, std::vector<PlanarMesh> bases,
                                           const SolveOptions& options);

/// Sheet of a droplet; null if it is none.
const CapillarySurface* sheetOf(const Droplet& droplet, std::size_t k);

/// Whether a droplet is a sheet in both of two frames, with the same triangles, or in none of them.
bool isSameSheet(const Droplet& before, const Droplet& after, std::size_t k);

/// Origins of a frame's sheets: those that followed keep theirs.
/// @param origins  of the frame before, if its sheets followed; or empty
/// @param bases    of the droplets' meshes or sheets, if surfaces are closed
SheetOrigins originsOf(const Droplet& droplet, const SheetOrigins& origins, const std::vector<PlanarMesh>& bases);

}  // namespace droplet
