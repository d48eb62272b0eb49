// SPDX-License-Identifier: GPL-3.0-or-later
// Conversions of sRGB (IEC 61966-2-1).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>

namespace droplet {

/// Linear light of an sRGB level 0 … 1.
inline float toLinear(float level)
{
    return level <= 0.04045F ? level / 12.92F : std::pow((level + 0.055F) / 1.055F, 2.4F);
}

/// sRGB level of linear light.
inline float toDisplay(float light)
{
    return light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1.0F / 2.4F) - 0.055F;
}

/// Linear light by sRGB level.
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

/// Nearest integer from 0 to `most`, without a call or a branch, unlike std::clamp.
inline int nearest(float value, std::size_t max)
{
    const float half_up = std::min(std::max(value, 0.0F), static_cast<float>(max)) + 0.5F;
    return static_cast<int>(half_up);
}

/// sRGB level by linear light in steps of 1/4096.
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

/// Step of the table for linear light.
inline int encodedStep(float light)
{
    constexpr std::size_t kLast = std::tuple_size_v<EncodedLevels> - 1;
    return nearest(static_cast<float>(kLast) * light, kLast);
}

/// sRGB level of linear light, exact to half a level except in the dark, where a step of 1/4096 is more.
inline std::uint8_t encoded(float light, const EncodedLevels& levels = encodedLevels())
{
    return levels[static_cast<std::size_t>(encodedStep(light))];
}

/// Mix of a level over another by alpha, rounded to the nearest.
inline std::uint8_t mixedLevel(std::uint8_t above, std::uint8_t below, std::uint8_t alpha)
{
    // In 16 bits, of which a vector has many: for t < 65535 this is t / 255.
    const auto t = static_cast<std::uint16_t>(above * alpha + below * (255 - alpha) + 127);
    return static_cast<std::uint8_t>(static_cast<std::uint16_t>(t + 1 + (t >> 8U)) >> 8U);
}

}  // namespace droplet
