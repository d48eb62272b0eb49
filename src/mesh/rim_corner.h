// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "droplet/vector.h"

namespace droplet {

/// Turn of the rim at a vertex from which on it is a corner, and not a part of an arc [rad].
inline constexpr double kCorner = 0.5;

/// Turn from one side of a rim to the next, to the left if positive [rad].
inline double turnBetween(Vec2 in, Vec2 out)
{
    return std::atan2(cross(in, out), dot(in, out));
}

}  // namespace droplet
