// SPDX-License-Identifier: GPL-3.0-or-later
// Hollows of the ground that fill with liquid until they run over.
#pragma once

#include <cstdint>
#include <optional>

#include "droplet/flow/flow_surface.h"
#include "droplet/flow/pond.h"
#include "droplet/vector.h"

namespace droplet {

/// Liquid at rest.
struct RestingLiquid {
    std::uint32_t face = 0;
    Vec3 place;                  ///< on the face [m]
    double volume = 0.0;         ///< [m³], > 0
    double radius = 0.0;         ///< of its contact circle on flat ground [m]
    double contact_angle = 0.0;  ///< [rad]
    double puddle = 0.0;         ///< height of a large puddle of it on flat ground, 2 √(σ/(ρ g)) sin(θ/2) [m]
};

/// Where liquid runs over the brim of a hollow.
struct Brim {
    std::uint32_t face = 0;  ///< beyond the brim; at the open edge of the surface, the last one before it
    Vec3 place;              ///< on the brim [m]
    Vec3 ahead;              ///< unit; down the face, or away from the surface
    bool is_open = false;    ///< beyond it is nothing
    double capacity = 0.0;   ///< of the hollow up to the brim [m³]
    double held = 0.0;       ///< with what surface tension holds above it [m³]
};

/// What is known of the ground around liquid.
struct Hollow {
    std::optional<Brim> brim;  ///< where the liquid runs over
    double held = 0.0;         ///< if it does not: so much would not either, at least what there is [m³]
};

/// Where liquid runs over: if it lies in a hollow and is more than what fills it and stands over its brim by surface
/// tension, as a cap or a puddle over the hollow's area.
/// @param surface  of the ground
/// @param up       unit, against gravity
/// @param liquid   at rest
Hollow hollowAround(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid);

/// A pond, and where it would run over next.
struct FilledHollow {
    Pond pond;
    std::optional<std::uint32_t> beyond;  ///< if it stands over its brim, the face beyond; empty at an open edge, too
};

/// The level that liquid in a hollow has. It is a pond if the hollow is as deep as the liquid is thick on flat ground,
/// or smaller than what it would cover there. If it does not fill the hollow, but walls are in the way of its disc, it
/// is a puddle with a front (puddleAround). Otherwise it is a droplet like any other. Liquid that its hollow does not
/// hold, as before it runs over, is a pond if most of it is below the brim.
/// @param surface  of the ground
/// @param up       unit, normal of the level
/// @param liquid   at rest
std::optional<FilledHollow> pondAround(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid);

}  // namespace droplet
