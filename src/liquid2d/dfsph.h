// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "fluid_solver.h"

namespace droplet {

/// Divergence-free SPH (Bender and Koschier 2017).
/// @param scene,options  valid; must outlive the solver
std::unique_ptr<FluidSolver> dfsph(const FluidScene& scene, const FluidOptions& options);

}  // namespace droplet
