// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "body/body_grid.h"
#include "droplet/vector.h"

namespace droplet {

/// Rim of the footprint of a droplet that runs to +x: a circle at elongation 0; a round head and a tapering tail
/// above. It is convex. The origin is in the middle of its widest place.
/// @param elongation  0 … 1
/// @return            points of the slices; the polygon has the area of the regular one of radius 1
std::array<Vec2, kBodySlices> runningFootprint(double elongation);

}  // namespace droplet
