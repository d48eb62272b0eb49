// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/flow_io/flow_object.h"
#include "droplet/vector.h"

namespace droplet {

/// What catches the water below an object.
enum class Floor {
    Plate,  ///< level square, two and a half times as wide as the object
    Dish,   ///< round, half as wide again as the object, with a bottom and a wall that rises outward
};

/// Adds a floor just below an object, centred under it, as more triangles with the material `floor`. Its texture
/// coordinates are one point, so that textures of the object have no part of it.
/// @param object  of one shape or, with `shapes`, one that deforms
/// @param floor   what is added
/// @param shapes  vertices of the object in all frames, if it deforms; the floor is below all of them, rests, and is
///                added to each. Empty otherwise.
FlowObject onFloor(FlowObject object, Floor floor, std::vector<std::vector<Vec3>>& shapes);

/// The same for an object that keeps its shape.
FlowObject onFloor(FlowObject object, Floor floor);

}  // namespace droplet
