// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace droplet {

/// Round droplet at rest on level ground, in units of the capillary length.
struct AxialDroplet {
    double volume = 0.0;
    double height = 0.0;
    double contact_radius = 0.0;
};

/// Round droplets with rising volume, from small ones to puddles, or to the largest that hang stably.
/// @param contact_angle  θ, in (0, π) [rad]
/// @param hangs          true: under a ceiling
std::vector<AxialDroplet> axialDroplets(double contact_angle, bool hangs);

}  // namespace droplet
