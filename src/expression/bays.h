// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/liquid2d/particle_frame.h"
#include "droplet/outline/outline.h"

namespace droplet {

/// Thin place between a hole and the outline around it.
struct Bridge {
    std::size_t outline = 0;     ///< among those that were searched
    std::size_t at_hole = 0;     ///< point of the hole
    std::size_t at_outline = 0;  ///< point of the outline
    double thickness = 0.0;      ///< [m]
    Vec2 middle;                 ///< [m]
};

/// Bridges between a hole and outlines that are so thin that they may break at once: first those where the liquid on
/// both sides has just met, or those nearest to an earlier gap; others than these have no part then.
/// @param rims  a hole is clockwise, outlines are the others
std::vector<Bridge> bridgesOf(const Loop& hole, const std::vector<Loop>& rims, const ParticleFrame& frame,
                              std::optional<Vec2> gap);

/// Outline whose hole is open at a bridge, by a gap with round ends; nothing if the gap would cut something else.
std::optional<Loop> withBay(const std::vector<Loop>& rims, const Loop& hole, const Bridge& bridge, double spacing);

}  // namespace droplet
