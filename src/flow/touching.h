// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
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

/// Pairs (i, j), i < j, that connect all balls that touch at some time, if they move at constant speed. Two balls of
/// which neither has changed do not count as touching. In ascending order.
///
/// Of balls that lie on one another there are no more pairs than connect them, so the work is about linear in the
/// number of balls, however many overlap.
/// @param may_join  whether two balls that touch count; called by many threads
std::vector<std::pair<std::uint32_t, std::uint32_t>> connectingPairs(
    std::span<const MovingBall> balls, const std::function<bool(std::uint32_t, std::uint32_t)>& may_join);

}  // namespace droplet
