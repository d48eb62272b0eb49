// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/footprint/outline.h"

namespace droplet {

/// The ground one droplet covers: an outer rim and the dry holes in it.
struct Footprint {
    Loop rim;                 ///< counter-clockwise
    std::vector<Loop> holes;  ///< clockwise, inside rim, apart from one another
};

/// The separate droplets of an outline. An island in a hole is a droplet of its own.
struct Domain {
    std::vector<Footprint> droplets;  ///< in the order their rims appear in the outline; at least one
    Vec2 extent;                      ///< physical size of the image [m], for texture coordinates
};

/// Sorts the loops of an outline into droplets and their holes by nesting.
/// @param outline  loops that do not cross
/// @throws Error   InvalidInput if no loop encloses liquid, or a hole lies in no rim
Domain split(const Outline& outline);

/// Area of liquid on the ground, holes taken out [m²].
double area(const Footprint& footprint);

/// Length of the contact line, holes included [m].
double rimLength(const Footprint& footprint);

}  // namespace droplet
