// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

/// Way of a droplet, over its width, until the film on it has become beads. A thread of liquid breaks up in some
/// √(ρ w³/σ), 10 ms for 2 mm, on dry glass; on real one its sides stick, and behind raindrops on windows the wet tail
/// is five to ten droplets long.
inline constexpr double kBreakUpWay = 6.0;

}  // namespace droplet
