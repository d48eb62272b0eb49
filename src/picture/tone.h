// SPDX-License-Identifier: GPL-3.0-or-later
// IEC 61966-2-1: sRGB, by tables.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "picture/ground.h"

namespace droplet {

/// Linear light of every sRGB level.
inline const std::array<float, 256>& displayLevels()
{
    static const std::array<float, 256> levels = [] {
        std::array<float, 256> made{};
        for (std::size_t i = 0; i < made.size(); ++i) {
            made[i] = toLinear(static_cast<float>(i) / 255.0F);
        }
        return made;
    }();
    return levels;
}

/// The nearest whole number from 0 to most, without a call or a branch, which std::clamp may be.
inline int nearest(float value, std::size_t max)
{
    const float half_up = std::min(std::max(value, 0.0F), static_cast<float>(max)) + 0.5F;
    return static_cast<int>(half_up);
}

/// sRGB levels of linear light in steps of 1/4096.
using EncodedLevels = std::array<std::uint8_t, 4097>;

inline const EncodedLevels& encodedLevels()
{
    static const EncodedLevels levels = [] {
        EncodedLevels made{};
        for (std::size_t i = 0; i < made.size(); ++i) {
            const float level = toDisplay(static_cast<float>(i) / static_cast<float>(made.size() - 1));
            made[i] = static_cast<std::uint8_t>(std::lround(255.0F * level));
        }
        return made;
    }();
    return levels;
}

/// The sRGB level of linear light, to half a level but where they lie so close that a step of 1/4096 is more.
inline std::uint8_t encoded(float light, const EncodedLevels& levels = encodedLevels())
{
    return levels[static_cast<std::size_t>(nearest(static_cast<float>(levels.size() - 1) * light, levels.size() - 1))];
}

/// A level over another, mixed by alpha and rounded to the nearest.
inline std::uint8_t mixedLevel(std::uint32_t above, std::uint32_t below, std::uint32_t alpha)
{
    return static_cast<std::uint8_t>((above * alpha + below * (255U - alpha) + 127U) / 255U);
}

}  // namespace droplet
