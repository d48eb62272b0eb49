// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/liquid2d/fluid_scene.h"
#include "droplet/vector.h"

namespace droplet {

/// Particles of a 2D liquid at one moment, from any simulation.
/// Invariant: `velocity` and `id` have the size of `position`, `density` has it or is empty; all numbers are finite,
/// spacing > 0, ids are unique.
struct ParticleFrame {
    double time = 0.0;               ///< [s]
    double spacing = 0.0;            ///< distance of neighbours at rest [m]; a particle's area is its square
    std::vector<Vec2> position;      ///< [m], y up
    std::vector<Vec2> velocity;      ///< [m/s]
    std::vector<std::uint32_t> id;   ///< the same for the same particle in every frame; memory
                                     ///< grows with the largest
    std::vector<double> density;     ///< relative to that of the liquid at rest; empty if unknown
    std::vector<Region> walls = {};  ///< at this moment: liquid that lies at them is drawn without a gap

    /// Checks the invariant.
    /// @throws Error InvalidInput, naming the first particle that breaks it
    void validate() const;
};

}  // namespace droplet
