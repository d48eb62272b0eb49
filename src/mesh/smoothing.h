// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// What of a mesh may be moved.
struct SmoothRange {
    std::size_t first_vertex = 0;
    std::size_t end_vertex = 0;  ///< vertices from here on stay
    std::size_t triangles = 0;   ///< so many at the mesh's beginning; all that have a vertex of the range
};

/// Moves vertices toward the area-weighted mean of their triangles' centroids wherever that makes no angle around them
/// smaller than the smallest there was, and leaves no edge off the rim not Delaunay that was so before: the band
/// between lattice and rim evens out, the lattice stays.
void smooth(PlanarMesh& mesh, const SmoothRange& range);

}  // namespace droplet
