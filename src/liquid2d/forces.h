// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "droplet/liquid2d/fluid.h"
#include "kernel.h"
#include "neighbours.h"

namespace droplet {

/// Adds the accelerations of viscosity, which keep momentum and angular momentum.
/// @param viscosity  kinematic [m²/s]
void addViscosity(std::span<Vec2> acceleration, const FluidState& state, const Neighbourhood& near, double viscosity);

/// Surface tension of particles.
struct SurfaceTension {
    double over_density = 0.0;  ///< surface tension over density [m³/s²]
    double spacing = 0.0;       ///< of particles at rest [m]
};

/// Adds the accelerations of surface tension.
/// @param cells  of the positions
void addSurfaceTension(std::span<Vec2> acceleration, std::span<const Vec2> position, const CellGrid& cells,
                       const SurfaceTension& tension);

}  // namespace droplet
