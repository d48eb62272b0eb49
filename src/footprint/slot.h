// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Where a rim crosses the grid edge between a liquid and a dry pixel centre: the one freedom a traced vertex has.
///
/// However the vertices move in their slots, the polygon through them separates the same pixel centres, so it cannot
/// cross itself or another loop. Pixels, y down, pixel centres at half-integers.
struct Slot {
    Vec2 liquid;                     ///< the liquid pixel's centre
    Vec2 toward;                     ///< unit step to the dry pixel's centre
    double t = 0.5;                  ///< place of the crossing between the two, in (kSlotMargin, 1 − kSlotMargin)
    std::optional<double> measured;  ///< place read off the grey levels; none in a hard mask
    double spread = 0.0;             ///< standard deviation of `measured`

    [[nodiscard]] Vec2 point() const { return liquid + t * toward; }
};

/// Vertices keep this far from pixel centres, so that no two slots' vertices coincide at one.
inline constexpr double kSlotMargin = 0.02;

/// A traced loop: slots in order, liquid on the left when y is up.
using SlotLoop = std::vector<Slot>;

}  // namespace droplet
