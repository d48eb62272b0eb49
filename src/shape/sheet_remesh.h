// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "shape/area_vector.h"

namespace droplet {

/// Sizes of new triangles.
struct RemeshOptions {
    double edge = 0.0;           ///< largest edge inside [m], > 0
    double min_edge = 0.0;       ///< smallest edge that curvature may ask for [m], > 0
    bool is_ground_flat = true;  ///< vertices on the ground, z = 0, stay there
    int rounds = 4;      ///< of splitting, collapsing, flipping and smoothing; 0, for divided triangles: flips and
                         ///< smoothing alone, unless their number is wrong
    bool mends = false;  ///< narrow triangles are collapsed at the end; in folds, where they are needed, sheets
                         ///< may then find no equilibrium
    std::size_t triangles = 0;  ///< number that edge is made shorter or longer for; 0: edge stays
    std::size_t max_triangles = std::numeric_limits<std::size_t>::max();  ///< number at which no edge is split any more
};

/// Gives a sheet new triangles: as long as the rim's edges at the rim, shorter where the sheet is bent, growing
/// inwards.
///
/// Guarantees: the rim keeps its vertices and edges; no triangle has three rim vertices and no edge inside joins two;
/// the topology stays; vertices inside move along the sheet alone, up to its curvature; the same input gives the same
/// bytes. A given number of triangles is met to 5 % where the rim's edges allow it.
CapillarySurface remesh(const CapillarySurface& sheet, const RemeshOptions& options);

/// Moves the inner vertices of a sheet along it, to make its triangles more even. They stay the same triangles.
/// @param is_ground_flat  as in RemeshOptions
CapillarySurface relax(const CapillarySurface& sheet, int rounds, bool is_ground_flat);

/// Smallest angle of every triangle [rad].
std::vector<double> minAngles(const CapillarySurface& sheet);

/// Whether a triangle that moved has become narrow: below 18° and below a share of its angle before.
/// @param before  minAngles() before
bool isWorn(const std::vector<double>& before, const CapillarySurface& sheet, double share);

}  // namespace droplet
