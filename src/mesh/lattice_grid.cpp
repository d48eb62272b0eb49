// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/lattice_grid.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace droplet {

LatticeGrid::LatticeGrid(LatticeRegion region, std::uint32_t first) : region_(std::move(region)), end_(first)
{
    for (std::int32_t r = region_.firstRow(); r < region_.endRow(); ++r) {
        row_starts_.push_back(static_cast<std::uint32_t>(starts_.size()));
        for (const ColumnInterval& i : region_.row(r)) {
            starts_.push_back({{r, i.begin}, end_});
            end_ += static_cast<std::uint32_t>(i.end - i.begin);
        }
    }
    row_starts_.push_back(static_cast<std::uint32_t>(starts_.size()));
}

std::uint32_t LatticeGrid::at(Site site) const
{
    const auto row = static_cast<std::size_t>(site.row - region_.firstRow());
    const auto begin = starts_.begin() + row_starts_[row];
    const auto end = starts_.begin() + row_starts_[row + 1];
    const auto after = std::upper_bound(begin, end, site.column,
                                        [](std::int32_t column, const Start& s) { return column < s.site.column; });
    const Start& start = *std::prev(after);
    return start.index + static_cast<std::uint32_t>(site.column - start.site.column);
}

Site LatticeGrid::siteOf(std::uint32_t index) const
{
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), index,
                                        [](std::uint32_t i, const Start& s) { return i < s.index; });
    const Start& start = *std::prev(after);
    return {start.site.row, start.site.column + static_cast<std::int32_t>(index - start.index)};
}

}  // namespace droplet
