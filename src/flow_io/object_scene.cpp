// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_io/object_scene.h"

#include <string>

#include "render/scene_object.h"

namespace droplet {

std::size_t addObject(const FlowObject& object, Scene& scene, const std::vector<MeshShape>& changes)
{
    const std::size_t node =
        addObject(SceneObject{object.vertices, object.normals, object.uvs, object.colours, object.triangles,
                              object.materials, object.material_names, object.looks, object.images},
                  scene);
    SceneMesh& mesh = scene.meshes[*scene.nodes[node].mesh];
    for (const MeshShape& change : changes) {
        mesh.geometries.front().targets.push_back({sceneVectors(change.vertices), sceneVectors(change.normals)});
        mesh.targets.push_back("motion " + std::to_string(mesh.targets.size() + 1));
    }
    return node;
}

}  // namespace droplet
