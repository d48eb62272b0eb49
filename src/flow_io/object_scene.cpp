// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_io/object_scene.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace droplet {

SceneMaterial opaqueMaterial(const std::string& name, double roughness)
{
    Look look;
    look.name = name;
    look.roughness = roughness;
    look.transmission = 0.0;
    return {.look = std::move(look), .both_sides = true};
}

std::size_t addObject(const FlowObject& object, Scene& scene, const std::vector<MeshShape>& changes)
{
    SceneMesh mesh{"object"};
    SceneGeometry& geometry = mesh.geometries.emplace_back();
    geometry.vertices = sceneVectors(object.vertices);
    geometry.normals = sceneVectors(object.normals);
    geometry.uvs = sceneCoordinates(object.uvs);
    std::transform(object.colours.begin(), object.colours.end(), std::back_inserter(geometry.colours), [](Vec3 colour) {
        return Float3{static_cast<float>(colour.x), static_cast<float>(colour.y), static_cast<float>(colour.z)};
    });
    for (const MeshShape& change : changes) {
        geometry.targets.push_back({sceneVectors(change.vertices), sceneVectors(change.normals)});
        mesh.targets.push_back("motion " + std::to_string(mesh.targets.size() + 1));
    }
    std::vector<std::string> names = object.material_names;
    names.resize(std::max<std::size_t>(names.size(), 1), "object");
    std::vector<ScenePart> parts(names.size());
    for (std::size_t i = 0; i < object.triangles.size(); ++i) {
        parts.at(object.materials.empty() ? 0 : object.materials[i]).triangles.push_back(object.triangles[i]);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!parts[i].triangles.empty()) {
            SceneMaterial material = opaqueMaterial(names[i], 0.6);
            material.look.colour = {0.6, 0.6, 0.6};
            if (!object.looks.empty()) {
                const StandLook& look = object.looks[i];
                const LookImages& images = object.images[i];
                material = {.look = look.look,
                            .thickness = look.thickness,
                            .absorption = look.absorption,
                            .opacity = look.opacity,
                            .blends = images.blends,
                            .cutoff = images.cutoff,
                            .both_sides = !look.thickness,
                            .image = images.colours,
                            .normal_image = images.normals,
                            .relief = look.relief,
                            .finish_image = images.finish,
                            .glow = look.glow,
                            .glow_image = images.glows,
                            .place = look.place};
                material.look.name = names[i];
            }
            parts[i].material = scene.addMaterial(std::move(material));
            geometry.parts.push_back(std::move(parts[i]));
        }
    }
    return scene.addNode({"object", scene.addMesh(std::move(mesh))});
}

}  // namespace droplet
