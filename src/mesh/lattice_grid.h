// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/lattice_region.h"

namespace droplet {

/// Points along a row of a grid, by their indices, which follow one another, and those of their neighbours.
struct GridRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t below = 0;  ///< left of the two neighbours of the first in the row below
    std::uint32_t above = 0;
};

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
    /// Points of the region that has all their neighbours, too.
    [[nodiscard]] GridRun run(const RowInterval& points) const;

    /// The first index.
    [[nodiscard]] std::uint32_t begin() const { return starts_.empty() ? end_ : starts_.front(); }
    /// One more than the last index.
    [[nodiscard]] std::uint32_t end() const { return end_; }
    [[nodiscard]] const LatticeRegion& region() const { return region_; }

private:
    LatticeRegion region_;
    std::vector<std::uint32_t> starts_;  ///< the first index of every interval
    std::uint32_t end_ = 0;
};

}  // namespace droplet
