// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "droplet/domain/domain.h"

namespace droplet {

/// Ground that one droplet of each of two domains covers.
struct Overlap {
    std::size_t first = 0;   ///< droplet of the first domain
    std::size_t second = 0;  ///< droplet of the second domain
    double area = 0.0;       ///< [m²], > 0

    /// Whether both droplets and the area are equal.
    friend bool operator==(const Overlap&, const Overlap&) = default;
};

/// Finds the droplets of two domains that overlap, and by how much.
///
/// An area is the length of overlap along rows, which is exact, times the distance of the rows. Its error is about the
/// distance of the rows times the height of the overlap. Time and memory grow with the loops' points and with the rows
/// that they cross.
/// @param first   its droplets do not overlap one another
/// @param second  likewise
/// @param row     distance of the rows [m], > 0; half a pixel is a good value
/// @return        in ascending order of first, then of second
/// @throws Error  InvalidArgument
std::vector<Overlap> overlaps(const Domain& first, const Domain& second, double row);

}  // namespace droplet
