// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "droplet/image/css_colour.h"
#include "droplet/vector.h"

namespace droplet {

/// Levels of red, green and blue in sRGB.
using Rgb = std::array<std::uint8_t, 3>;

inline Vec3 vectorOf(const Rgb& colour)
{
    return {static_cast<double>(colour[0]), static_cast<double>(colour[1]), static_cast<double>(colour[2])};
}

inline Vec3 vectorOf(const CssColour& colour)
{
    return vectorOf(Rgb{colour.red, colour.green, colour.blue});
}

/// Linear light, 0 … 1, of levels of sRGB (IEC 61966-2-1).
/// @param levels  0 … 255
inline Vec3 linearLight(Vec3 levels)
{
    const auto light = [](double level) {
        const double share = level / 255.0;
        return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    };
    return {light(levels.x), light(levels.y), light(levels.z)};
}

/// Nearest levels of sRGB of linear light. What is below 0 or above 1 counts as that.
inline Rgb levelsOf(Vec3 light)
{
    const auto level = [](double one) {
        const double share = one <= 0.0031308 ? 12.92 * std::max(one, 0.0) : 1.055 * std::pow(one, 1.0 / 2.4) - 0.055;
        return static_cast<std::uint8_t>(std::lround(255.0 * std::min(share, 1.0)));
    };
    return {level(light.x), level(light.y), level(light.z)};
}

/// CIE L*a*b* of levels of sRGB in x, y and z, with the white of D65.
/// @param levels  0 … 255
inline Vec3 labOf(Vec3 levels)
{
    const auto [r, g, b] = linearLight(levels);
    const auto f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
    const double x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
    const double y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
    const double z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

}  // namespace droplet
