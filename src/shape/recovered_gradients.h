// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Area-weighted means of the gradients on the triangles around every vertex, of what is linear between values at the
/// vertices.
std::vector<Vec2> recoveredGradients(const PlanarMesh& mesh, const std::vector<double>& values);

}  // namespace droplet
