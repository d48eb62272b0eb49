// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/regular_runs.h"

#include <cstddef>
#include <utility>

namespace droplet {

RegularRun regularRun(const LatticeGrid& grid, std::int32_t row, ColumnInterval columns)
{
    const std::int32_t left = columns.begin + leftOf(row);
    return {grid.at({row, columns.begin}), static_cast<std::uint32_t>(columns.end - columns.begin),
            grid.at({row - 1, left}), grid.at({row + 1, left})};
}

LatticeRegion regionOf(const Lattice& lattice)
{
    if (lattice.runs.empty()) {
        return {};
    }
    const std::int32_t first = lattice.runs.front().row;
    std::vector<LatticeRegion::Row> rows(static_cast<std::size_t>(lattice.runs.back().row - first + 1));
    for (const LatticeRun& run : lattice.runs) {
        rows[static_cast<std::size_t>(run.row - first)].push_back(
            {run.column, run.column + static_cast<std::int32_t>(run.count)});
    }
    return {first, std::move(rows)};
}

std::vector<RegularRun> regularRuns(const Lattice& lattice)
{
    std::vector<RegularRun> result;
    if (lattice.runs.empty()) {
        return result;
    }
    const LatticeGrid grid(regionOf(lattice), lattice.runs.front().vertex);
    const LatticeRegion regular = eroded(grid.region());
    for (std::int32_t r = regular.firstRow(); r < regular.endRow(); ++r) {
        for (const ColumnInterval& i : regular.row(r)) {
            result.push_back(regularRun(grid, r, i));
        }
    }
    return result;
}

}  // namespace droplet
