// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Places sorted by the cells of a grid; rows of cells are contiguous.
class CellGrid {
public:
    /// @param lower,upper  bounds of all places that count [m]; others are left out
    /// @param cell         side of a cell [m]
    CellGrid(Vec2 lower, Vec2 upper, double cell);

    /// Order of places by cells, those of a cell in their order, without those outside of the bounds.
    std::vector<std::uint32_t> sort(std::span<const Vec2> places);

    /// Range, in the sorted order, of the places in the cells from `first` to `last` column of a row, clipped.
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> range(int row, int first, int last) const;
    /// Column of an abscissa, row of an ordinate; may be outside.
    [[nodiscard]] int column(double x) const { return static_cast<int>(std::floor((x - lower_.x) * inverse_)); }
    [[nodiscard]] int row(double y) const { return static_cast<int>(std::floor((y - lower_.y) * inverse_)); }

private:
    Vec2 lower_;
    double inverse_;
    int columns_;
    int rows_;
    std::vector<std::uint32_t> begin_;  ///< of each cell in the sorted order
};

}  // namespace droplet
