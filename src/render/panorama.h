// SPDX-License-Identifier: GPL-3.0-or-later
// Look-up of an environment by direction: x toward its right, y toward its middle, z up.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "droplet/render/environment.h"
#include "render/optics.h"

namespace droplet {

/// Place in an environment's picture, from 0 to 1: longitude from the left edge, latitude from the top.
struct PanoramaPlace {
    double across = 0.0;
    double down = 0.0;
};

/// Place of a direction.
/// @param direction  unit
inline PanoramaPlace placeOnPanorama(Vec3f direction)
{
    constexpr double kPi = std::numbers::pi;
    return {std::atan2(static_cast<double>(direction.x), static_cast<double>(direction.y)) / (2.0 * kPi) + 0.5,
            0.5 - std::asin(std::clamp(static_cast<double>(direction.z), -1.0, 1.0)) / kPi};
}

/// Direction of a place.
inline Vec3f directionOf(PanoramaPlace place)
{
    constexpr double kPi = std::numbers::pi;
    const double longitude = 2.0 * kPi * (place.across - 0.5);
    const double latitude = kPi * (0.5 - place.down);
    return toFloats(
        {std::cos(latitude) * std::sin(longitude), std::cos(latitude) * std::cos(longitude), std::sin(latitude)});
}

inline Vec3f radianceAt(const Environment& environment, int column, int row)
{
    const auto& [x, y, z] =
        environment.radiance[static_cast<std::size_t>(row) * static_cast<std::size_t>(environment.width) +
                             static_cast<std::size_t>(column)];
    return {x, y, z};
}

/// Radiance from a direction, linear between pixels.
/// @param direction  unit
inline Vec3f radianceFrom(const Environment& environment, Vec3f direction)
{
    const auto [across, down] = placeOnPanorama(direction);
    const double x = across * environment.width - 0.5;
    const double y = std::clamp(down * environment.height - 0.5, 0.0, environment.height - 1.0);
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(y);
    const int below = std::min(top + 1, environment.height - 1);
    const auto wrapped = [&](int column) { return (column + environment.width) % environment.width; };
    const auto fx = static_cast<float>(x - left);
    const auto fy = static_cast<float>(y - top);
    const auto row = [&](int r) {
        return mix(radianceAt(environment, wrapped(left), r), radianceAt(environment, wrapped(left + 1), r), fx);
    };
    return mix(row(top), row(below), fy);
}

}  // namespace droplet
