// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Moves points along with the rim of a mesh.
///
/// Every edge of the rim carries the points around it as it moves, turns and grows; the nearer it is, the more it
/// counts. Points on an edge stay on it. If the rim moves, turns and grows as a whole, so do the points.
/// @param before  mesh with points near its rim
/// @param after   the same mesh, moved
std::vector<Vec2> carryPoints(const PlanarMesh& before, const PlanarMesh& after, const std::vector<Vec2>& points);

}  // namespace droplet
