// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "droplet/mesh/planar_mesh.h"
#include "shape/area_vector.h"

namespace droplet {

/// Carries a sheet to a finer mesh of its footprint: its rim gets the finer one's vertices, and every triangle inside
/// is divided into four, along curves with the sheet's tangents.
///
/// Guarantees: the rim is that of the finer footprint; no triangle has three rim vertices and no edge inside joins two;
/// the topology stays; the same input gives the same bits.
/// @param coarse  footprint of the sheet
/// @param fine    the same one, with shorter edges; its corners may be rounded less, its holes in another order
/// @return        none if the rims do not match
std::optional<CapillarySurface> divide(const CapillarySurface& sheet, const PlanarMesh& coarse, const PlanarMesh& fine);

}  // namespace droplet
