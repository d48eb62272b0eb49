// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace droplet {

// A cap of contact angle θ on a disc of radius 1 is t = tan θ/2 high and holds πt(3 + t²)/6. The linear model's
// paraboloid of that volume leaves the rim at a slope of 2t(3 + t²)/3.

/// The linear model's angle at which it holds what a cap of an angle does [rad].
inline double linearAngleOfCap(double angle)
{
    const double t = std::tan(0.5 * angle);
    return std::atan(2.0 / 3.0 * t * (3.0 + t * t));
}

/// A cap's angle where the linear model of its volume has one [rad].
inline double capAngleOfLinear(double linear_angle)
{
    // t³ + 3t = 3/2 tan of it has one real root.
    const double t = 2.0 * std::sinh(std::asinh(0.75 * std::tan(linear_angle)) / 3.0);
    return 2.0 * std::atan(t);
}

}  // namespace droplet
