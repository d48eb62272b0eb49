// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// A ball that moves along a line during a step.
struct MovingBall {
    Vec3 from;             ///< [m]
    Vec3 to;               ///< [m]
    double reach = 0.0;    ///< radius [m]; 0: it touches none
    bool changed = false;  ///< false: it was there before, at rest, and has not grown
};

/// Pairs (i, j), i < j, of balls that touch at some time, if they move at constant speed; without pairs of which
/// neither has changed. In ascending order. The work is linear in the number of balls, if few overlap.
std::vector<std::pair<std::uint32_t, std::uint32_t>> touchingPairs(std::span<const MovingBall> balls);

}  // namespace droplet
