// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Film of heavy rain that runs off the glass in sheets and rivulets: its water in square cells of the unrolled glass.
/// Amounts are whole numbers, so that water goes from cell to cell without a rest.
struct Runoff {
    static constexpr double kThickness = 1e-11;  ///< unit of `thickness` [m]

    double cell = 0.0;                    ///< width of a cell [m]
    std::uint32_t columns = 0;            ///< number of cells across
    std::uint32_t rows = 0;               ///< number of cells up
    std::vector<std::int32_t> thickness;  ///< mean over a cell, row by row from the lower left; empty: there is no film
    double rest = 0.0;                    ///< water for the film that is less than one unit of a cell [m³]
    std::uint64_t next_break = 0;         ///< number of the next step in which it breaks up
    Vec2 drift;                           ///< way that the small waves on it have run since the start [m]

    /// Volume of all its water [m³].
    [[nodiscard]] double volume() const;

    friend bool operator==(const Runoff&, const Runoff&) = default;  ///< Compares all members.
};

}  // namespace droplet
