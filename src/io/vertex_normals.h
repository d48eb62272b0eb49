// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// For each vertex, the index of the first vertex at the same place.
std::vector<std::uint32_t> firstAtPlace(const std::vector<Vec3>& vertices);

/// Normalises normals. A zero normal is replaced by the mean over the triangles around its place, weighted by their
/// angles there; copies of a vertex share one mean.
/// @param place    firstAtPlace(vertices)
/// @param normals  one per position
void fillNormals(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                 const std::vector<std::uint32_t>& place, std::vector<Vec3>& normals);

}  // namespace droplet
