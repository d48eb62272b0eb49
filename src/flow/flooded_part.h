// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace droplet {

/// Part of a face below a level, seen from above.
struct Flooded {
    double area = 0.0;
    double volume = 0.0;
};

/// @param h      heights of the corners, ascending
/// @param area   of the face seen from above; negative where it overhangs
/// @param level  of the liquid
inline Flooded floodedPart(const std::array<double, 3>& h, double area, double level)
{
    const double mean = (h[0] + h[1] + h[2]) / 3.0;
    if (level >= h[2]) {
        return {area, area * (level - mean)};
    }
    if (level <= h[0]) {
        return {};
    }
    if (level <= h[1]) {
        const double part = area * (level - h[0]) * (level - h[0]) / ((h[1] - h[0]) * (h[2] - h[0]));
        return {part, part * (level - h[0]) / 3.0};
    }
    const double dry = area * (h[2] - level) * (h[2] - level) / ((h[2] - h[0]) * (h[2] - h[1]));
    return {area - dry, area * (level - mean) + dry * (h[2] - level) / 3.0};
}

}  // namespace droplet
