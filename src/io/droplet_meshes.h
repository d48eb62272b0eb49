// SPDX-License-Identifier: GPL-3.0-or-later
// The meshes of a scene of droplets.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"
#include "scene/scene.h"

namespace droplet {

/// Arrays of a mesh, +Z up.
struct DropletMesh {
    std::vector<Vec3> vertices;
    std::vector<Vec3> normals;
    std::vector<Triangle> triangles;
    std::vector<Vec2> uvs;  ///< one per vertex, (0,0) top left; or empty
};

/// A mesh as one of a scene.
/// @param material  index in the scene
/// @throws Error InvalidArgument beyond float's range
SceneMesh sceneMesh(const DropletMesh& mesh, std::string name, std::size_t material);

}  // namespace droplet
