// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "bezier.h"

namespace droplet {

/// Width of a line over the thickness of what it surrounds, at most.
inline constexpr double kLineShare = 0.35;

/// Lines along outlines as a brush draws them: of even width, but thinner along threads and narrow gaps, and thinning
/// out at tips.
///
/// Guarantees: a line is centred on its outline and no wider than `width`, nor than kLineShare of the distance across
/// the liquid, or across its hole, at that place. Twice as much of a gap between two bodies may be line.
/// @param outlines  of liquid and of its holes, in pixels, y down; liquid lies on their left on the screen
/// @param width     > 0
/// @return          for each outline its outer and its inner edge, in opposite directions: paths to be filled with the
///                  nonzero rule
std::vector<BezierPath> brushLines(const std::vector<BezierPath>& outlines, double width);

}  // namespace droplet
