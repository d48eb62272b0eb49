// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/flow_io/flow_object.h"

namespace droplet {

/// What catches the water below an object.
enum class Floor {
    Plate,  ///< level square, two and a half times as wide as the object
    Dish,   ///< round, half as wide again as the object, with a bottom and a wall that rises outward
};

/// Adds a floor just below an object, centred under it, as more triangles with the material `floor`. Its texture
/// coordinates are one point, so that textures of the object have no part of it.
FlowObject onFloor(FlowObject object, Floor floor);

}  // namespace droplet
