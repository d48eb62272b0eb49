// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/droplet_meshes.h"

#include <utility>

namespace droplet {

SceneMesh sceneMesh(const DropletMesh& mesh, std::string name, std::size_t material)
{
    SceneMesh made{std::move(name)};
    SceneGeometry& geometry = made.geometries.emplace_back();
    geometry.vertices = sceneVectors(mesh.vertices);
    geometry.normals = sceneVectors(mesh.normals);
    geometry.uvs = sceneCoordinates(mesh.uvs);
    geometry.parts.push_back({material, mesh.triangles});
    return made;
}

}  // namespace droplet
