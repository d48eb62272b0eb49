// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/liquid2d/particle_frame.h"
#include "field.h"

namespace droplet {

/// What drives the air of particles, in the order of the frame.
struct Aeration {
    std::vector<float> entry;    ///< criterion, after M. Ihmsen et al., "Unified spray, foam and air bubbles" (2012)
    std::vector<float> release;  ///< 0 … 1: the more, the calmer and deeper
    double largest = 0.0;        ///< of `entry`
};

/// @param gated  air enters at crests alone
Aeration aerationOf(const ParticleFrame& frame, const ParticleCells& cells, const Coverage& coverage, bool gated);

}  // namespace droplet
