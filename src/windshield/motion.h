// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

#include "droplet/vector.h"
#include "droplet/wind/forces.h"
#include "droplet/windshield/parameters.h"

namespace droplet {

/// Without the care for the ends of double's range, where nothing here comes, that std::hypot takes.
inline double sizeOf(Vec2 a)
{
    return std::sqrt(dot(a, a));
}

/// The pushes on one droplet [m/s²].
Vec2 pushOn(std::uint64_t id, double time, const Fluctuation& fluctuation, std::uint64_t seed);

struct Moved {
    Vec2 way;
    Vec2 velocity;
};

/// m dv/dt = F − F_k v/|v| − c v for dt with constant F: exact along a line, friction against the velocity at the end;
/// what would turn around within dt stops, and starts again in the next step if friction does not hold it.
Moved moved(const DropletForces& forces, Vec2 driving, Vec2 velocity, double dt);

}  // namespace droplet
