// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "footprint/slot.h"

namespace droplet {

/// How a loop is faired.
struct FairingOptions {
    std::vector<std::uint8_t> breaks;  ///< one flag per slot, 1 where the curve may turn sharply between this slot and
                                       ///< the next; empty for none

    /// Weight of ∫ (dκ/ds)² ds [px³]. A wave of wavenumber k costs fairness·k⁶ per unit of length against about 11 for
    /// leaving the middle of its slot in a hard mask: waves shorter than 2π(fairness/11)^(1/6) ≈ 34 px are faired,
    /// longer ones are shape. A tenth of it leaves a hard disc of 100 px twice the error in its normals (0.8°), ten
    /// times as much twice the error in its area (3e-4).
    double fairness = 3e5;
};

/// Moves every vertex of a loop within its slot so that curvature varies least.
///
/// Lines and circular arcs are free; what pulls against fairness is the measured place in an anti-aliased mask, and
/// in a hard one a barrier that keeps vertices off the pixel centres. Linear in the number of slots.
void fair(SlotLoop& loop, const FairingOptions& options = {});

/// The cost of a curve, slot by slot: variation of curvature around it, and the unlikeliness of the slot's place. Near
/// zero on lines and arcs, large where a smooth curve had to be forced round a corner.
std::vector<double> strain(const SlotLoop& loop, const FairingOptions& options = {});

}  // namespace droplet
