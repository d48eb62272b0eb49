// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Front of a puddle that lies against walls and covers only a part of the floor between them. Ways go over the ground,
/// around walls, and are measured as seen along Pond::up.
struct PondFront {
    double way = 0.0;           ///< from the middle of the puddle to its front [m], > 0
    double bend = 0.0;          ///< width along the front in which the liquid falls to the floor [m], > 0
    double floor = 0.0;         ///< dot(up, p) of the ground in the middle [m]
    double volume = 0.0;        ///< of the puddle [m³], > 0
    std::vector<Vec3> sources;  ///< of Pond::faces, from where ways to their places are straight lines [m]
};

/// Liquid that fills a hollow of the ground up to a level.
struct Pond {
    Vec3 up;               ///< unit, normal of the level
    double level = 0.0;    ///< dot(up, p) for places p on it [m]
    double dome = 0.0;     ///< volume over a level at the brim, which surface tension holds [m³], ≥ 0
    double area = 0.0;     ///< of the level [m²], > 0
    double bending = 0.0;  ///< capillary length √(σ/(ρ g)), over which the dome falls to its rim [m], > 0
    std::vector<std::uint32_t> faces;  ///< numbers in FlowSurface::faces of the ground that it wets, ascending
    std::optional<PondFront> front;    ///< of a puddle that does not cover its floor

    /// Height dot(up, p) of the liquid over a place of the ground, without the dome: the level, or less in the bend
    /// along a front, and below the floor beyond it.
    /// @param k      number in `faces`
    /// @param place  on this face [m]
    [[nodiscard]] double heightOver(std::size_t k, Vec3 place) const;
};

}  // namespace droplet
