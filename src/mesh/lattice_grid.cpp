// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/lattice_grid.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace droplet {

LatticeGrid::LatticeGrid(LatticeRegion region, std::uint32_t first) : region_(std::move(region)), end_(first)
{
    starts_.reserve(region_.intervals().size());
    for (const RowInterval& i : region_.intervals()) {
        starts_.push_back(end_);
        end_ += i.size();
    }
}

std::uint32_t LatticeGrid::at(Site site) const
{
    const std::size_t k = region_.intervalOf(site);
    return starts_[k] + static_cast<std::uint32_t>(site.column - region_.intervals()[k].begin);
}

Site LatticeGrid::siteOf(std::uint32_t index) const
{
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), index);
    const auto k = static_cast<std::size_t>(after - starts_.begin()) - 1;
    const RowInterval& i = region_.intervals()[k];
    return {i.row, i.begin + static_cast<std::int32_t>(index - starts_[k])};
}

GridRun LatticeGrid::run(const RowInterval& points) const
{
    const Site first = points.first();
    return {at(first), points.size(), at(neighbour(first, LatticeStep::BelowLeft)),
            at(neighbour(first, LatticeStep::AboveLeft))};
}

}  // namespace droplet
