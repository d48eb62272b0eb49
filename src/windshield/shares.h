// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace droplet {

/// Droplets a thread takes at a time.
inline constexpr std::size_t kShare = 128;

/// How many threads may take some of so many.
constexpr std::size_t sharesOf(std::size_t count)
{
    return (count + kShare - 1) / kShare;
}

/// Calls work(share, begin, end) for shares of [0, count), in parallel if there are several.
template <class Work>
void forShares(std::size_t count, const Work& work)
{
    const std::size_t shares = sharesOf(count);
    if (shares <= 1) {
        work(std::size_t{0}, std::size_t{0}, count);
        return;
    }
    tbb::parallel_for(std::size_t{0}, shares,
                      [&](std::size_t k) { work(k, k * kShare, std::min(count, (k + 1) * kShare)); });
}

}  // namespace droplet
