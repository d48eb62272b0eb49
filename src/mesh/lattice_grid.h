// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/lattice_region.h"

namespace droplet {

/// Points along a row of a grid, by their consecutive indices, with the indices of their neighbours.
struct GridRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t below = 0;  ///< left one of the first point's two neighbours in the row below
    std::uint32_t above = 0;
};

/// Numbering of lattice points: the points of a region have consecutive indices, row by row.
class LatticeGrid {
public:
    LatticeGrid() = default;
    /// @param first  index of the first point
    LatticeGrid(LatticeRegion region, std::uint32_t first);

    /// Index of a point of the region.
    [[nodiscard]] std::uint32_t at(Site site) const;
    /// Point with an index.
    [[nodiscard]] Site siteOf(std::uint32_t index) const;
    /// Indices of a run of points whose neighbours all belong to the region.
    [[nodiscard]] GridRun run(const RowInterval& points) const;

    /// First index.
    [[nodiscard]] std::uint32_t begin() const { return starts_.empty() ? end_ : starts_.front(); }
    /// One past the last index.
    [[nodiscard]] std::uint32_t end() const { return end_; }
    [[nodiscard]] const LatticeRegion& region() const { return region_; }

private:
    LatticeRegion region_;
    std::vector<std::uint32_t> starts_;  ///< first index of every interval
    std::uint32_t end_ = 0;
};

}  // namespace droplet
