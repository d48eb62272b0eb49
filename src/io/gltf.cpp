// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/gltf.h"

#include <cstdint>
#include <string>

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

}  // namespace

std::uint64_t writeGltf(const Surface& surface, std::ostream& out, const GltfOptions& options)
{
    checkFileSize(surface, options);
    const Scene scene = sceneOf(
        surface, {options.material, options.closed, options.nodes, options.droplets, options.texture, options.levels});
    return writeGltf(scene, out, {options.binary ? Format::Glb : Format::Gltf, options.compression});
}

}  // namespace droplet
