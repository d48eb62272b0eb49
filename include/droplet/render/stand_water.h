// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Where a droplet stands: about an ellipse in a plane.
struct DropletBase {
    Vec3 place;                ///< its centre [m]
    Vec3 ahead;                ///< along its length, unit
    Vec3 normal;               ///< of the ground, unit, perpendicular to `ahead`
    double half_length = 0.0;  ///< [m], > 0
    double half_width = 0.0;   ///< [m], > 0
    double height = 0.0;       ///< of the droplet [m], > 0
};

/// Water on a stand with many small droplets: what they do to the light there, and the film that they left. The film is
/// on the front of the triangles, where their vertices run counter-clockwise.
///
/// The film is given on a grid over every triangle with corners A, B and C: for i and j ≥ 0 with i + j ≤ n, at
/// A + i/n (B − A) + j/n (C − A), in the order of j, then i.
struct StandWater {
    std::vector<DropletBase> bases;        ///< of the droplets
    std::vector<std::uint16_t> divisions;  ///< n of every triangle of the stand; 0: dry. Or empty: all are dry
    std::vector<std::uint32_t> first;      ///< index in `film` of every triangle's first value
    std::vector<float> film;               ///< thickness of the film [m], ≥ 0

    /// Checks lengths and ranges.
    /// @param triangles  of the stand
    /// @throws Error     InvalidArgument
    void validate(std::size_t triangles) const;
};

}  // namespace droplet
