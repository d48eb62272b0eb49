// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// Surface of a liquid as triangles in space, pinned along its rim; it may hang over the rim.
///
/// Invariants: a manifold whose boundary is the rim; rim vertices come first, in the order of the footprint's loops;
/// triangles are counter-clockwise from outside.
struct SheetMesh {
    std::vector<Vec3> vertices;       ///< places [m]
    std::vector<Triangle> triangles;  ///< indices of three vertices
    std::uint32_t rim = 0;            ///< number of rim vertices, which stay in place
};

/// Half the cross product of two edges: outward, as long as the triangle's area.
inline Vec3 areaVector(const std::vector<Vec3>& places, const Triangle& t)
{
    return 0.5 * cross(places[t[1]] - places[t[0]], places[t[2]] - places[t[0]]);
}

}  // namespace droplet
