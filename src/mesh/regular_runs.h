// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "mesh/lattice_grid.h"
#include "mesh/lattice_region.h"

namespace droplet {

/// Points with consecutive indices along a lattice row, around which all triangles are equilateral.
struct RegularRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t below = 0;  ///< left of the two neighbours of the first in the row below
    std::uint32_t above = 0;
};

/// A run along a row of a grid that holds all its neighbours.
RegularRun regularRun(const LatticeGrid& grid, std::int32_t row, ColumnInterval columns);

/// The lattice points of a mesh.
LatticeRegion regionOf(const Lattice& lattice);

/// How many of a mesh's triangles, its first, have to be looked at one by one: all but the regular ones of its lattice.
inline std::size_t irregularTriangleCount(const PlanarMesh& mesh)
{
    return mesh.lattice.runs.empty() ? mesh.triangles.size() : mesh.lattice.first_regular_triangle;
}

/// The regular vertices of a mesh, in ascending order.
std::vector<RegularRun> regularRuns(const Lattice& lattice);

}  // namespace droplet
