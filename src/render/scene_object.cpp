// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/scene_object.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace droplet {

std::size_t addObject(const SceneObject& object, Scene& scene)
{
    SceneMesh mesh{"object"};
    SceneGeometry& geometry = mesh.geometries.emplace_back();
    geometry.vertices = sceneVectors(object.vertices);
    geometry.normals = sceneVectors(object.normals);
    geometry.uvs = sceneCoordinates(object.uvs);
    std::transform(object.colours.begin(), object.colours.end(), std::back_inserter(geometry.colours), [](Vec3 colour) {
        return Float3{static_cast<float>(colour.x), static_cast<float>(colour.y), static_cast<float>(colour.z)};
    });
    std::vector<std::string> names = object.names;
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
