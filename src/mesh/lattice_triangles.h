// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "mesh/lattice_grid.h"
#include "mesh/lattice_region.h"

namespace droplet {

/// Triangles of neighbouring lattice points, given by the left ends of their horizontal edges.
struct LatticeTriangles {
    LatticeRegion upward;    ///< third corner above
    LatticeRegion downward;  ///< third corner below

    [[nodiscard]] std::size_t size() const { return upward.size() + downward.size(); }
};

/// Triangles whose three corners all belong to a region.
LatticeTriangles trianglesOf(const LatticeRegion& region);

/// Triangles of the first set that are not in the second.
LatticeTriangles without(const LatticeTriangles& triangles, const LatticeTriangles& removed);

/// Appends triangles row by row; corners are given by their indices in a grid that has them.
void append(std::vector<Triangle>& to, const LatticeTriangles& triangles, const LatticeGrid& grid);

}  // namespace droplet
