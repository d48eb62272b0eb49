// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/droplet_meshes.h"

#include <algorithm>
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

std::array<Vec3, 2> cornersOf(const std::vector<Vec3>& vertices)
{
    std::array<Vec3, 2> corners{vertices.front(), vertices.front()};
    for (const Vec3& p : vertices) {
        const auto& [low, high] = corners;
        corners = {Vec3{std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)},
                   Vec3{std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)}};
    }
    return corners;
}

}  // namespace droplet
