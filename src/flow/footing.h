// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "droplet/flow/flow_terrain.h"
#include "droplet/vector.h"

namespace droplet {

/// Whether a droplet at rest can have its contact line where its contact circle is.
/// @param point   below the middle of the droplet
/// @param radius  of the contact circle [m], > 0
/// @return        empty if it can; otherwise the middle of the part of the circle that is on its side of the edge, or
///                before the end of the surface
std::optional<Vec3> awayFromEdge(const FlowTerrain& terrain, const FlowTerrain::Point& point, double radius);

}  // namespace droplet
