// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace droplet {

/// Time as written to files: rounded to whole nanoseconds, which removes the rounding errors of added steps [s].
inline double roundedTime(double time)
{
    return std::round(1e9 * time) / 1e9;
}

}  // namespace droplet
