// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/progress.h"
#include "droplet/shape/sheet.h"
#include "droplet/shape/solve.h"
#include "droplet/units.h"

namespace droplet {

/// Rims that stand so upright that a height field is not the true shape any more [rad].
inline constexpr double kUpright = 89.0 * kDegree;

/// Whether any droplet may hang over its rim.
bool haveSheets(const std::vector<CapillarySurface>& surfaces);

/// Shapes of all droplets.
struct LiquidShapes {
    Solution solution = {};
    std::vector<FillLimit> limits = {};  ///< one per droplet: Existence where it has less liquid than was wanted, or
                                         ///< None; empty: all None
    double least_angle = 0.0;            ///< smallest mean contact angle of those [rad]
    /// Why the first sheet was given up for a height field that is upright along a part of its rim; empty if none was.
    std::optional<SheetEnd> given_up = {};
    bool is_stand_in = false;  ///< whether the linear model stands in for an exact shape that was not found
    double work = 0.0;         ///< done, as SolveOptions::max_work

    /// Number of droplets that have less liquid than was wanted.
    [[nodiscard]] std::size_t withLess() const;
};

/// Solves every droplet: by the linear system, by Newton's method, or, where the liquid hangs over its rim, as a sheet.
/// @param meshes      footprints
/// @param options     of solve()
/// @param allow_less  take the most liquid that a footprint can hold where the fill does not exist
/// @param followed    sheets that are solved already, one per droplet, or one for all at one pressure; or empty
/// @throws Error      NoSuchDroplet, with the reason and what to change
LiquidShapes solveShapes(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, bool allow_less,
                         const Progress& progress, std::vector<std::optional<SheetResult>> followed = {});

/// Solves droplets again with other volumes, on the same triangles.
/// @param shapes   result of solveShapes
/// @param volumes  of every droplet [m³], at least 0; with FillSharing::Total their sum is given
/// @param options  options of solveShapes
/// @return         nothing where the droplets do not exist, or not on these triangles
std::optional<LiquidShapes> refill(const std::vector<PlanarMesh>& meshes, const LiquidShapes& shapes,
                                   const std::vector<double>& volumes, const SolveOptions& options);

}  // namespace droplet
