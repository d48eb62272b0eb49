// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "shape/area_vector.h"

namespace droplet {

/// Place where sheets touch.
struct SheetContact {
    std::size_t first = 0;   ///< index of a sheet
    std::size_t second = 0;  ///< of the other one, or the same
    Vec3 place;              ///< [m]
};

/// First place where triangles cross or touch that do not share a vertex: of one sheet, or of two.
///
/// Guarantees: exact; the same input gives the same result at any number of threads.
/// @param clusters  number of every sheet's cluster; different sheets of one cluster may touch. Empty: none may
std::optional<SheetContact> firstContact(const std::vector<const CapillarySurface*>& sheets,
                                         const std::vector<std::size_t>& clusters = {});

}  // namespace droplet
