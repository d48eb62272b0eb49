// SPDX-License-Identifier: GPL-3.0-or-later
// G. Sharma, W. Wu, E. N. Dalal, "The CIEDE2000 Color-Difference Formula: Implementation Notes, Supplementary Test
// Data, and Mathematical Observations" (2005).
#pragma once

#include <cmath>

#include "droplet/units.h"
#include "droplet/vector.h"

namespace droplet::testing {

/// Difference of two colours as people see it, CIEDE2000; 1 is just visible.
/// @param first, second  CIE L*a*b* in x, y and z
inline double colourDifference(const Vec3& first, const Vec3& second)
{
    constexpr double kTurn = 360.0;
    const auto seventh = [](double c) {
        return std::sqrt(std::pow(c, 7.0) / (std::pow(c, 7.0) + std::pow(25.0, 7.0)));
    };
    const double mean_chroma = 0.5 * (std::hypot(first.y, first.z) + std::hypot(second.y, second.z));
    const double stretch = 1.5 - 0.5 * seventh(mean_chroma);
    const double c1 = std::hypot(stretch * first.y, first.z);
    const double c2 = std::hypot(stretch * second.y, second.z);
    const auto hue = [&](const Vec3& lab) {
        const double angle = std::atan2(lab.z, stretch * lab.y) / kDegree;
        return angle < 0.0 ? angle + kTurn : angle;
    };
    const double h1 = c1 > 0.0 ? hue(first) : 0.0;
    const double h2 = c2 > 0.0 ? hue(second) : 0.0;
    const bool grey = c1 * c2 == 0.0;
    double dh = grey ? 0.0 : h2 - h1;
    dh += dh > 0.5 * kTurn ? -kTurn : dh < -0.5 * kTurn ? kTurn : 0.0;
    double mean_hue = grey ? h1 + h2 : 0.5 * (h1 + h2);
    if (!grey && std::abs(h1 - h2) > 0.5 * kTurn) {
        mean_hue += h1 + h2 < kTurn ? 0.5 * kTurn : -0.5 * kTurn;
    }
    const auto cosine = [](double degrees) { return std::cos(degrees * kDegree); };
    const double lightness = 0.5 * (first.x + second.x) - 50.0;
    const double chroma = 0.5 * (c1 + c2);
    const double t = 1.0 - 0.17 * cosine(mean_hue - 30.0) + 0.24 * cosine(2.0 * mean_hue) +
                     0.32 * cosine(3.0 * mean_hue + 6.0) - 0.20 * cosine(4.0 * mean_hue - 63.0);
    const double l =
        (second.x - first.x) / (1.0 + 0.015 * lightness * lightness / std::sqrt(20.0 + lightness * lightness));
    const double c = (c2 - c1) / (1.0 + 0.045 * chroma);
    const double h = 2.0 * std::sqrt(c1 * c2) * std::sin(0.5 * dh * kDegree) / (1.0 + 0.015 * chroma * t);
    const double turn = 60.0 * std::exp(-std::pow((mean_hue - 275.0) / 25.0, 2.0));
    const double rotation = -2.0 * seventh(chroma) * std::sin(turn * kDegree);
    return std::sqrt(l * l + c * c + h * h + rotation * c * h);
}

}  // namespace droplet::testing
