// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "droplet/flow/flow_droplet.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/vector.h"
#include "flow/landing.h"

namespace droplet {

/// What acts on one droplet, as far as it is its own.
struct WalkForces {
    Vec3 acceleration;           ///< of gravity and wind [m/s²]
    Vec3 fall;                   ///< acceleration in the air [m/s²]
    double decay = 0.0;          ///< viscous friction over mass, |k_f|/m [1/s], ≥ 0
    double smoothness = 1.0;     ///< 1 − k_r: what roughness leaves of the force, from 0 to 1
    double retention = 0.0;      ///< acceleration up to which hysteresis holds a droplet at rest [m/s²], ≥ 0
    double sliding = 0.0;        ///< part of it that still acts while it moves, against its velocity [m/s²], ≥ 0
    double adhesion = 0.0;       ///< normal acceleration up to which it adheres, D π r²/m [m/s²], ≥ 0
    double contact_width = 0.0;  ///< diameter of its contact circle [m], > 0
};

/// Events of walking.
struct WalkCounts {
    std::uint64_t crossings = 0;  ///< of edges
    std::uint64_t launches = 0;   ///< from the surface into the air
    std::uint64_t landings = 0;
    std::uint64_t stuck = 0;  ///< droplets that were stopped, as they met events without end at one time
};

/// Moves a droplet along the surface, and through the air, until a time. The path depends on neither that time nor how
/// often the function is called.
///
/// @param landing  of the same surface
/// @param droplet  its leg began at `until` or before
/// @param until    [s]
WalkCounts walk(const FlowSurface& surface, const Landing& landing, const WalkForces& forces, FlowDroplet& droplet,
                double until);

/// Puts a droplet onto a face, at rest or moving; its velocity loses what is normal to the face.
/// @param place  on the face [m]
void putOnFace(const FlowSurface& surface, const WalkForces& forces, FlowDroplet& droplet, std::uint32_t face,
               double time, Vec3 place, Vec3 velocity);

}  // namespace droplet
