// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "droplet/shape/solve.h"
#include "shape/equilibrium.h"

namespace droplet {

/// Result of the search for an equilibrium. If it converged, the sheets hold it.
struct Outcome {
    Termination termination = Termination::NotConverged;
    std::size_t failed_member = 0;
    std::size_t newton_steps = 0;
    std::size_t iterations = 0;
    double residual = 0.0;
    double work = 0.0;                  ///< of the exact model, as SolveOptions::max_work
    double largest_volume = 0.0;        ///< with NoHeightField [m³]
    double bond_number = 0.0;           ///< with Unstable
    double critical_bond_number = 0.0;  ///< with Unstable
};

/// Finds the equilibrium of droplets at one pressure, or shows that there is none.
///
/// The exact model starts from the linear solution. If that fails, or gives a sheet that is upright along a part of its
/// rim, the volume is raised from small values, up to the fill or to the largest volume that exists.
/// @param members  with empty sheets and energies of the linear model
/// @param reached  called with the share of the fill while the volume is raised, which does not fall; may be empty
Outcome findEquilibrium(const std::vector<Member>& members, const SolveOptions& options,
                        const std::function<void(double)>& reached = {});

}  // namespace droplet
