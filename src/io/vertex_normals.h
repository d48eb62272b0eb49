// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// The first of all vertices at the same place, for each vertex.
std::vector<std::uint32_t> firstAtPlace(const std::vector<Vec3>& positions);

/// Brings normals to length 1; those of no length become those of the triangles around their place, weighted by their
/// angles there, copies of a place counted as one.
/// @param place    firstAtPlace(positions)
/// @param normals  as many as positions
void fillNormals(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles,
                 const std::vector<std::uint32_t>& place, std::vector<Vec3>& normals);

}  // namespace droplet
