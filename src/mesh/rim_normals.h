// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Outward unit normals at rim vertices: means over both rim edges, weighted by length.
std::vector<Vec2> rimNormals(const PlanarMesh& mesh);

}  // namespace droplet
