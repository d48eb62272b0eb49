// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/gltf.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "io/surface_scene.h"
#include "scene/write_gltf.h"

namespace droplet {
namespace {

/// Refuses a surface that is too large before anything is made of it.
void checkFileSize(const Surface& surface, const GltfOptions& options)
{
    // Position 3, normal 3, uv 2, changes of position and normal 6 in every state of a refill.
    const std::uint64_t floats = 8 + 6 * (surface.refill ? surface.refill->states.size() : 0);
    const std::uint64_t buffer = sizeof(float) * floats * surface.vertices.size();
    const std::uint64_t file = options.binary ? buffer : (buffer + 2) / 3 * 4;
    if (file >= kGltfFileLimit) {
        throw Error(ErrorCode::InvalidArgument, "surface with " + std::to_string(surface.triangles.size()) +
                                                    " triangles would make a glTF file of over " +
                                                    std::to_string(file) + " bytes; it must stay below 2 GiB");
    }
}

/// Adds the nodes and meshes of a surface with fewer triangles.
/// @param level   scene of that surface, with the materials of `scene`
/// @param number  from 1
void addLevel(Scene& scene, Scene level, std::size_t number)
{
    const std::string suffix = "_lod" + std::to_string(number);
    const std::size_t first = scene.meshes.size();
    for (SceneMesh& mesh : level.meshes) {
        mesh.name += suffix;
        scene.addMesh(std::move(mesh));
    }
    for (std::size_t i = 0; i < level.nodes.size(); ++i) {
        SceneNode node{level.nodes[i].name + suffix, first + *level.nodes[i].mesh};
        scene.nodes[i].levels.push_back(scene.nodes.size());
        scene.nodes.push_back(std::move(node));
    }
}

/// Adds the surfaces with fewer triangles.
void addLevels(Scene& scene, const Surface& surface, const GltfOptions& options, const SurfaceSceneOptions& look)
{
    std::vector<double> coverage;
    const std::size_t nodes = scene.nodes.size();
    for (std::size_t k = 0; k < options.levels.size(); ++k) {
        const Surface& level = options.levels[k];
        Scene own = sceneOf(level, look);
        if (own.nodes.size() != nodes || own.materials.size() != scene.materials.size()) {
            throw Error(ErrorCode::InvalidArgument,
                        "options.levels[" + std::to_string(k) + "] must have the parts of the surface");
        }
        addLevel(scene, std::move(own), k + 1);
        coverage.push_back(static_cast<double>(level.triangles.size()) / static_cast<double>(surface.triangles.size()));
    }
    coverage.push_back(0.0);  // the last one is never left out
    for (std::size_t i = 0; i < nodes; ++i) {
        scene.nodes[i].properties.emplace_back("MSFT_screencoverage", coverage);
    }
}

}  // namespace

std::uint64_t writeGltf(const Surface& surface, std::ostream& out, const GltfOptions& options)
{
    checkFileSize(surface, options);
    const SurfaceSceneOptions look{options.material, options.closed, options.nodes, options.droplets, options.texture};
    Scene scene = sceneOf(surface, look);
    if (!options.levels.empty()) {
        addLevels(scene, surface, options, look);
    }
    return writeGltf(scene, out, {options.binary ? Format::Glb : Format::Gltf, options.compression});
}

}  // namespace droplet
