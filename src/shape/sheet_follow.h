// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "shape/area_vector.h"
#include "shape/sheet_path.h"

namespace droplet {

/// Moves an equilibrium along with its rim, then fills or drains it to a target, on the same triangles.
///
/// Guarantees: as fillSheet(), where the end is Reached. Otherwise the triangles could not follow.
/// @param first     sheet with the same triangles, as they were made; wear is measured against it
/// @param last      an equilibrium
/// @param pressure  of it, over the surface tension [1/m]
/// @param rim       new places of the rim's vertices [m]
FilledSheet followSheet(const CapillarySurface& first, const CapillarySurface& last, double pressure,
                        const std::vector<Vec2>& rim, const SheetTarget& target, Vec3 weight);

}  // namespace droplet
