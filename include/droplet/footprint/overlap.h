// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "droplet/footprint/domain.h"

namespace droplet {

/// The ground that a droplet of one domain and one of another both cover.
struct Overlap {
    std::size_t first = 0;   ///< droplet of the first domain
    std::size_t second = 0;  ///< droplet of the second domain
    double area = 0.0;       ///< [m²], > 0

    friend bool operator==(const Overlap&, const Overlap&) = default;
};

/// Which droplets of two domains lie over one another, and how much.
///
/// Areas are lengths of overlap along rows, exact, times the rows' distance: good to about a row's distance times the
/// overlap's height. Time and memory grow with the loops' points and the rows they cross.
/// @param row    distance of the rows, such as half a pixel [m], > 0
/// @return       by ascending first, then second
/// @throws Error InvalidArgument
std::vector<Overlap> overlaps(const Domain& first, const Domain& second, double row);

}  // namespace droplet
