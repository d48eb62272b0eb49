// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace droplet {

/// Hash of an integer as a number in [0, 1).
inline float hashedNumber(std::uint32_t n)
{
    // C. Wellons, "Prospecting for Hash Functions" (2018): lowbias32.
    n ^= n >> 16;
    n *= 0x7feb352dU;
    n ^= n >> 15;
    n *= 0x846ca68bU;
    n ^= n >> 16;
    return static_cast<float>(n >> 8) / 16777216.0F;
}

}  // namespace droplet
