// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape/constrained.h"
#include "shape/energy.h"

namespace droplet {

/// The weight −w of liquid under a ceiling beyond which a droplet falls off [1/m²]: where some change of its sheet that
/// keeps the volume takes no energy.
///
/// It is the smallest eigenvalue μ of Kx = μMx among functions without volume; on a disc of radius R, (3.8317/R)².
/// @param op      the energy's Hessian; its mass weight does not count
/// @param solver  of the energy's mesh; left prepared for K
double criticalWeight(const Energy& energy, const Operator& op, ConstrainedSolver& solver);

}  // namespace droplet
