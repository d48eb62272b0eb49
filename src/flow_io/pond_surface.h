// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "droplet/flow/flow_surface.h"
#include "droplet/flow/pond.h"
#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// Closed mesh of a pond.
struct PondSurface {
    std::vector<Vec3> vertices;       ///< [m]; first those of its level, of these first the rim's
    std::vector<Vec3> normals;        ///< unit, outward
    std::vector<Triangle> triangles;  ///< first those of its level
    std::vector<std::uint32_t> weld;  ///< smallest index of a vertex at the same place
    std::size_t level_vertices = 0;   ///< number
    std::size_t level_triangles = 0;  ///< number
    std::vector<std::uint32_t>
        after;  ///< for every vertex of the rim, the next one, counter-clockwise around the liquid
};

/// Makes the mesh of a pond: its level or dome, and the ground below, cut off where it rises over the level. Both meet
/// in one rim, of any form, with islands. The volume is that of the pond, to rounding.
/// @param ground  the faces that the pond wets
/// @param pond    its level
PondSurface pondSurface(std::span<const FlowSurface::Face> ground, const Pond& pond);

/// The same on a whole surface.
PondSurface pondSurface(const FlowSurface& surface, const Pond& pond);

}  // namespace droplet
