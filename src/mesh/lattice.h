// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "mesh/lattice_grid.h"

namespace droplet {

/// Regular part of a mesh: its vertices that are points of an equilateral lattice.
///
/// Invariants: the grid's indices are the last vertices of the mesh; three of them that are neighbours of one another
/// on the lattice form a triangle of the mesh.
struct Lattice {
    double edge = 0.0;  ///< distance between neighbouring points [m]
    LatticeGrid grid;   ///< vertices at the points; never empty
    /// Triangles from this index on join only vertices whose triangles are all equilateral.
    std::uint32_t first_regular_triangle = 0;
};

/// Number of triangles, from the first, that must be handled one by one: all but the regular ones of the lattice.
std::size_t irregularTriangleCount(const PlanarMesh& mesh);

/// Vertices that have only equilateral triangles, in ascending order.
/// @param lattice  of a mesh; null: none
std::vector<GridRun> regularRuns(const Lattice* lattice);

}  // namespace droplet
