// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"

namespace droplet {

/// Thickness at which the amount of a fill that stays below a puddle is reached, if it is one [m]. What the ground is
/// deeper than the rim adds to the puddle, for liquid fills it up.
/// @param footprints  of droplets at one pressure, at least one; the highest of their puddles counts
std::optional<double> maxHeight(const std::vector<const PlanarMesh*>& footprints, const SolveOptions& options);

}  // namespace droplet
