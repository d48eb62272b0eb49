// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "hashed_number.h"
#include "windshield_view/backdrop.h"

namespace droplet {

/// As std::floor(), without a call; for values that fit into an integer.
inline std::int32_t floorOf(float value)
{
    const auto whole = static_cast<std::int32_t>(value);
    return whole - (value < static_cast<float>(whole) ? 1 : 0);
}

/// Smooth random field around 0.5, with waves of two to three units in all directions, which repeats: a grid of random
/// numbers would be seen as one. It is sampled once.
class SmoothNoise {
    static constexpr std::int32_t kPerUnit = 8;

public:
    static constexpr std::int32_t kUnits = 32;  ///< after which it repeats
    static constexpr std::int32_t kSamples = kUnits * kPerUnit;

    SmoothNoise() : samples_(std::size_t{kSamples} * kSamples, Float4{0.5F, 0.0F, 0.0F, 0.0F})
    {
        constexpr std::uint32_t kWaves = 48;
        // Mean squares of value and slopes are those of a grid of numbers from 0 to 1: a deviation of 0.214, and 0.405
        // waves in a unit.
        const float height = 0.214F * std::sqrt(2.0F / static_cast<float>(kWaves));
        constexpr float kRound = 2.0F * std::numbers::pi_v<float>;
        std::array<float, kSamples> cosines;
        for (std::size_t k = 0; k < cosines.size(); ++k) {
            cosines[k] = height * std::cos(kRound / static_cast<float>(kSamples) * static_cast<float>(k));
        }
        for (std::uint32_t wave = 0; wave < kWaves; ++wave) {
            const float direction =
                kRound * (static_cast<float>(wave) + hashedNumber(2 * wave)) / static_cast<float>(kWaves);
            const float number = kUnits * 0.405F * (0.7F + 0.6F * hashedNumber(3 * wave + 1));
            const auto across = static_cast<std::int32_t>(std::lround(number * std::cos(direction)));
            const auto down = static_cast<std::int32_t>(std::lround(number * std::sin(direction)));
            const auto phase = static_cast<std::int32_t>(kSamples * hashedNumber(5 * wave + 2));
            for (std::int32_t row = 0; row < kSamples; ++row) {
                for (std::int32_t column = 0; column < kSamples; ++column) {
                    const std::int32_t at = across * column + down * row + phase;
                    const auto value = [&](std::int32_t k) {
                        return cosines[static_cast<std::size_t>(k & (kSamples - 1))];
                    };
                    const float slope = kRound / kUnits * value(at + kSamples / 4);
                    samples_[index(column, row)] +=
                        Float4{value(at), slope * static_cast<float>(across), slope * static_cast<float>(down), 0.0F};
                }
            }
        }
    }

    /// Value, and its slopes along u and v.
    [[nodiscard]] Float4 at(float u, float v) const
    {
        const float x = kPerUnit * u;
        const float y = kPerUnit * v;
        const std::int32_t column = floorOf(x);
        const std::int32_t row = floorOf(y);
        const Float4 across = float4(x - static_cast<float>(column));
        const Float4& a = samples_[index(column, row)];
        const Float4& b = samples_[index(column, row + 1)];
        const Float4 lower = a + across * (samples_[index(column + 1, row)] - a);
        const Float4 upper = b + across * (samples_[index(column + 1, row + 1)] - b);
        return lower + float4(y - static_cast<float>(row)) * (upper - lower);
    }

    /// Place of a u between samples.
    struct Place {
        std::uint32_t sample = 0;  ///< before it
        float beyond = 0.0F;       ///< the way to the next one that it is beyond
    };
    static Place placeOf(float u)
    {
        const float x = kPerUnit * u;
        const std::int32_t column = floorOf(x);
        return {static_cast<std::uint32_t>(column & (kSamples - 1)), x - static_cast<float>(column)};
    }

    /// The field at one v, times factors.
    class Row {
    public:
        /// @param factors  of value and slopes
        Row(const SmoothNoise& field, float v, const Float4& factors)
        {
            const float y = kPerUnit * v;
            const std::int32_t row = floorOf(y);
            const Float4 up = float4(y - static_cast<float>(row));
            for (std::int32_t column = 0; column <= kSamples; ++column) {
                const Float4& lower = field.samples_[index(column, row)];
                samples_[static_cast<std::size_t>(column)] =
                    factors * (lower + up * (field.samples_[index(column, row + 1)] - lower));
            }
        }

        [[nodiscard]] Float4 at(const Place& place) const
        {
            const Float4* const from = samples_.data() + place.sample;
            return from[0] + float4(place.beyond) * (from[1] - from[0]);
        }

    private:
        std::array<Float4, kSamples + 1> samples_;  ///< the last is the first
    };

private:
    static std::size_t index(std::int32_t column, std::int32_t row)
    {
        return static_cast<std::size_t>(row & (kSamples - 1)) * kSamples +
               static_cast<std::size_t>(column & (kSamples - 1));
    }

    std::vector<Float4> samples_;
};

}  // namespace droplet
