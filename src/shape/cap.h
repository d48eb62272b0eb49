// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace droplet {

// A spherical cap with the contact angle θ on a disc of radius 1 has the height t = tan θ/2 and the volume πt(3 +
// t²)/6. The linear model's paraboloid of this volume has the slope 2t(3 + t²)/3 at the rim.

/// Contact angle of the linear model with the volume of a cap [rad].
inline double linearAngleOfCap(double angle)
{
    const double t = std::tan(0.5 * angle);
    return std::atan(2.0 / 3.0 * t * (3.0 + t * t));
}

/// Contact angle of a cap with the volume of the linear model [rad].
inline double capAngleOfLinear(double linear_angle)
{
    // t³ + 3t = 3/2 tan(linear_angle) has one real root.
    const double t = 2.0 * std::sinh(std::asinh(0.75 * std::tan(linear_angle)) / 3.0);
    return 2.0 * std::atan(t);
}

}  // namespace droplet
