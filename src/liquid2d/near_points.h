// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Nearest of many points, by a tree that halves them in turn along x and y.
class NearPoints {
public:
    /// @param points  finite, fewer than 2³²
    explicit NearPoints(const std::vector<Vec2>& points);

    struct Neighbour {
        double squared = 0.0;     ///< distance [m²]
        std::uint32_t index = 0;  ///< of the point
    };

    /// The nearest `count` points, nearest first, of equally near ones that with the lower index.
    [[nodiscard]] std::vector<Neighbour> nearest(Vec2 from, std::size_t count) const;

private:
    struct Query {
        Vec2 from;
        std::size_t count;
        std::vector<Neighbour> found;
    };

    void halve(std::span<std::uint32_t> part, bool by_x);
    void search(std::span<const std::uint32_t> part, bool by_x, Query& query) const;

    std::vector<Vec2> points_;
    std::vector<std::uint32_t> order_;
};

}  // namespace droplet
