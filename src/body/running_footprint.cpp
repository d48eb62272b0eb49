// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/running_footprint.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace droplet {
namespace {

constexpr double kTail = 1.7;   ///< how far the tail is drawn out, over the radius of the head
constexpr double kTaper = 0.5;  ///< how much narrower its end is

}  // namespace

std::array<Vec2, kBodySlices> runningFootprint(double elongation)
{
    // u runs from 0 at the tip of the head to 1 at the end of the tail. The head keeps the curvature of the circle.
    std::array<Vec2, kBodySlices> rim;
    for (std::size_t j = 0; j < kBodySlices; ++j) {
        const std::size_t mirrored = j <= kBodySlices / 2 ? j : kBodySlices - j;
        const double around = 2.0 * std::numbers::pi / static_cast<double>(kBodySlices) * static_cast<double>(mirrored);
        const double u = 0.5 * (1.0 - std::cos(around));
        const double sine = mirrored == 0 || 2 * mirrored == kBodySlices ? 0.0 : std::sin(around);
        const double half_width = sine * (1.0 - kTaper * elongation * u);
        rim[j] = {1.0 - 2.0 * u - kTail * elongation * u * u, mirrored == j ? half_width : -half_width};
    }
    double twice_area = 0.0;
    for (std::size_t j = 0; j < kBodySlices; ++j) {
        twice_area += cross(rim[j], rim[(j + 1) % kBodySlices]);
    }
    // The width is largest where u (1 − u) (1 − a u)² is: 4 a u² − (2 + 3 a) u + 1 = 0.
    const double a = kTaper * elongation;
    const double u = 2.0 / (2.0 + 3.0 * a + std::sqrt((2.0 + 3.0 * a) * (2.0 + 3.0 * a) - 16.0 * a));
    const double widest = 1.0 - 2.0 * u - kTail * elongation * u * u;
    constexpr auto kCount = static_cast<double>(kBodySlices);
    const double scale = std::sqrt(kCount * std::sin(2.0 * std::numbers::pi / kCount) / twice_area);
    for (Vec2& point : rim) {
        point = {scale * (point.x - widest), scale * point.y};
    }
    return rim;
}

}  // namespace droplet
