// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

namespace droplet {

/// View of a buffer by EXT_meshopt_compression.
struct MeshoptView {
    std::size_t view = 0;    ///< index of the view with the extension
    nlohmann::json content;  ///< the extension, of which nothing is checked
};

/// Points the views that have the extension at their compressed bytes, and gives buffers that exist only
/// without compression three bytes.
/// @param root             glTF without extensions, which takes the changes
/// @param with_extensions  the same glTF with its extensions
/// @return                 the views
std::vector<MeshoptView> findMeshoptViews(nlohmann::json& root, const nlohmann::json& with_extensions);

/// Decodes views into buffers of their own.
/// @throws Damage
void decodeMeshoptViews(tinygltf::Model& model, const std::vector<MeshoptView>& views);

}  // namespace droplet
