// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/lattice_region.h"

namespace droplet {

/// A lattice point by row and column.
struct Site {
    std::int32_t row = 0;
    std::int32_t column = 0;
};

/// The six neighbours of a lattice point.
constexpr std::array<Site, 6> neighboursOf(Site s)
{
    const std::int32_t left = s.column + leftOf(s.row);
    return {{{s.row, s.column - 1},
             {s.row, s.column + 1},
             {s.row - 1, left},
             {s.row - 1, left + 1},
             {s.row + 1, left},
             {s.row + 1, left + 1}}};
}

/// A point of the lattice with twice the edge, as a point of this one. Its six neighbours here are half-way to its
/// neighbours there.
constexpr Site onFiner(Site coarse)
{
    return {2 * coarse.row, 2 * coarse.column + (coarse.row & 1)};
}

/// The two points of the lattice with twice the edge half-way between which a point lies; twice the same if it is one.
constexpr std::array<Site, 2> onCoarser(Site fine)
{
    const std::int32_t low = fine.row >> 1;
    const std::int32_t odd = low & 1;
    const std::int32_t column = fine.column - odd;
    if ((fine.row & 1) == 0) {
        return {{{low, column >> 1}, {low, (column + 1) >> 1}}};
    }
    // Row low + 1 begins half an edge further left or right, so the halves round the other way there.
    return {{{low, (column + 1) >> 1}, {low + 1, (fine.column + odd) >> 1}}};
}

/// Storage for values at lattice points: the points of a region have consecutive indices, row by row.
class LatticeGrid {
public:
    LatticeGrid() = default;
    /// @param first  index of the first point
    LatticeGrid(LatticeRegion region, std::uint32_t first);

    /// Index of a point of the region.
    [[nodiscard]] std::uint32_t at(Site site) const;
    /// The point of an index.
    [[nodiscard]] Site siteOf(std::uint32_t index) const;
    /// One more than the last index.
    [[nodiscard]] std::uint32_t end() const { return end_; }
    [[nodiscard]] const LatticeRegion& region() const { return region_; }

private:
    struct Start {
        Site site;
        std::uint32_t index = 0;
    };
    LatticeRegion region_;
    std::vector<Start> starts_;              ///< of every interval, ascending
    std::vector<std::uint32_t> row_starts_;  ///< into starts_
    std::uint32_t end_ = 0;
};

}  // namespace droplet
