// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace cli {

using Clock = std::chrono::steady_clock;

inline double seconds(Clock::time_point from, Clock::time_point to)
{
    return std::chrono::duration<double>(to - from).count();
}

inline double secondsSince(Clock::time_point start)
{
    return seconds(start, Clock::now());
}

}  // namespace cli
