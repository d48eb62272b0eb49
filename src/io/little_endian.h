// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "droplet/error.h"

namespace droplet {

/// The nearest float. @throws Error InvalidArgument beyond float's range
inline float toFloat(double value)
{
    if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) {
        throw Error(ErrorCode::InvalidArgument,
                    "surface holds " + std::to_string(value) + ", which a 32-bit float cannot");
    }
    return static_cast<float>(value);
}

/// Appends a number's low `count` bytes, the lowest first, whatever the machine's own order.
template <class Bytes>
void appendBytes(Bytes& bytes, std::uint32_t value, int count)
{
    for (int i = 0; i < count; ++i) {
        bytes.push_back(static_cast<typename Bytes::value_type>(value >> (8 * i)));
    }
}

template <class Bytes>
void appendU16(Bytes& bytes, std::uint32_t value)
{
    appendBytes(bytes, value, 2);
}

template <class Bytes>
void appendU32(Bytes& bytes, std::uint32_t value)
{
    appendBytes(bytes, value, 4);
}

template <class Bytes>
void appendFloat(Bytes& bytes, double value)
{
    appendBytes(bytes, std::bit_cast<std::uint32_t>(toFloat(value)), 4);
}

}  // namespace droplet
