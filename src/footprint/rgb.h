// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "droplet/footprint/css_colour.h"
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

}  // namespace droplet
