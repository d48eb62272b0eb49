// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "grid_shape.h"

namespace droplet {

/// Velocities on the sides of a grid's cells that viscosity changes.
struct ViscousSides {
    std::vector<double>& across;  ///< along x, on the left sides of cells, row by row: one more than cells
    std::vector<double>& up;      ///< along y, on their lower sides
    const std::vector<std::uint8_t>& has_across;  ///< whether there is liquid at a side
    const std::vector<std::uint8_t>& has_up;
    const std::vector<double>& filled;  ///< part of each cell that is liquid
};

/// Lets viscosity act for a step.
/// @param rate  kinematic viscosity times the step over the square of a cell's side
void applyViscosity(const GridShape& grid, double rate, const ViscousSides& sides);

}  // namespace droplet
