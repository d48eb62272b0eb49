// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Thickness of mist at which it grows no more [m]: a breath figure of droplets with radii of 30 µm that cover 0.55 of
/// the glass (D. Beysens, "The formation of dew", Atmospheric Research 39 (1995) 215) has this much water.
inline constexpr double kDenseMist = 10e-6;

/// Mist on the glass: droplets too small to be told apart, as the mean thickness of their water in square cells of the
/// unrolled glass.
struct Mist {
    double cell = 0.0;             ///< width of a cell [m]
    std::uint32_t columns = 0;     ///< number of cells across
    std::uint32_t rows = 0;        ///< number of cells up
    std::vector<float> thickness;  ///< [m], row by row from the lower left; empty: there is no mist

    /// Volume of all its water [m³].
    [[nodiscard]] double volume() const;

    friend bool operator==(const Mist&, const Mist&) = default;  ///< Compares all members.
};

}  // namespace droplet
