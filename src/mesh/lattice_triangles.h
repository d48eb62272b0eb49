// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "mesh/lattice_grid.h"
#include "mesh/lattice_region.h"

namespace droplet {

/// Triangles of neighbouring lattice points, by the left ends of their horizontal edges.
struct LatticeTriangles {
    LatticeRegion upward;    ///< with the third corner above
    LatticeRegion downward;  ///< with the third corner below

    [[nodiscard]] std::size_t size() const { return upward.size() + downward.size(); }
};

/// The triangles all three corners of which belong to a region.
LatticeTriangles trianglesOf(const LatticeRegion& region);

/// The triangles of the one that are not of the other.
LatticeTriangles without(const LatticeTriangles& triangles, const LatticeTriangles& removed);

/// Appends them row by row, corners by their indices in a grid that has them.
void append(std::vector<Triangle>& to, const LatticeTriangles& triangles, const LatticeGrid& grid);

}  // namespace droplet
