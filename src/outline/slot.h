// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Grid edge between a liquid and a dry pixel centre that a rim crosses. A traced vertex can only move along its slot.
///
/// Wherever the vertices are in their slots, the polygon through them separates the same pixel centres. So it cannot
/// cross itself or another loop. Pixels, y down, pixel centres at half-integers.
struct Slot {
    Vec2 liquid;                     ///< centre of the liquid pixel
    Vec2 toward;                     ///< unit step to the centre of the dry pixel
    double t = 0.5;                  ///< place of the crossing between the two, in (kSlotMargin, 1 − kSlotMargin)
    std::optional<double> measured;  ///< place measured from grey levels; empty in a hard mask
    double spread = 0.0;             ///< standard deviation of `measured`

    [[nodiscard]] Vec2 point() const { return liquid + t * toward; }
};

/// Distance of vertices from pixel centres, so that vertices of two slots do not coincide there.
inline constexpr double kSlotMargin = 0.02;

/// Traced loop: slots in order, liquid on the left when y is up.
using SlotLoop = std::vector<Slot>;

}  // namespace droplet
