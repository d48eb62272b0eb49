// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/liquid2d/fluid.h"

namespace droplet {

/// Liquid that appears in a disc.
struct Pour {
    Vec2 middle;          ///< of the disc [m]
    double radius = 0.1;  ///< of the disc [m], > 0
    Vec2 velocity{};      ///< of the liquid [m/s]

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Adds liquid where a disc has room: beside walls and what is there already, up to the scene's max_particles.
/// @param state   from startFluid() or advanceFluid(), for the same scene
/// @param scene   valid
/// @param pour    valid
/// @throws Error  InvalidArgument if an argument is out of its range
FluidState poured(FluidState state, const FluidScene& scene, const Pour& pour);

/// Straight movement of a round stirrer.
struct Stir {
    Vec2 from;             ///< where its middle was [m]
    Vec2 to;               ///< where its middle is [m]
    double radius = 0.1;   ///< [m], > 0
    double seconds = 0.0;  ///< that the movement took, > 0

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Gives liquid on the way of a stirrer its velocity: wholly in its middle, less towards its rim. The pressure of the
/// next step pushes the rest aside.
/// @param state   from startFluid() or advanceFluid()
/// @param stir    valid
/// @throws Error  InvalidArgument if an argument is out of its range
FluidState stirred(FluidState state, const Stir& stir);

}  // namespace droplet
