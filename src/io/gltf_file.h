// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/file_material.h"

namespace droplet {

/// Channel of an animation with its sampler. Indices may be too large.
struct GltfChannel {
    std::optional<std::size_t> node;  ///< empty: none that could be read
    std::string path;                 ///< "translation", "rotation" …
    std::string interpolation = "LINEAR";
    int times = -1;   ///< accessor; -1: none
    int values = -1;  ///< accessor; -1: none
};

struct GltfAnimation {
    std::string name;  ///< "": none
    std::vector<GltfChannel> channels;
};

/// Joints that move vertices. Indices may be too large.
struct GltfSkin {
    int matrices = -1;                ///< accessor of the inverse bind matrices; -1: they are unit matrices
    std::vector<std::size_t> joints;  ///< nodes
};

/// The part of a glTF file that describes triangles and how they move: scenes, nodes, meshes, skins, animations,
/// accessors, buffers and materials. Extras and other extensions are left out.
struct GltfFile {
    tinygltf::Model model;                    ///< without skins and animations
    std::vector<std::string> material_names;  ///< "" where a material has none
    std::vector<FileMaterial> materials;      ///< as many, if asked for
    std::vector<GltfAnimation> animations;
    std::vector<GltfSkin> skins;
};

/// Reads glTF 2.0: .glb, or .gltf with its buffers embedded or beside it.
/// Guarantees: buffers have their stated length; a node's matrix, rotation, scale and translation have the required
/// number of entries, or none. Indices are not negative.
/// Not checked: indices may be too large; views and accessors may reach beyond their buffers.
/// @throws Damage, nlohmann::json::exception, std::bad_alloc, std::length_error: see readFile
/// @param reads_materials  and the images of their colours, of which those that cannot be read are left out
GltfFile readGltfFile(const std::filesystem::path& path, bool reads_materials = false);

}  // namespace droplet
