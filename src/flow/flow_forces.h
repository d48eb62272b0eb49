// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/flow/flow.h"
#include "flow/walk.h"

namespace droplet {

/// Accelerations in the object's frame, for all droplets.
struct FlowField {
    Vec3 gravity;  ///< [m/s²]
    Vec3 wind;     ///< [m/s]
};

/// Gravity and wind at a time.
FlowField fieldAt(const FlowParameters& parameters, double time);

/// What acts on a droplet.
/// @param moves  empty if the object rests; else the time, for the apparent acceleration [s]
WalkForces forcesOn(const FlowParameters& parameters, const FlowField& field, const FlowDroplet& droplet,
                    std::optional<double> moves);

/// Radius of the contact circle of a droplet on a face [m].
double contactRadius(const FlowParameters& parameters, std::uint32_t face, double volume);

}  // namespace droplet
