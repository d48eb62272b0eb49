// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tiny_gltf.h>

#include <filesystem>

namespace droplet {

/// What describes triangles in a glTF file: scenes, nodes, meshes, accessors and buffers. Materials, images, extras and
/// extensions are left out.
struct GltfFile {
    tinygltf::Model model;
    bool animated = false;  ///< the file has animations
};

/// Reads glTF 2.0: .glb, or .gltf with its buffers embedded or beside it.
/// Guarantees: buffers have the length they say; a node's matrix, rotation, scale and translation have as many numbers
/// as they need, or none. Indices are not negative, but may name what does not exist; views and accessors may reach
/// beyond their buffers.
/// @throws Damage, nlohmann::json::exception, std::bad_alloc, std::length_error: see readFile
GltfFile readGltfFile(const std::filesystem::path& path);

}  // namespace droplet
