// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/touching.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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

struct Entry {
    std::uint64_t cell;
    std::uint32_t ball;
    bool operator<(const Entry& other) const { return cell != other.cell ? cell < other.cell : ball < other.ball; }
};

}  // namespace

std::vector<Pair> touchingPairs(std::span<const MovingBall> balls)
{
    std::vector<double> sizes;
    bool any_changed = false;
    for (const MovingBall& ball : balls) {
        if (ball.reach > 0.0) {
            sizes.push_back(sizeOf(boxOf(ball)));
            any_changed = any_changed || ball.changed;
        }
    }
    if (!any_changed || sizes.size() < 2) {
        return {};
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double cell = std::max(2.0 * *middle, *std::max_element(sizes.begin(), sizes.end()) / std::cbrt(kMaxCells));
    const auto blocks = mapBlocks<std::vector<Entry>>(balls.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<Entry> entries;
        for (std::size_t i = begin; i < end; ++i) {
            if (balls[i].reach <= 0.0) {
                continue;
            }
            const Box box = boxOf(balls[i]);
            const auto index = [&](double v) { return static_cast<std::int64_t>(std::floor(v / cell)); };
            for (std::int64_t x = index(box.low.x); x <= index(box.high.x); ++x) {
                for (std::int64_t y = index(box.low.y); y <= index(box.high.y); ++y) {
                    for (std::int64_t z = index(box.low.z); z <= index(box.high.z); ++z) {
                        const std::uint64_t key =
                            mix(mix(mix(static_cast<std::uint64_t>(x)) + static_cast<std::uint64_t>(y)) +
                                static_cast<std::uint64_t>(z));
                        entries.push_back({key, static_cast<std::uint32_t>(i)});
                    }
                }
            }
        }
        return entries;
    });
    std::vector<Entry> entries;
    for (const std::vector<Entry>& block : blocks) {
        entries.insert(entries.end(), block.begin(), block.end());
    }
    tbb::parallel_sort(entries.begin(), entries.end());
    const auto found = mapBlocks<std::vector<Pair>>(entries.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<Pair> pairs;
        for (std::size_t a = begin; a < end; ++a) {
            const std::uint32_t i = entries[a].ball;
            for (std::size_t b = a + 1; b < entries.size() && entries[b].cell == entries[a].cell; ++b) {
                const std::uint32_t j = entries[b].ball;
                if (i != j && (balls[i].changed || balls[j].changed) && touch(balls[i], balls[j])) {
                    pairs.emplace_back(i, j);
                }
            }
        }
        return pairs;
    });
    std::vector<Pair> pairs;
    for (const std::vector<Pair>& block : found) {
        pairs.insert(pairs.end(), block.begin(), block.end());
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace droplet
