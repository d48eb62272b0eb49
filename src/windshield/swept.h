// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "droplet/vector.h"
#include "windshield/still_droplets.h"

namespace droplet {

/// Piece of a track, with the running droplet that absorbs the water on it.
struct SweptPiece {
    std::uint32_t owner = 0;
    Vec2 from;
    Vec2 to;
    double reach = 0.0;
};

/// Still droplet that touches a piece.
struct SweptDroplet {
    std::uint32_t owner = 0;
    StillSlot still;
};

/// Finds still droplets that touch pieces, in the pieces' order; a droplet that touches several appears several times.
std::vector<SweptDroplet> sweptBy(std::span<const SweptPiece> pieces, const StillCells& still, const StillRules& rules);

}  // namespace droplet
