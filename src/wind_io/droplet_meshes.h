// SPDX-License-Identifier: GPL-3.0-or-later
// The meshes of a scene of droplets.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/vector.h"
#include "droplet/windshield/glass.h"
#include "io/byte_stream.h"

namespace droplet {

/// Arrays of a mesh, +Z up.
struct DropletMesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Triangle> triangles;
};

/// Resolution of a cap.
struct CapDetail {
    std::uint32_t around = 24;
    std::uint32_t rings = 9;
};

/// Closed mesh of a cap with its base, z off the glass. Its volume is that of the true cap with contact radius 1.
/// @param angle  contact angle [rad]
DropletMesh capMesh(double angle, const CapDetail& detail);

/// Mesh of the glass, with its front to -Y.
DropletMesh glassMesh(const Glass& glass);

/// Adds a mesh to the model; writeMesh() then writes its bytes.
/// @return  index of the mesh
int addMesh(tinygltf::Model& model, const DropletMesh& mesh, const char* name, int material);
void writeMesh(const DropletMesh& mesh, ByteStream& bytes);

/// Adds the glass with its material and node, and returns the node; writeMesh() then writes its bytes.
int addGlass(tinygltf::Model& model, const DropletMesh& pane);

}  // namespace droplet
