// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace droplet {

/// Length of the blocks of long arrays: enough work to pay for a thread.
inline constexpr std::size_t kBlock = 16384;

/// Calls work(begin, end) for every block of [0, count), in parallel if there are several.
template <typename Work>
void forBlocks(std::size_t count, const Work& work, std::size_t length = kBlock)
{
    if (count <= length) {
        work(std::size_t{0}, count);
        return;
    }
    tbb::parallel_for(std::size_t{0}, (count + length - 1) / length,
                      [&](std::size_t b) { work(b * length, std::min(count, (b + 1) * length)); });
}

/// Results of map(begin, end) for every block of [0, count), in their order. So their sum is the same at any number of
/// threads.
template <typename Result, typename Map>
std::vector<Result> mapBlocks(std::size_t count, const Map& map, std::size_t length = kBlock)
{
    std::vector<Result> results((count + length - 1) / length);
    forBlocks(
        count,
        [&](std::size_t begin, std::size_t end) {
            if (begin < end) {
                results[begin / length] = map(begin, end);
            }
        },
        length);
    return results;
}

/// Sum of sum(begin, end) over all blocks, in their order.
template <typename Sum>
double sumOverBlocks(std::size_t count, const Sum& sum)
{
    double total = 0.0;
    for (const double s : mapBlocks<double>(count, sum)) {
        total += s;
    }
    return total;
}

/// Sum of products, block by block.
template <typename A>
double dotProduct(const std::vector<A>& a, const std::vector<double>& b)
{
    return sumOverBlocks(a.size(), [&](std::size_t begin, std::size_t end) {
        // Four independent sums, so that no addition waits for the one before.
        double s0 = 0.0;
        double s1 = 0.0;
        double s2 = 0.0;
        double s3 = 0.0;
        std::size_t i = begin;
        for (; i + 4 <= end; i += 4) {
            s0 += static_cast<double>(a[i]) * b[i];
            s1 += static_cast<double>(a[i + 1]) * b[i + 1];
            s2 += static_cast<double>(a[i + 2]) * b[i + 2];
            s3 += static_cast<double>(a[i + 3]) * b[i + 3];
        }
        for (; i < end; ++i) {
            s0 += static_cast<double>(a[i]) * b[i];
        }
        return (s0 + s1) + (s2 + s3);
    });
}

}  // namespace droplet
