// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "drops.h"

namespace droplet {

/// Finger of water at the crest of a wave that curls over, and the hollow below it.
struct Claw {
    Drop finger;                 ///< its head lies in the crest; it joins the field of the liquid
    Vec2 hollow;                 ///< middle of the hollow [m]
    double hollow_radius = 0.0;  ///< [m]
};

/// Claws of the last frame that `state` has seen.
std::vector<Claw> clawsOf(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options);

}  // namespace droplet
