// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// Continues values on the rim of a mesh inside, harmonically: by linear finite elements, whose matrix is the cotangent
/// Laplacian (U. Pinkall, K. Polthier, "Computing discrete minimal surfaces and their conjugates", 1993). Values that
/// are affine in place on a plane are continued so.
/// @param vertices   places [m]; those of the rim first
/// @param triangles  on these, with an area
/// @param rim        two values for every vertex of the rim, a row each
/// @return           of the vertices inside, in their order
Eigen::MatrixX2d harmonic(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                          const Eigen::MatrixX2d& rim);

}  // namespace droplet
