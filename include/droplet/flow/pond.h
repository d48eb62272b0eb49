// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Liquid that fills a hollow of the ground up to a level.
struct Pond {
    Vec3 up;               ///< unit, normal of the level
    double level = 0.0;    ///< dot(up, p) for places p on it [m]
    double dome = 0.0;     ///< volume over a level at the brim, which surface tension holds [m³], ≥ 0
    double area = 0.0;     ///< of the level [m²], > 0
    double bending = 0.0;  ///< capillary length √(σ/(ρ g)), over which the dome falls to its rim [m], > 0
    std::vector<std::uint32_t> faces;  ///< numbers in FlowSurface::faces of the ground that it wets, ascending
};

}  // namespace droplet
