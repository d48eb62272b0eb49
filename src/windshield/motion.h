// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

#include "droplet/vector.h"
#include "droplet/wind/forces.h"
#include "droplet/windshield/parameters.h"

namespace droplet {

/// Length of a vector; faster than std::hypot, which also handles overflow.
inline double sizeOf(Vec2 a)
{
    return std::sqrt(dot(a, a));
}

/// Random acceleration of one droplet at a time [m/s²].
Vec2 fluctuationOf(std::uint64_t id, double time, const Fluctuation& fluctuation, std::uint64_t seed);

/// Displacement of a droplet in a step, and its velocity afterwards.
struct MotionStep {
    Vec2 displacement;
    Vec2 velocity;
};

/// Solves m dv/dt = F − F_k v/|v| − c v over dt with constant F: exact along a line, with friction against the velocity
/// at the end. A droplet that would reverse within dt stops; in the next step it starts again if friction does not hold
/// it.
MotionStep advance(const DropletForces& forces, Vec2 driving, Vec2 velocity, double dt);

}  // namespace droplet
