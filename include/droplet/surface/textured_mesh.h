// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// An object in space with the coordinates of its texture.
///
/// Invariants: arrays of vertices have one length; there is a triangle; indices are in range, numbers finite, normals
/// unit to 1e-6. Vertices stand once for every normal and uv they have.
struct TexturedMesh {
    std::vector<Vec3> positions;  ///< [m], z up
    std::vector<Vec3> normals;    ///< unit, outward
    std::vector<Vec2> uvs;        ///< (0,0) top left of the texture, (1,1) bottom right
    std::vector<Triangle> triangles;

    /// Guarantees: returns only when the invariants hold.
    /// @throws Error InvalidArgument
    void validate() const;
};

}  // namespace droplet
