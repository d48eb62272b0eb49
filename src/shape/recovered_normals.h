// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/shape/base_surface.h"
#include "droplet/shape/capillary_surface.h"

namespace droplet {

/// Unit normals at the vertices of a surface: inside, means over the triangles around a vertex, weighted by their
/// areas; on the rim, the normal that the contact angle gives.
/// @param ground  under the surface
std::vector<Vec3> recoveredNormals(const CapillarySurface& surface, const BaseSurface& ground);

/// Slope ∂u/∂n of a height field u along the inward normal at every rim vertex, as the contact angle gives it.
std::vector<double> rimSlopes(const CapillarySurface& surface, const BaseSurface& ground);

}  // namespace droplet
