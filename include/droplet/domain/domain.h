// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/outline/outline.h"

namespace droplet {

/// Region of the ground that one droplet wets: an outer rim and the dry holes inside it.
struct Footprint {
    Loop rim;                 ///< counter-clockwise
    std::vector<Loop> holes;  ///< clockwise; inside the rim, not touching one another
};

/// Droplets of an outline. An island in a hole is a droplet of its own.
struct Domain {
    std::vector<Footprint> droplets;  ///< at least one; in the order of their rims in the outline
    Vec2 extent;                      ///< physical size of the image [m], for texture coordinates
};

/// Sorts the loops of an outline into droplets and their holes.
/// @param outline  its loops do not cross
/// @throws Error   InvalidInput if no loop encloses liquid, or a hole lies outside of all rims
Domain split(const Outline& outline);

/// Wetted area of a footprint, without its holes [m²].
double area(const Footprint& footprint);

/// Length of the contact line, rims of holes included [m].
double rimLength(const Footprint& footprint);

}  // namespace droplet
