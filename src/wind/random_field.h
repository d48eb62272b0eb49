// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "droplet/vector.h"

namespace droplet {

/// Standard deviation of smoothRandom(), of eight uniform numbers that are weighted by smooth steps:
/// (2 · 13/35)^(3/2) / √3.
inline constexpr double kSmoothRandomDeviation = 0.3697;

/// Smooth random field of unit length: random numbers at the points with integer coordinates, between them a smooth
/// step along each axis. Without a state: a function of place and seed.
/// @return  from −1 to 1, with mean 0 and kSmoothRandomDeviation
double smoothRandom(Vec3 place, std::uint64_t seed);

}  // namespace droplet
