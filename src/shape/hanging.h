// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "shape/constrained.h"
#include "shape/energy.h"
#include "shape/equilibrium.h"

namespace droplet {

/// Critical weight −w of liquid under a ceiling [1/m²]. At this weight a change of the sheet that keeps the volume
/// costs no energy; above it a droplet falls off.
///
/// It is the smallest eigenvalue μ of Kx = μMx among functions without volume; (3.8317/R)² on a disc of radius R.
/// @param op      Hessian of the energy; its mass weight is ignored
/// @param solver  solver for the energy's mesh; afterwards it is prepared for K
double criticalWeight(const Energy& energy, const Operator& op, ConstrainedSolver& solver);

/// Whether droplets at one pressure do not drain into each other: at most one of them is unstable at a constant
/// pressure, and then all together are stable.
/// @param pressure_rises  change of every droplet's pressure per volume gained
bool shareOnePressure(const std::vector<double>& pressure_rises);

/// Critical weight −w of flat droplets at one pressure [1/m²]: above it they drain into each other. Within a
/// thousandth.
/// @param droplets  with solvers, which are prepared for other operators afterwards
double criticalSharedWeight(const std::vector<Member>& droplets);

}  // namespace droplet
