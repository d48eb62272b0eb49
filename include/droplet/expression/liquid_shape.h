// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/outline/outline.h"
#include "droplet/vector.h"

namespace droplet {

/// Layer of a drawing of liquid.
enum class LiquidLayer {
    Liquid,    ///< connected liquid and its holes
    Foam,      ///< air inside of liquid that an eraser made: loops run clockwise, each is also a hole of Liquid
    Droplets,  ///< small detached bodies
};

/// Hole of a liquid, followed from frame to frame.
struct LiquidHole {
    Vec2 centre;                  ///< of its area [m]
    double area = 0.0;            ///< [m²]
    double reach = 0.0;           ///< largest distance of its rim from the centre [m]
    double clearance = 0.0;       ///< least distance of its rim from the centre [m]; 0 if that lies outside
    double seen = 0.0;            ///< time at which it opened [s]
    std::optional<double> shown;  ///< time from which on it is drawn [s]; empty: not yet
    std::optional<Vec2> gap;      ///< gap in a thin bridge, by which it is open until it is drawn [m]; empty: none

    friend bool operator==(const LiquidHole&, const LiquidHole&) = default;  ///< Compares all members.
};

/// Outlines of a 2D liquid at one moment.
/// Invariant: loops are closed; those of the liquid do not cross; liquid lies on their left. Droplets are drawn one by
/// one, and may overlap.
struct LiquidShape {
    double time = 0.0;              ///< [s]
    std::vector<Loop> liquid;       ///< rims counter-clockwise, holes clockwise, holes of foam among them
    std::vector<Loop> foam;         ///< those of the holes that are foam
    std::vector<Loop> droplets;     ///< rims of detached droplets
    std::vector<LiquidHole> holes;  ///< of the liquid, also those that are not drawn yet

    /// Area of liquid: of all liquid and droplets without holes [m²].
    [[nodiscard]] double area() const;
};

}  // namespace droplet
