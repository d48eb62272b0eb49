// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace droplet {

/// Value of the field at the rim of liquid.
inline constexpr float kIsoValue = 0.5F;
inline constexpr double kIso = 0.5;
/// Air, in areas of a particle, over which a particle turns from water to an eraser.
inline constexpr double kEraserFade = 0.25;
/// Integral over the plane of the kernel of support 1.
inline constexpr double kKernelIntegral = 0.3 * std::numbers::pi;
/// Radius of a disc of a particle's area, in spacings.
inline constexpr double kParticleRadius = 0.5641895835477563;

/// 1 − 3t² + 2t³, up to t = 1.
/// @param t  number, or an array of Eigen that lives as long as the result
template <typename Numbers>
auto surfaceKernelWithin(const Numbers& t)
{
    return 1.0F - t * t * (3.0F - 2.0F * t);
}

/// The same, 0 beyond t = 1.
inline float surfaceKernel(float t)
{
    return surfaceKernelWithin(std::min(t, 1.0F));
}

/// From 0 at or before `begin` to 1 at or after `end`, without a kink. `begin` may be the larger one.
inline double smoothRamp(double value, double begin, double end)
{
    const double t = std::clamp((value - begin) / (end - begin), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace droplet
