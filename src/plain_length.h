// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "droplet/vector.h"

namespace droplet {

/// Length of a vector whose square is neither too small nor too large for a number: length() takes three times as long.
inline double plainLength(Vec2 a)
{
    return std::sqrt(dot(a, a));
}

}  // namespace droplet
