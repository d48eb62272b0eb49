// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "render/ray_tracer.h"

namespace droplet {

/// Number of values of a triangle's grid, as StandWater has it.
/// @param divisions  0: none
std::size_t gridValues(std::size_t divisions);

/// Value at a place, and its increase by a cell of the grid.
struct GridValue {
    float here = 0.0F;
    float along_u = 0.0F;
    float along_v = 0.0F;
};

/// Linear interpolation on a triangle's grid.
/// @param values     the triangle's first value
/// @param divisions  n > 0
/// @param meeting    on the triangle
GridValue onGrid(const float* values, int divisions, const Meeting& meeting);

}  // namespace droplet
