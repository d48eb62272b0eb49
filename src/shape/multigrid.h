// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape/hierarchy.h"
#include "shape/linear_solution.h"

namespace droplet {

/// Solves (K + wM)u = ∫φ by conjugate gradients with one cycle of multigrid as preconditioner.
///
/// Time and memory in proportion to the unknowns. Guarantees: the same bits at any number of threads.
LinearSolution solveByMultigrid(const Hierarchy& hierarchy);

}  // namespace droplet
