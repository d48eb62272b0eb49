// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesh/rim_sampling.h"

namespace droplet {

/// Places points inside polygons as corners of squares that follow the rim: triangles between them come in pairs.
/// @param polygons  outer counter-clockwise, holes clockwise, not crossing
/// @param edge      longest side of a square [m]; sides are as short as the rim's edges where these are shorter
/// @return          points, all different, clear of the rim
std::vector<Vec2> alignedPoints(const std::vector<RimPolygon>& polygons, double edge);

}  // namespace droplet
