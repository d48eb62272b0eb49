// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// Object in space with texture coordinates.
///
/// Invariants: all arrays of vertices have one length; there is a triangle; indices are in range; numbers are finite;
/// normals have unit length to 1e-6. A vertex is stored once for every normal and uv that it has.
struct TexturedMesh {
    std::vector<Vec3> vertices;       ///< vertices [m], z up
    std::vector<Vec3> normals;        ///< one per vertex, unit length, outward
    std::vector<Vec2> uvs;            ///< one per vertex; (0,0) top left of the texture, (1,1) bottom right
    std::vector<Triangle> triangles;  ///< indices of vertices

    /// Checks the invariants.
    /// @throws Error InvalidArgument
    void validate() const;
};

}  // namespace droplet
