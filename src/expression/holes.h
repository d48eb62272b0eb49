// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "droplet/expression/expression.h"

namespace droplet {

/// Hole that must not close yet, at a frame.
struct OpenHole {
    Vec2 centre;          ///< [m]
    double radius = 0.0;  ///< [m]
};

/// Holes that were drawn too short a time ago to close at the last frame that `state` has seen.
/// @param spacing  of the particles
std::vector<OpenHole> openHoles(const ExpressionState& state, double spacing);

/// Draws a hole as a bay, by its number, and sets its gap; returns whether it can.
using OpenBay = std::function<bool(std::size_t, LiquidHole&)>;

/// Holes of a frame, in the order of their rims, each followed from the holes that `state` remembers.
/// @param rims      clockwise
/// @param open_bay  used for large holes until they have lasted
std::vector<LiquidHole> followedHoles(const std::vector<Loop>& rims, const ExpressionState& state,
                                      const ParticleFrame& frame, const OpenBay& open_bay);

}  // namespace droplet
