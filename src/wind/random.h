// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace droplet {

/// The finaliser of SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators",
/// OOPSLA 2014): every bit of the result depends on every bit of z.
constexpr std::uint64_t mix(std::uint64_t z)
{
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
}

/// Purpose of random numbers; streams of different purposes are independent.
enum class RandomPurpose : std::uint64_t {
    Raindrop = 1,
    Fluctuation,
    Bead,
    Scatter,
    Emission,
    Nucleus,
    TornPart,
    Dew,
    Pinning,
    Spray,
    Finger,
    Runoff
};

/// Normal with mean 0 and deviation 1, of two random numbers. G. E. P. Box, M. E. Muller, Ann. Math. Stat. 29 (1958)
/// 610.
/// @param u, v  uniform in [0, 1)
inline double normal(double u, double v)
{
    return std::sqrt(-2.0 * std::log1p(-u)) * std::cos(2.0 * std::numbers::pi * v);
}

/// Random numbers without a state: each is a function of seed, purpose, id and counter.
class RandomStream {
public:
    constexpr RandomStream(std::uint64_t seed, RandomPurpose purpose, std::uint64_t id)
        : key_(mix(mix(mix(seed + kStride) + static_cast<std::uint64_t>(purpose) * kStride) + id * kStride))
    {
    }

    [[nodiscard]] constexpr std::uint64_t bits(std::uint64_t counter) const
    {
        return mix(key_ + (counter + 1) * kStride);
    }
    /// Uniform in [0, 1), a multiple of 2⁻⁵³.
    [[nodiscard]] constexpr double uniform(std::uint64_t counter) const
    {
        return static_cast<double>(bits(counter) >> 11U) * 0x1p-53;
    }
    /// Exponential with mean 1, finite.
    [[nodiscard]] double exponential(std::uint64_t counter) const { return -std::log1p(-uniform(counter)); }

private:
    static constexpr std::uint64_t kStride = 0x9E3779B97F4A7C15U;  // 2⁶⁴ over the golden ratio, odd

    std::uint64_t key_;
};

}  // namespace droplet
