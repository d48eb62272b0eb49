// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <ostream>
#include <utility>
#include <vector>

#include "droplet/mask/mask.h"

namespace droplet::testing {

/// Counts from the mask itself: liquid pixels that touch at a corner are one droplet; dry ones are two holes.
struct Counts {
    std::size_t droplets = 0;
    std::size_t holes = 0;

    friend bool operator==(const Counts&, const Counts&) = default;
    friend std::ostream& operator<<(std::ostream& out, const Counts& counts)
    {
        return out << counts.droplets << " droplets, " << counts.holes << " holes";
    }
};

/// Counts 8-connected liquid and 4-connected dry regions by flooding, without the dry region around the image.
inline Counts flooded(const Mask& mask)
{
    const int width = mask.width + 2;
    const int height = mask.height + 2;
    const auto liquid = [&](int x, int y) {
        return x > 0 && y > 0 && x <= mask.width && y <= mask.height && mask.at(x - 1, y - 1) >= 0.5 * 65535.0;
    };
    std::vector<bool> seen(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), false);
    const auto index = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    };
    Counts counts;
    std::size_t dry = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (seen[index(x, y)]) {
                continue;
            }
            const bool wet = liquid(x, y);
            ++(wet ? counts.droplets : dry);
            std::vector<std::pair<int, int>> front{{x, y}};
            seen[index(x, y)] = true;
            while (!front.empty()) {
                const auto [fx, fy] = front.back();
                front.pop_back();
                for (int dy = -1; dy <= 1; ++dy) {
                    for (int dx = -1; dx <= 1; ++dx) {
                        const int nx = fx + dx;
                        const int ny = fy + dy;
                        const bool neighbour = wet || dx == 0 || dy == 0;
                        if (neighbour && nx >= 0 && ny >= 0 && nx < width && ny < height && !seen[index(nx, ny)] &&
                            liquid(nx, ny) == wet) {
                            seen[index(nx, ny)] = true;
                            front.emplace_back(nx, ny);
                        }
                    }
                }
            }
        }
    }
    counts.holes = dry - 1;
    return counts;
}

}  // namespace droplet::testing
