// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/render/object_stand.h"
#include "droplet/render/stand_look.h"
#include "droplet/vector.h"
#include "scene/scene.h"

namespace droplet {

/// Object as a file shows it below its droplets. All arrays must outlive it.
struct SceneObject {
    const std::vector<Vec3>& vertices;  ///< [m], z up
    const std::vector<Vec3>& normals;
    const std::vector<Vec2>& uvs;
    const std::vector<Vec3>& colours;  ///< of every vertex; or empty
    const std::vector<Triangle>& triangles;
    const std::vector<std::uint32_t>& materials;  ///< of every triangle, in `names`; or empty
    const std::vector<std::string>& names;        ///< of materials
    const std::vector<StandLook>& looks;          ///< of every material; or empty: the object is plain
    const std::vector<LookImages>& images;        ///< of every look
};

/// Adds an object, with a material for each of its own that has triangles, and its node; returns the node.
std::size_t addObject(const SceneObject& object, Scene& scene);

}  // namespace droplet
