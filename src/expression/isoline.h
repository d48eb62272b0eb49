// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/footprint/outline.h"
#include "field.h"

namespace droplet {

/// Loops around the liquid by marching squares: liquid on their left, closed, without crossings.
/// @param spacing  of the particles [m]
std::vector<Loop> isolines(const SurfaceField& field, double spacing);

}  // namespace droplet
