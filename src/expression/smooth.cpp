// SPDX-License-Identifier: GPL-3.0-or-later
// Taubin: A signal processing approach to fair surface design. SIGGRAPH 1995. Its two steps: the first shrinks, the
// second grows by a little more, so that bends longer than the pass-band stay.
#include "smooth.h"

#include <cstddef>

namespace droplet {

std::vector<Vec2> smoothed(std::vector<Vec2> points, int rounds)
{
    constexpr double kShrink = 0.5;
    constexpr double kGrow = -0.526;  // 1/0.5 + 1/−0.526 = 0.1: the pass-band that Taubin recommends
    // Smaller loops are droplets of few particles, and smooth by themselves.
    constexpr std::size_t kLeast = 24;
    const std::size_t count = points.size();
    if (count < kLeast) {
        return points;
    }
    std::vector<Vec2> next(count);
    for (int round = 0; round < 2 * rounds; ++round) {
        const double factor = round % 2 == 0 ? kShrink : kGrow;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec2 mean = 0.5 * (points[(i + 1) % count] + points[(i + count - 1) % count]);
            next[i] = points[i] + factor * (mean - points[i]);
        }
        points.swap(next);
    }
    return points;
}

}  // namespace droplet
