// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/shape/figures.h"

namespace droplet {

/// Adds what follows from footprint and contact angles, whatever the form of the surface: lengths and angles of the
/// rim, Bond number, and bound of the height.
/// @param contact_angle  at every rim vertex [rad]
/// @param figures        with the footprint's area
void addRimFigures(const PlanarMesh& mesh, const std::vector<double>& contact_angle, const SolveOptions& options,
                   ShapeFigures& figures);

}  // namespace droplet
