// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/object.h"

#include <utility>

#include "file_bytes.h"
#include "io/gltf_scene.h"

namespace droplet {

TexturedMesh readObject(const std::filesystem::path& path)
{
    TexturedMesh mesh;
    readFile(path, [&] {
        FileMesh scene = readScene(path, {.needs_uv = true});
        mesh.positions = std::move(scene.positions);
        mesh.normals = std::move(scene.normals);
        mesh.uvs = std::move(scene.uvs);
        mesh.triangles = std::move(scene.triangles);
    });
    return mesh;
}

}  // namespace droplet
