// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/liquid2d/particle_frame.h"
#include "liquid2d/cell_grid.h"

namespace droplet {

/// What lies around each particle of a frame.
struct Surroundings {
    std::vector<double> coverage;     ///< sum over the kernel, itself included; 1 on the lattice at rest
    std::vector<Vec2> outward;        ///< gradient towards fewer particles, times the spacing
    std::vector<double> churn;        ///< how particles around approach or leave it (Ihmsen et al. 2012) [1/s]
    std::vector<std::uint32_t> body;  ///< of connected particles: its smallest index
    std::vector<std::uint32_t> size;  ///< number of particles in the body

    /// Coverage of a particle without neighbours.
    static double alone();
};

/// @param below  coverage, outward and churn are those of particles whose density is below this, or is unknown; 0: of
///               none, the others have zeros
/// @throws Error InvalidInput if the particles are spread over more than 10⁸ cells
Surroundings surroundingsOf(const ParticleFrame& frame, double below);

}  // namespace droplet
