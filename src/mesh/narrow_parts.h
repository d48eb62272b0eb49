// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Area of the parts of a footprint in which no disc has room: what a morphological opening by the disc takes away.
/// Pieces that are less than twice as long as the disc is wide do not count, as the points of corners; a footprint with
/// room for no disc at all counts as a whole [m²].
/// @param footprint  its loops alone are used
/// @param diameter   of the disc, > 0 [m]
double narrowArea(const PlanarMesh& footprint, double diameter);

}  // namespace droplet
