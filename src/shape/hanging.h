// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape/constrained.h"
#include "shape/energy.h"

namespace droplet {

/// Critical weight −w of liquid under a ceiling [1/m²]. At this weight a change of the sheet that keeps the volume
/// costs no energy; above it a droplet falls off.
///
/// It is the smallest eigenvalue μ of Kx = μMx among functions without volume; (3.8317/R)² on a disc of radius R.
/// @param op      Hessian of the energy; its mass weight is ignored
/// @param solver  solver for the energy's mesh; afterwards it is prepared for K
double criticalWeight(const Energy& energy, const Operator& op, ConstrainedSolver& solver);

}  // namespace droplet
