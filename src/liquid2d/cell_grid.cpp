// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_grid.h"

#include <algorithm>
#include <cstddef>

namespace droplet {

CellGrid::CellGrid(Vec2 lower, Vec2 upper, double cell)
    : lower_(lower),
      inverse_(1.0 / cell),
      columns_(static_cast<int>(std::floor((upper.x - lower.x) * inverse_)) + 1),
      rows_(static_cast<int>(std::floor((upper.y - lower.y) * inverse_)) + 1)
{
}

std::vector<std::uint32_t> CellGrid::sort(std::span<const Vec2> places)
{
    const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    constexpr std::uint32_t kOutside = ~std::uint32_t{0};
    std::vector<std::uint32_t> cell_of(places.size());
    begin_.assign(cells + 1, 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const int c = column(places[i].x);
        const int r = row(places[i].y);
        const bool is_inside = c >= 0 && r >= 0 && c < columns_ && r < rows_;
        cell_of[i] = is_inside ? static_cast<std::uint32_t>(r) * static_cast<std::uint32_t>(columns_) +
                                     static_cast<std::uint32_t>(c)
                               : kOutside;
        if (is_inside) {
            ++begin_[cell_of[i] + 1];
        }
    }
    for (std::size_t c = 0; c < cells; ++c) {
        begin_[c + 1] += begin_[c];
    }
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    std::vector<std::uint32_t> order(begin_.back());
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (cell_of[i] != kOutside) {
            order[next[cell_of[i]]++] = static_cast<std::uint32_t>(i);
        }
    }
    return order;
}

std::pair<std::uint32_t, std::uint32_t> CellGrid::range(int row, int first, int last) const
{
    first = std::max(first, 0);
    last = std::min(last, columns_ - 1);
    if (row < 0 || row >= rows_ || first > last) {
        return {0, 0};
    }
    const auto cell = [&](int column) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    };
    return {begin_[cell(first)], begin_[cell(last) + 1]};
}

}  // namespace droplet
