// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Part of a mesh that may be moved.
struct SmoothRange {
    std::size_t first_vertex = 0;
    std::size_t end_vertex = 0;  ///< vertices from here on stay
    std::size_t triangles = 0;   ///< the first triangles of the mesh, with all that have a vertex of the range
};

/// Moves vertices toward the area-weighted mean of their triangles' centroids. A move is made only if it makes no angle
/// around the vertex smaller than the smallest one was, and if every edge off the rim that was Delaunay stays so. The
/// band between lattice and rim becomes more even; the lattice stays.
void smooth(PlanarMesh& mesh, const SmoothRange& range);

}  // namespace droplet
