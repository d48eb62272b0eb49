// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "shape/sheet_path.h"

namespace droplet {

/// A footprint at one mesh size, and how a sheet over it is made.
struct SheetLevel {
    PlanarMesh
        footprint;  ///< of one droplet, or of several at one pressure; inner corners are rounded by the mesh size
    SheetOptions options;
};

/// Fills a footprint up to a target: along the path from dry ground over the coarsest mesh alone, and then over each
/// finer one with a few steps of Newton's method.
///
/// Guarantees: as of fillSheet(), over the finest footprint.
/// @param levels  from the coarsest to the finest, each with triangles of about half the edge, on flat ground; at least
///                one
/// @param work    receives what was done, as SheetOptions::max_work
/// @return        none if that fails on any level; then fillSheet() tells the end
std::optional<FilledSheet> fillByLevels(const std::vector<SheetLevel>& levels, const SheetTarget& target, double& work);

}  // namespace droplet
