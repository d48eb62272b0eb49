// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "droplet/vector.h"
#include "mesh/lattice_site.h"

namespace droplet {

/// Neighbouring points of one lattice row: columns begin … end − 1.
struct RowInterval {
    std::int32_t row = 0;
    std::int32_t begin = 0;
    std::int32_t end = 0;

    [[nodiscard]] constexpr std::uint32_t size() const { return static_cast<std::uint32_t>(end - begin); }
    [[nodiscard]] constexpr Site first() const { return {row, begin}; }
    [[nodiscard]] constexpr Site last() const { return {row, end - 1}; }

    /// Row by row, from left to right.
    friend bool operator<(const RowInterval& a, const RowInterval& b)
    {
        return a.row != b.row ? a.row < b.row : a.begin < b.begin;
    }
};

/// Set of lattice points, stored as intervals of rows. All operations take time in proportion to its outline, not to
/// its area.
class LatticeRegion {
public:
    LatticeRegion() = default;
    /// Union of several intervals, which may be empty, overlap, and come in any order.
    explicit LatticeRegion(std::vector<RowInterval> intervals);

    /// Row by row, from left to right; not empty, with gaps between them.
    [[nodiscard]] const std::vector<RowInterval>& intervals() const& { return intervals_; }
    [[nodiscard]] std::vector<RowInterval> intervals() && { return std::move(intervals_); }
    [[nodiscard]] bool empty() const { return intervals_.empty(); }

    /// First row; the region must not be empty.
    [[nodiscard]] std::int32_t firstRow() const { return intervals_.front().row; }
    /// One past the last row; the region must not be empty.
    [[nodiscard]] std::int32_t endRow() const { return intervals_.back().row + 1; }
    [[nodiscard]] std::span<const RowInterval> row(std::int32_t row) const;

    [[nodiscard]] bool contains(Site site) const;
    /// Index of the interval that holds a point of the region.
    [[nodiscard]] std::size_t intervalOf(Site site) const;

    /// Number of points.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] std::vector<Site> sites() const;

private:
    std::vector<RowInterval> intervals_;
    std::vector<std::uint32_t> row_starts_;  ///< indices into intervals_ for each row from firstRow() on, and the end
};

/// Points that belong to both regions.
LatticeRegion common(const LatticeRegion& a, const LatticeRegion& b);

/// Points of a region that are not in the other.
LatticeRegion without(const LatticeRegion& region, const LatticeRegion& removed);

/// All points moved by one step.
LatticeRegion moved(const LatticeRegion& region, LatticeStep step);

/// Points whose six neighbours all belong to the region.
LatticeRegion eroded(const LatticeRegion& region);

/// Points that belong to the lattice of twice the edge, as points of that lattice.
LatticeRegion everySecond(const LatticeRegion& region);

/// Points inside polygons (outer counter-clockwise, holes clockwise, not crossing) that are at least `clearance` away
/// from them.
LatticeRegion pointsInside(const std::vector<std::vector<Vec2>>& polygons, double edge, double clearance);

}  // namespace droplet
