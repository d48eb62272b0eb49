// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// All triangles of a glTF scene, at rest, z up, in metres.
struct SceneMesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;          ///< unit
    std::vector<Vec2> uvs;              ///< as they stand; 0 where a mesh has none
    std::vector<float> contact_angles;  ///< [rad]; 0 where a mesh has none
    std::vector<Triangle> triangles;    ///< none whose vertices repeat; at least one
    std::vector<std::uint32_t> weld;    ///< the first vertex at the same place
    bool moves = false;                 ///< it has animations, skins or morph targets, which were passed over
};

struct SceneOptions {
    bool needs_uv = false;  ///< a mesh of triangles without uv is damage
};

/// Reads glTF 2.0: .glb, or .gltf with its buffers embedded or beside it.
/// Guarantees: indices are in range, numbers finite.
/// @throws Damage, nlohmann::json::exception, std::bad_alloc, std::length_error: see readFile
SceneMesh readScene(const std::filesystem::path& path, const SceneOptions& options = {});

}  // namespace droplet
