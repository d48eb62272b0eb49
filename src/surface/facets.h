// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "droplet/surface/textured_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// Triangle of the object, in the picture's plane and in space.
struct Facet {
    std::array<Vec2, 3> flat;                ///< corners in the picture's plane [m]
    std::array<std::uint32_t, 3> corners{};  ///< corners of its chart
    std::uint32_t chart = 0;
    std::uint32_t source = 0;  ///< triangle of the object
    double twice_flat = 0.0;   ///< signed, doubled area in the plane
};

/// Finds the facets with an area in space and in the plane. Their charts are not set, and their corners are vertices of
/// the object.
/// @param extent  size of the picture [m]
/// @throws Error  InvalidInput: there are none
std::vector<Facet> facetsOf(const TexturedMesh& object, Vec2 extent);

}  // namespace droplet
