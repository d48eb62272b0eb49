// SPDX-License-Identifier: GPL-3.0-or-later
// The meshes of a scene of droplets.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"
#include "io/byte_stream.h"

namespace droplet {

/// Arrays of a mesh, +Z up.
struct DropletMesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Triangle> triangles;
    std::vector<Vec2> uvs;  ///< one per vertex, (0,0) top left; or empty
};

/// Adds a mesh to the model; writeMesh() then writes its bytes.
/// @return  index of the mesh
int addMesh(tinygltf::Model& model, const DropletMesh& mesh, const char* name, int material);
void writeMesh(const DropletMesh& mesh, ByteStream& bytes);

/// Lowest and highest coordinates of points, at least one.
std::array<Vec3, 2> cornersOf(const std::vector<Vec3>& positions);

}  // namespace droplet
