// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// A closed polygon, the first point not repeated at the end; it may cross itself, run either way, or enclose nothing.
using Contour = std::vector<Vec2>;

/// What contours enclose together.
struct United {
    std::vector<Contour>
        loops;               ///< outer counter-clockwise, holes clockwise; none crosses or touches another or itself
    std::size_t specks = 0;  ///< loops that were dropped
};

/// The union of contours by the non-zero rule, whichever way they run.
///
/// Lengths are in ems: points are rounded to 2⁻²⁶. Where the union touches itself, in a point or along a line, the two
/// sides are parted by 2⁻¹²; only contours that do so are changed.
/// @param contours  coordinates at most 2²⁰ in size
/// @param speck     loops that enclose less are dropped [em²], ≥ 0
/// @return          loops from left to right, by their leftmost points
/// @throws Error    InvalidInput if loops cannot be parted
United unite(const std::vector<Contour>& contours, double speck);

}  // namespace droplet
