// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/surface/textured_mesh.h"
#include "surface/facets.h"

namespace droplet {

/// Joins facets into charts across edges that agree in space and in uv, if both facets face the same way. Sets the
/// corners of facets to corners of charts: one for every place in space and uv.
/// @return  facing of every chart: 1, or −1 if it mirrors the picture
std::vector<double> joinCharts(const TexturedMesh& object, std::vector<Facet>& facets);

/// Texture coordinates that are equal where vertices at one place differ in their last bits, as single-precision sums
/// leave them: such an edge is no seam.
std::vector<Vec2> joinedUvs(const TexturedMesh& object);

}  // namespace droplet
