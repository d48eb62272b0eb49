// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "fluid_solver.h"

namespace droplet {

/// Particles that carry velocities, and a grid that makes the pressure (APIC, Jiang et al. 2015).
/// @param scene,options  valid; must outlive the solver
std::unique_ptr<FluidSolver> gridLiquid(const FluidScene& scene, const FluidOptions& options);

}  // namespace droplet
