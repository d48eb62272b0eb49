// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/lattice_triangles.h"

#include <tbb/parallel_for.h>

#include <cstdint>

namespace droplet {

LatticeTriangles trianglesOf(const LatticeRegion& region)
{
    const LatticeRegion edges = common(region, moved(region, LatticeStep::Left));
    return {common(edges, moved(region, LatticeStep::BelowLeft)), common(edges, moved(region, LatticeStep::AboveLeft))};
}

LatticeTriangles without(const LatticeTriangles& triangles, const LatticeTriangles& removed)
{
    return {without(triangles.upward, removed.upward), without(triangles.downward, removed.downward)};
}

void append(std::vector<Triangle>& to, const LatticeTriangles& triangles, const LatticeGrid& grid)
{
    if (grid.region().empty()) {
        return;
    }
    // Between row r and the next lie the upward triangles of row r and the downward ones of the next row.
    const std::int32_t first = grid.region().firstRow();
    const auto rows = static_cast<std::size_t>(grid.region().endRow() - first);
    std::vector<std::size_t> starts{to.size()};
    for (std::size_t k = 0; k < rows; ++k) {
        const std::int32_t r = first + static_cast<std::int32_t>(k);
        starts.push_back(starts.back());
        for (const RowInterval& i : triangles.upward.row(r)) {
            starts.back() += i.size();
        }
        for (const RowInterval& i : triangles.downward.row(r + 1)) {
            starts.back() += i.size();
        }
    }
    to.resize(starts.back());
    tbb::parallel_for(std::size_t{0}, rows, [&](std::size_t k) {
        const std::int32_t r = first + static_cast<std::int32_t>(k);
        Triangle* out = to.data() + starts[k];
        for (const RowInterval& i : triangles.upward.row(r)) {
            std::uint32_t a = grid.at(i.first());
            std::uint32_t b = grid.at(neighbour(i.first(), LatticeStep::AboveRight));
            for (const std::uint32_t end = a + i.size(); a < end; ++a, ++b) {
                *out++ = {a, a + 1, b};
            }
        }
        for (const RowInterval& i : triangles.downward.row(r + 1)) {
            std::uint32_t a = grid.at(i.first());
            std::uint32_t b = grid.at(neighbour(i.first(), LatticeStep::BelowRight));
            for (const std::uint32_t end = a + i.size(); a < end; ++a, ++b) {
                *out++ = {b, a + 1, a};
            }
        }
    });
}

}  // namespace droplet
