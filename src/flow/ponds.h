// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "droplet/flow/flow_droplet.h"
#include "droplet/flow/flow_parameters.h"
#include "droplet/flow/flow_terrain.h"
#include "flow/flow_forces.h"
#include "flow/hollow.h"

namespace droplet {

/// Where and when droplets may be ponds.
struct PondField {
    const FlowTerrain::Content& terrain;
    const FlowParameters& parameters;
    FlowField field;    ///< at the time
    double time = 0.0;  ///< [s]
};

/// Where a droplet is.
struct Standing {
    Vec3 place;           ///< at the field's time [m]
    double radius = 0.0;  ///< of its contact circle [m]
};

Standing standingOf(const PondField& at, const FlowDroplet& droplet);

/// A droplet as if it lay at rest where it is; gravity must not be 0.
RestingLiquid restingLiquid(const PondField& at, const FlowDroplet& droplet, const Standing& standing);

/// The level of a droplet's liquid, if it fills a hollow. At rest it is normal to gravity, with the acceleration of the
/// ground. A pond that sloshes has the acceleration of its droplet, and its level is normal to what is left of gravity
/// then; where no hollow holds it so, the level is as at rest.
/// @return  empty for a droplet that is no pond, in the air or without gravity
std::optional<FilledHollow> pondOf(const PondField& at, const FlowDroplet& droplet, const Standing& standing);

}  // namespace droplet
