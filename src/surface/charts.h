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

}  // namespace droplet
