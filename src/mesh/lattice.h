// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "mesh/lattice_grid.h"

namespace droplet {

/// The regular part of a mesh: which of its vertices are points of an equilateral lattice.
///
/// Invariants: the grid's indices are the last vertices of the mesh; any three of them that are mutual neighbours on
/// the lattice form a triangle of the mesh.
struct Lattice {
    double edge = 0.0;  ///< between neighbouring points [m]
    LatticeGrid grid;   ///< the points, by the vertices at them; never empty
    /// From here on triangles join vertices all of whose triangles are equilateral.
    std::uint32_t first_regular_triangle = 0;
};

/// How many of a mesh's triangles, its first, have to be looked at one by one: all but the regular ones of its lattice.
std::size_t irregularTriangleCount(const PlanarMesh& mesh);

/// The vertices of a mesh all of whose triangles are equilateral, in ascending order.
std::vector<GridRun> regularRuns(const PlanarMesh& mesh);

}  // namespace droplet
