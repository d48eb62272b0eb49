// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene.h"

#include <algorithm>

#include "axes.h"
#include "byte_stream.h"

namespace droplet {

SceneMaterial liquidMaterial(const Look& look, double thickness)
{
    return {look, thickness > 0.0 ? std::optional(thickness) : std::nullopt};
}

SceneMaterial opaqueMaterial(const std::string& name, double roughness)
{
    Look look;
    look.name = name;
    look.roughness = roughness;
    look.transmission = 0.0;
    return {.look = std::move(look), .both_sides = true};
}

std::size_t Scene::addNode(SceneNode node, std::optional<std::size_t> parent)
{
    const std::size_t index = nodes.size();
    nodes.push_back(std::move(node));
    (parent ? nodes[*parent].children : roots).push_back(index);
    return index;
}

std::size_t Scene::addMesh(SceneMesh mesh)
{
    meshes.push_back(std::move(mesh));
    return meshes.size() - 1;
}

std::size_t Scene::addMaterial(SceneMaterial material)
{
    materials.push_back(std::move(material));
    return materials.size() - 1;
}

void Scene::spreadInstances()
{
    for (const SceneInstances& one : instances) {
        SceneCrowd crowd{one.mesh, {}, one.parent};
        for (std::size_t i = 0; i < one.translations.size(); ++i) {
            SceneNode node;
            std::copy(one.translations[i].begin(), one.translations[i].end(), node.translation.begin());
            std::copy(one.rotations[i].begin(), one.rotations[i].end(), node.rotation.begin());
            std::copy(one.scales[i].begin(), one.scales[i].end(), node.scale.begin());
            crowd.nodes.push_back(addNode(std::move(node), one.parent));
        }
        crowds.push_back(std::move(crowd));
    }
    instances.clear();
}

std::size_t Scene::addTimes(std::vector<float> keys)
{
    times.push_back(std::move(keys));
    return times.size() - 1;
}

Float3 sceneVector(Vec3 vector)
{
    const Vec3 up = yUp(vector);
    return {toFloat(up.x), toFloat(up.y), toFloat(up.z)};
}

std::vector<Float3> sceneVectors(const std::vector<Vec3>& vectors)
{
    std::vector<Float3> floats(vectors.size());
    std::transform(vectors.begin(), vectors.end(), floats.begin(), sceneVector);
    return floats;
}

std::vector<Float2> sceneCoordinates(const std::vector<Vec2>& uvs)
{
    std::vector<Float2> floats(uvs.size());
    std::transform(uvs.begin(), uvs.end(), floats.begin(), [](Vec2 uv) {
        return Float2{toFloat(uv.x), toFloat(uv.y)};
    });
    return floats;
}

Vec3 vectorOf(const Float3& numbers)
{
    return {static_cast<double>(numbers[0]), static_cast<double>(numbers[1]), static_cast<double>(numbers[2])};
}

}  // namespace droplet
