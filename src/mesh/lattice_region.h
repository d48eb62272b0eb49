// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Columns begin … end − 1 of a lattice row.
struct ColumnInterval {
    std::int32_t begin = 0;
    std::int32_t end = 0;
};

/// A set of lattice points (see latticePoint), as intervals of columns: all work on it is in proportion to its outline,
/// not to its area.
class LatticeRegion {
public:
    using Row = std::vector<ColumnInterval>;  ///< ascending, with gaps between

    LatticeRegion() = default;
    LatticeRegion(std::int32_t first_row, std::vector<Row> rows) : first_row_(first_row), rows_(std::move(rows)) {}

    [[nodiscard]] std::int32_t firstRow() const { return first_row_; }
    [[nodiscard]] std::int32_t endRow() const { return first_row_ + static_cast<std::int32_t>(rows_.size()); }
    /// Empty outside [firstRow(), endRow()).
    [[nodiscard]] const Row& row(std::int32_t row) const;
    [[nodiscard]] bool contains(std::int32_t row, std::int32_t column) const;
    [[nodiscard]] std::size_t size() const;

private:
    std::int32_t first_row_ = 0;
    std::vector<Row> rows_;
};

/// The points inside polygons (outer counter-clockwise, holes clockwise, not crossing) that are at least `clearance`
/// away from them.
LatticeRegion pointsInside(const std::vector<std::vector<Vec2>>& polygons, double edge, double clearance);

/// The points all six neighbours of which belong to the region.
LatticeRegion eroded(const LatticeRegion& region);

/// The points of one row set that are not in the other.
LatticeRegion::Row minus(const LatticeRegion::Row& row, const LatticeRegion::Row& removed);

/// The points of both.
LatticeRegion::Row common(const LatticeRegion::Row& a, const LatticeRegion::Row& b);

/// Moved to the right, and shortened at the end; what becomes empty is gone.
LatticeRegion::Row shifted(const LatticeRegion::Row& row, std::int32_t by, std::int32_t shorter = 0);

/// The points of any of several rows, in whatever order their intervals come.
LatticeRegion::Row united(LatticeRegion::Row intervals);

/// Neighbours of a point in the rows above and below: column + leftOf(row) and the next.
constexpr std::int32_t leftOf(std::int32_t row)
{
    return row % 2 == 0 ? -1 : 0;
}

}  // namespace droplet
