// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Gradients at vertices, of the piecewise linear function with these values: area-weighted means over the triangles
/// around every vertex.
std::vector<Vec2> recoveredGradients(const PlanarMesh& mesh, const std::vector<double>& values);

}  // namespace droplet
