// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Unit normals of the rim's two edges at every rim vertex, outward from the liquid, averaged by length.
std::vector<Vec2> rimNormals(const PlanarMesh& mesh);

}  // namespace droplet
