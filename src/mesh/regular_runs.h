// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "mesh/lattice_region.h"

namespace droplet {

/// Vertices with consecutive indices along a lattice row, around which all triangles are equilateral.
struct RegularRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t below = 0;  ///< left of the two neighbours of the first in the row below
    std::uint32_t above = 0;
};

/// The lattice points of a mesh.
LatticeRegion regionOf(const Lattice& lattice);

/// The regular vertices of a mesh, in ascending order.
std::vector<RegularRun> regularRuns(const Lattice& lattice);

}  // namespace droplet
