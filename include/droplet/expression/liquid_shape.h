// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/outline/outline.h"

namespace droplet {

/// Layer of a drawing of liquid.
enum class LiquidLayer {
    Liquid,    ///< connected liquid and its holes
    Foam,      ///< air inside of liquid that an eraser made: loops run clockwise, each is also a hole of Liquid
    Droplets,  ///< small detached bodies
};

/// Outlines of a 2D liquid at one moment.
/// Invariant: loops are closed and do not cross; liquid lies on their left.
struct LiquidShape {
    double time = 0.0;           ///< [s]
    std::vector<Loop> liquid;    ///< rims counter-clockwise, holes clockwise, holes of foam among them
    std::vector<Loop> foam;      ///< those of the holes that are foam
    std::vector<Loop> droplets;  ///< rims of detached droplets

    /// Area of liquid: of all liquid and droplets without holes [m²].
    [[nodiscard]] double area() const;
};

}  // namespace droplet
