// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"

namespace droplet {

/// Moves inner vertices toward the rim where the liquid will be steep, so that triangles that are even on the ground
/// come out about even on the liquid's surface.
///
/// A cap's surface maps to its disc without distortion of angles by stereographic projection; seen from above, points
/// even there crowd at the rim. Other footprints borrow that map along the slopes of their linear solution. Without it
/// the exact model converges with little more than order 1 where liquid leaves the rim at 85°; with it, with order 2.
///
/// Guarantees: connections, rim and area stay; triangles keep their winding. Meshes that the linear model expects to be
/// no steeper than 60° in the mean come back as they are, lattice and all; of the others the lattice is forgotten.
/// @param meshes   valid, at least one
/// @param options  what will be solved
/// @throws Error   as solve
std::vector<PlanarMesh> spread(std::vector<PlanarMesh> meshes, const SolveOptions& options);

}  // namespace droplet
