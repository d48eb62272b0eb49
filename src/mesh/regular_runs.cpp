// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/regular_runs.h"

#include <cstddef>
#include <utility>

#include "mesh/lattice_core.h"

namespace droplet {

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
    const LatticeRegion region = regionOf(lattice);
    const LatticeRegion regular = eroded(region);
    const LatticeNumbering number(region);
    const std::uint32_t first = lattice.runs.front().vertex;
    for (std::int32_t r = regular.firstRow(); r < regular.endRow(); ++r) {
        for (const ColumnInterval& i : regular.row(r)) {
            const std::int32_t left = i.begin + leftOf(r);
            result.push_back({first + number(r, i.begin), static_cast<std::uint32_t>(i.end - i.begin),
                              first + number(r - 1, left), first + number(r + 1, left)});
        }
    }
    return result;
}

}  // namespace droplet
