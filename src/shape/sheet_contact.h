// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "shape/sheet_mesh.h"

namespace droplet {

/// Place where sheets touch.
struct SheetContact {
    std::size_t first = 0;   ///< index of a sheet
    std::size_t second = 0;  ///< of the other one, or the same
    Vec3 place;              ///< [m]
};

/// Pairs of sheets that have a part of their rims in common, and so always touch; the smaller index first.
using SharedRims = std::set<std::pair<std::size_t, std::size_t>>;

/// First place where triangles cross or touch that do not share a vertex: of one sheet, or of two.
///
/// Guarantees: exact; the same input gives the same result at any number of threads.
/// @param shared  pairs that may touch
std::optional<SheetContact> firstContact(const std::vector<const SheetMesh*>& sheets, const SharedRims& shared = {});

}  // namespace droplet
