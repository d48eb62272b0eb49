// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "droplet/flow/flow_surface.h"
#include "droplet/flow/pond.h"
#include "droplet/vector.h"
#include "flow/hollow.h"

namespace droplet {

/// A puddle beside walls.
struct Puddle {
    bool is_blocked = false;   ///< walls are in the way of the disc that it covers on flat ground
    std::optional<Pond> pond;  ///< if they are and the floor between them has room for it
};

/// Spreads liquid over the floor around it, between walls that are higher than it is thick on flat ground.
/// @param surface  of the ground
/// @param up       unit, normal of the level
/// @param liquid   at rest
Puddle puddleAround(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid);

/// Greatest height of liquid on flat ground, as a cap or a puddle [m].
double thicknessOf(const RestingLiquid& liquid);

/// Area that liquid covers on flat ground, as a cap or a puddle [m²].
double flatArea(const RestingLiquid& liquid);

}  // namespace droplet
