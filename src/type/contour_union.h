// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Closed polygon; the first point is not repeated. It may cross itself, have any direction, or enclose nothing.
using Contour = std::vector<Vec2>;

/// Union of contours.
struct United {
    std::vector<Contour> loops;  ///< outer loops counter-clockwise, holes clockwise; they do not cross or touch
    std::size_t specks = 0;      ///< number of loops that were dropped
};

/// Unites contours by the non-zero rule.
///
/// Lengths are in ems; points are rounded to 2⁻²⁶. If the union touches itself, in a point or along a line, all its
/// sides move so that 2⁻¹² is between them; otherwise none does.
/// @param contours  coordinates with magnitudes up to 2²⁰
/// @param speck     smallest area of a loop that is kept [em²], ≥ 0
/// @return          loops from left to right, by their leftmost points
/// @throws Error    InvalidInput: loops cannot be separated
United unite(const std::vector<Contour>& contours, double speck);

/// Area that contours wind around, by the non-zero rule, with points on the same grid. Unlike loops of unite(), those
/// of the result may touch, so nothing moves.
std::vector<Contour> enclosed(const std::vector<Contour>& contours);

/// Parts of an area.
struct Parts {
    std::vector<Contour> inside;   ///< inside of another area
    std::vector<Contour> slivers;  ///< outside of it, but narrow there, where the whole area is wide
    std::vector<Contour> outside;  ///< the rest
};

/// Divides an area by another one.
/// @param area    result of enclosed() or divide()
/// @param by      the same
/// @param narrow  width up to which a part is a sliver [em], ≥ 0
/// @throws Error  InvalidInput: the parts cannot be found
Parts divide(const std::vector<Contour>& area, const std::vector<Contour>& by, double narrow);

}  // namespace droplet
