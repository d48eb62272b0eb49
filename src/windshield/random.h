// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

namespace droplet {

/// The finaliser of SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators",
/// OOPSLA 2014): every bit of the result hangs on every bit of z.
constexpr std::uint64_t mixed(std::uint64_t z)
{
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
}

/// What random numbers are for: streams of different purposes have nothing to do with one another.
enum class Chance : std::uint64_t { Raindrop = 1, Fluctuation, Bead };

/// Random numbers by their place: a function of seed, purpose, id and counter, with no state to keep or to share.
class RandomStream {
public:
    constexpr RandomStream(std::uint64_t seed, Chance purpose, std::uint64_t id)
        : key_(mixed(mixed(mixed(seed + kStride) + static_cast<std::uint64_t>(purpose) * kStride) + id * kStride))
    {
    }

    [[nodiscard]] constexpr std::uint64_t bits(std::uint64_t counter) const
    {
        return mixed(key_ + (counter + 1) * kStride);
    }
    /// In [0, 1), on a lattice of 2⁻⁵³.
    [[nodiscard]] constexpr double uniform(std::uint64_t counter) const
    {
        return static_cast<double>(bits(counter) >> 11U) * 0x1p-53;
    }
    /// Of mean 1, finite.
    [[nodiscard]] double exponential(std::uint64_t counter) const { return -std::log1p(-uniform(counter)); }

private:
    static constexpr std::uint64_t kStride = 0x9E3779B97F4A7C15U;  // 2⁶⁴ over the golden ratio, odd

    std::uint64_t key_;
};

}  // namespace droplet
