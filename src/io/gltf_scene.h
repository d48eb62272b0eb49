// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// All triangles of a glTF scene in the rest pose, z up, in metres.
struct SceneMesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;          ///< unit
    std::vector<Vec2> uvs;              ///< as in the file; 0 for meshes without uv
    std::vector<float> contact_angles;  ///< [rad]; 0 for meshes without contact angles
    std::vector<Triangle> triangles;    ///< at least one; three different vertices each
    std::vector<std::uint32_t> weld;    ///< index of the first vertex at the same place
    bool moves = false;                 ///< the file has animations, skins or morph targets, which are ignored
};

struct SceneOptions {
    bool needs_uv = false;  ///< reject triangles without uv as damage
};

/// Reads glTF 2.0: .glb, or .gltf with its buffers embedded or beside it.
/// Guarantees: indices are in range, numbers finite.
/// @throws Damage, nlohmann::json::exception, std::bad_alloc, std::length_error: see readFile
SceneMesh readScene(const std::filesystem::path& path, const SceneOptions& options = {});

}  // namespace droplet
