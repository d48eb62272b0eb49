// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "droplet/vector.h"
#include "windshield/still_droplets.h"

namespace droplet {

/// A piece of a track, and which running droplet gathers its water.
struct SweptPiece {
    std::uint32_t owner = 0;
    Vec2 from;
    Vec2 to;
    double reach = 0.0;
};

/// A still droplet that touches a piece.
struct SweptDroplet {
    std::uint32_t owner = 0;
    StillSlot still;
};

/// Still droplets that touch pieces, in the pieces' order; those that touch several are in it several times.
std::vector<SweptDroplet> sweptBy(std::span<const SweptPiece> pieces, const StillCells& still, const StillRules& rules);

}  // namespace droplet
