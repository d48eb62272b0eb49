// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Smooths a closed polyline without shrinking it: bends shorter than a few points vanish.
/// @param rounds  number of passes, ≥ 0
std::vector<Vec2> smoothed(std::vector<Vec2> points, int rounds);

}  // namespace droplet
