// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "outline/slot.h"

namespace droplet {

/// Options of fair().
struct FairingOptions {
    std::vector<std::uint8_t> breaks;  ///< one flag per slot: 1 if the curve may turn sharply between this slot and the
                                       ///< next; empty for no breaks

    /// Weight of ∫ (dκ/ds)² ds [px³]. A wave of wavenumber k costs fairness·k⁶ per unit of length. To leave the middle
    /// of the slot in a hard mask costs about 11. So waves shorter than 2π(fairness/11)^(1/6) ≈ 34 px are faired, and
    /// longer ones are kept as shape. A tenth of this weight doubles the error of the normals of a hard disc of 100 px
    /// (to 0.8°); ten times as much doubles the error of its area (to 3e-4).
    double fairness = 3e5;
};

/// Moves every vertex of a loop within its slot so that curvature varies least.
///
/// Lines and circular arcs cost nothing. In an anti-aliased mask, the measured places act against fairness; in a hard
/// mask, a barrier keeps vertices off the pixel centres. Linear in the number of slots.
void fair(SlotLoop& loop, const FairingOptions& options = {});

/// Cost of a curve in each slot: variation of curvature around it, and improbability of the slot's place. Near zero on
/// lines and arcs; large where a smooth curve had to be forced round a corner.
std::vector<double> strain(const SlotLoop& loop, const FairingOptions& options = {});

}  // namespace droplet
