// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "io/file_mesh.h"

namespace droplet {

struct SceneOptions {
    bool needs_uv = false;                      ///< reject triangles without uv as damage
    bool motion = false;                        ///< read the animation of the node that carries all meshes
    bool weights = false;                       ///< read _WEIGHT, or red of COLOR_0
    bool creases = false;                       ///< divide vertices without a normal at creases
    bool looks = false;                         ///< read materials and their images
    std::optional<FileSampling> sampling = {};  ///< sample an animation that deforms the mesh
};

/// Reads glTF 2.0: .glb, or .gltf with its buffers embedded or beside it.
/// Guarantees: as FileMesh; vertices are in metres, z up, in the rest pose, or at time 0 of the animation that is
/// sampled; weld is filled.
/// @throws Damage, nlohmann::json::exception, std::bad_alloc, std::length_error: see readFile
FileMesh readScene(const std::filesystem::path& path, const SceneOptions& options = {});

}  // namespace droplet
