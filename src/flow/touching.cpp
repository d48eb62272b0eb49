// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/touching.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "blocks.h"
#include "wind/random.h"

namespace droplet {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

struct Box {
    Vec3 low;
    Vec3 high;
};

// A ball fills at most so many cells; beyond, cells are larger.
constexpr double kMaxCells = 4096.0;
constexpr std::size_t kMinBuckets = 1024;
// Balls, or buckets, in a block of work for one thread.
constexpr std::size_t kBallsPerBlock = 1024;

Box boxOf(const MovingBall& ball)
{
    const double r = ball.reach;
    return {{std::min(ball.from.x, ball.to.x) - r, std::min(ball.from.y, ball.to.y) - r,
             std::min(ball.from.z, ball.to.z) - r},
            {std::max(ball.from.x, ball.to.x) + r, std::max(ball.from.y, ball.to.y) + r,
             std::max(ball.from.z, ball.to.z) + r}};
}

double sizeOf(const Box& box)
{
    return std::max({box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z});
}

bool touch(const MovingBall& a, const MovingBall& b)
{
    const Vec3 offset = b.from - a.from;
    const Vec3 change = (b.to - b.from) - (a.to - a.from);
    const double squared = dot(change, change);
    const double share = squared > 0.0 ? std::clamp(-dot(offset, change) / squared, 0.0, 1.0) : 0.0;
    const Vec3 nearest = offset + share * change;
    const double reach = a.reach + b.reach;
    return dot(nearest, nearest) < reach * reach;
}

/// Calls visit(number) for the buckets of all cells that a box meets.
template <typename Visit>
void visitBuckets(const Box& box, double per_metre, std::uint64_t mask, const Visit& visit)
{
    const auto index = [&](double v) { return static_cast<std::int64_t>(std::floor(v * per_metre)); };
    const std::int64_t last_x = index(box.high.x);
    const std::int64_t last_y = index(box.high.y);
    const std::int64_t last_z = index(box.high.z);
    for (std::int64_t x = index(box.low.x); x <= last_x; ++x) {
        for (std::int64_t y = index(box.low.y); y <= last_y; ++y) {
            for (std::int64_t z = index(box.low.z); z <= last_z; ++z) {
                visit(mix(static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U +
                          static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FU + static_cast<std::uint64_t>(z)) &
                      mask);
            }
        }
    }
}

/// Adds the pairs that connect some balls. A ball is compared with a group only until they touch, which is soon where
/// many lie on one another.
template <typename Joins>
void connect(std::span<const std::uint32_t> members, const Joins& joins, std::vector<Pair>& pairs)
{
    // Most often none touch, which takes no lists.
    const bool do_any_touch = std::any_of(members.begin(), members.end(), [&](const std::uint32_t& i) {
        return std::any_of(members.data(), &i, [&](std::uint32_t j) { return joins(std::min(i, j), std::max(i, j)); });
    });
    if (!do_any_touch) {
        return;
    }
    std::vector<std::vector<std::uint32_t>> groups;
    for (const std::uint32_t i : members) {
        std::vector<std::uint32_t> own{i};
        std::size_t kept = 0;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const auto met = std::find_if(groups[g].begin(), groups[g].end(),
                                          [&](std::uint32_t j) { return joins(std::min(i, j), std::max(i, j)); });
            if (met == groups[g].end()) {
                std::swap(groups[kept++], groups[g]);
                continue;
            }
            pairs.emplace_back(std::min(i, *met), std::max(i, *met));
            if (own.size() < groups[g].size()) {
                own.swap(groups[g]);
            }
            own.insert(own.end(), groups[g].begin(), groups[g].end());
        }
        groups.resize(kept);
        groups.push_back(std::move(own));
    }
}

}  // namespace

std::vector<Pair> connectingPairs(std::span<const MovingBall> balls,
                                  const std::function<bool(std::uint32_t, std::uint32_t)>& may_join)
{
    const auto joins = [&](std::uint32_t i, std::uint32_t j) {
        return (balls[i].changed || balls[j].changed) && touch(balls[i], balls[j]) && may_join(i, j);
    };
    std::vector<double> sizes;
    std::size_t changed = 0;
    for (const MovingBall& ball : balls) {
        if (ball.reach > 0.0) {
            sizes.push_back(sizeOf(boxOf(ball)));
            changed += ball.changed ? 1 : 0;
        }
    }
    if (changed == 0 || sizes.size() < 2) {
        return {};
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double cell = std::max(2.0 * *middle, *std::max_element(sizes.begin(), sizes.end()) / std::cbrt(kMaxCells));
    const double per_metre = 1.0 / cell;
    const std::uint64_t mask = std::bit_ceil(std::max(8 * changed, kMinBuckets)) - 1;
    // Only buckets with a ball that has changed are filled.
    std::vector<std::uint32_t> first(mask + 2);
    for (const MovingBall& ball : balls) {
        if (ball.reach > 0.0 && ball.changed) {
            visitBuckets(boxOf(ball), per_metre, mask, [&](std::uint64_t bucket) { first[bucket] = 1; });
        }
    }
    const auto blocks = mapBlocks<std::vector<Pair>>(
        balls.size(),
        [&](std::size_t begin, std::size_t end) {
            std::vector<Pair> entries;  // bucket and ball
            for (std::size_t i = begin; i < end; ++i) {
                if (balls[i].reach > 0.0) {
                    visitBuckets(boxOf(balls[i]), per_metre, mask, [&](std::uint64_t bucket) {
                        if (first[bucket] != 0) {
                            entries.emplace_back(static_cast<std::uint32_t>(bucket), static_cast<std::uint32_t>(i));
                        }
                    });
                }
            }
            return entries;
        },
        kBallsPerBlock);
    std::fill(first.begin(), first.end(), 0U);
    for (const std::vector<Pair>& block : blocks) {
        for (const Pair& entry : block) {
            ++first[entry.first + 1];
        }
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> members(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const std::vector<Pair>& block : blocks) {
        for (const Pair& entry : block) {
            members[next[entry.first]++] = entry.second;
        }
    }
    const auto found = mapBlocks<std::vector<Pair>>(
        mask + 1,
        [&](std::size_t begin, std::size_t end) {
            std::vector<Pair> pairs;
            for (std::size_t bucket = begin; bucket < end; ++bucket) {
                connect({members.data() + first[bucket], members.data() + first[bucket + 1]}, joins, pairs);
            }
            return pairs;
        },
        kBallsPerBlock);
    std::vector<Pair> pairs;
    for (const std::vector<Pair>& block : found) {
        pairs.insert(pairs.end(), block.begin(), block.end());
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace droplet
