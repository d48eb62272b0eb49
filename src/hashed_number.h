// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace droplet {

/// Hash of an integer (C. Wellons, "Prospecting for Hash Functions", 2018: lowbias32).
constexpr std::uint32_t hashed(std::uint32_t n)
{
    n ^= n >> 16;
    n *= 0x7feb352dU;
    n ^= n >> 15;
    n *= 0x846ca68bU;
    return n ^ (n >> 16);
}

/// Hash of an integer as a number in [0, 1).
inline float hashedNumber(std::uint32_t n)
{
    return static_cast<float>(hashed(n) >> 8) / 16777216.0F;
}

}  // namespace droplet
