// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "droplet/vector.h"

namespace droplet {

/// Smooth random field of unit length: random numbers at the points with integer coordinates, between them a smooth
/// step along each axis. Without a state: a function of place and seed.
/// @return  from −1 to 1, with mean 0
double smoothRandom(Vec3 place, std::uint64_t seed);

}  // namespace droplet
