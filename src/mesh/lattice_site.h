// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

#include "droplet/vector.h"

namespace droplet {

/// Point of an equilateral lattice by row and column.
struct Site {
    std::int32_t row = 0;
    std::int32_t column = 0;

    friend bool operator==(const Site&, const Site&) = default;
};

/// Position of a lattice point: row r is at y = r·√3/2·edge, its columns at x = column·edge, half an edge further in
/// odd rows.
/// @param edge  distance between neighbouring points [m]
inline Vec2 latticePoint(double edge, Site site)
{
    return {(static_cast<double>(site.column) + (site.row % 2 == 0 ? 0.0 : 0.5)) * edge,
            static_cast<double>(site.row) * (0.5 * std::numbers::sqrt3 * edge)};
}

/// Step from a lattice point to one of its six neighbours.
enum class LatticeStep { Left, Right, BelowLeft, BelowRight, AboveLeft, AboveRight };

inline constexpr std::array<LatticeStep, 6> kLatticeSteps{LatticeStep::Left,      LatticeStep::Right,
                                                          LatticeStep::BelowLeft, LatticeStep::BelowRight,
                                                          LatticeStep::AboveLeft, LatticeStep::AboveRight};

constexpr Site neighbour(Site site, LatticeStep step)
{
    const std::int32_t left = site.column - (site.row % 2 == 0 ? 1 : 0);  // left neighbour in the rows above and below
    switch (step) {
        case LatticeStep::Left:
            return {site.row, site.column - 1};
        case LatticeStep::Right:
            return {site.row, site.column + 1};
        case LatticeStep::BelowLeft:
            return {site.row - 1, left};
        case LatticeStep::BelowRight:
            return {site.row - 1, left + 1};
        case LatticeStep::AboveLeft:
            return {site.row + 1, left};
        case LatticeStep::AboveRight:
            break;
    }
    return {site.row + 1, left + 1};
}

/// Six neighbours of a lattice point, in the order of kLatticeSteps.
constexpr std::array<Site, 6> neighboursOf(Site site)
{
    std::array<Site, 6> neighbours{};
    for (std::size_t k = 0; k < kLatticeSteps.size(); ++k) {
        neighbours[k] = neighbour(site, kLatticeSteps[k]);
    }
    return neighbours;
}

/// Converts a point of the lattice with twice the edge to a point of this lattice. Its six neighbours here are half-way
/// to its neighbours there.
constexpr Site toFiner(Site coarse)
{
    return {2 * coarse.row, 2 * coarse.column + (coarse.row & 1)};
}

/// Two points of the lattice with twice the edge between which a point lies half-way; the same point twice if it is one
/// of them.
constexpr std::array<Site, 2> toCoarser(Site fine)
{
    const std::int32_t low = fine.row >> 1;
    const std::int32_t odd = low & 1;
    const std::int32_t column = fine.column - odd;
    if ((fine.row & 1) == 0) {
        return {{{low, column >> 1}, {low, (column + 1) >> 1}}};
    }
    // Row low + 1 begins half an edge further left or right, so there the halves are exchanged.
    return {{{low, (column + 1) >> 1}, {low + 1, (fine.column + odd) >> 1}}};
}

}  // namespace droplet
