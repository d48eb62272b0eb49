// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace droplet {

/// A time as files tell it: steps add up to whole nanoseconds but for rounding [s].
inline double wholeNanoseconds(double time)
{
    return std::round(1e9 * time) / 1e9;
}

}  // namespace droplet
