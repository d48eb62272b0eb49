// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tiny_gltf.h>

#include <filesystem>

namespace droplet {

/// The part of a glTF file that describes triangles: scenes, nodes, meshes, accessors and buffers. Materials, images,
/// extras and extensions are left out.
struct GltfFile {
    tinygltf::Model model;
    bool animated = false;  ///< the file has animations
};

/// Reads glTF 2.0: .glb, or .gltf with its buffers embedded or beside it.
/// Guarantees: buffers have their stated length; a node's matrix, rotation, scale and translation have the required
/// number of entries, or none. Indices are not negative.
/// Not checked: indices may be too large; views and accessors may reach beyond their buffers.
/// @throws Damage, nlohmann::json::exception, std::bad_alloc, std::length_error: see readFile
GltfFile readGltfFile(const std::filesystem::path& path);

}  // namespace droplet
