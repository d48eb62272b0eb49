// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/outline/outline.h"

namespace droplet {

/// Smooths loops without shrinking them. Wrinkles as long as a few particles vanish as far as they are no higher than
/// a part of a spacing and of what is thin there, so that corners and tips stay and loops do not cross.
/// @param spacing  of the particles [m]
/// @param fairing  0: not at all … 10
std::vector<Loop> smoothed(std::vector<Loop> loops, double spacing, double fairing);

}  // namespace droplet
