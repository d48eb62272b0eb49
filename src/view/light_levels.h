// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "picture/tone.h"

namespace droplet {

/// A share in 255ths.
inline std::uint8_t level8(float share)
{
    return static_cast<std::uint8_t>(nearest(255.0F * share, 255));
}

}  // namespace droplet
