// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "droplet/vector.h"

namespace droplet {

/// A piece of a droplet's path along which the force is constant but for viscous friction: p'' = push − decay · p'.
struct Leg {
    double begin = 0.0;  ///< [s]
    Vec3 place;          ///< at begin [m]
    Vec3 velocity;       ///< at begin [m/s]
    Vec3 push;           ///< force over mass [m/s²]
    double decay = 0.0;  ///< viscous friction over mass, |k_f|/m [1/s], ≥ 0

    /// Place at a time, p(τ) [m].
    /// @param time  [s], ≥ begin
    [[nodiscard]] Vec3 placeAt(double time) const;
    /// Velocity at a time, v(τ) [m/s].
    /// @param time  [s], ≥ begin
    [[nodiscard]] Vec3 velocityAt(double time) const;
};

/// One coordinate of such a motion from time 0 on: s'' = push − decay · s'.
struct Coordinate {
    double place = 0.0;     ///< at 0 [m]
    double velocity = 0.0;  ///< at 0 [m/s]
    double push = 0.0;      ///< [m/s²]
    double decay = 0.0;     ///< [1/s], ≥ 0

    /// Value at a time [m].
    [[nodiscard]] double placeAt(double time) const;
    /// Velocity at a time [m/s].
    [[nodiscard]] double velocityAt(double time) const;

    /// When the coordinate first passes 0 downwards. Where it is below 0 already at `from`, and falls, that is `from`.
    /// @param from  [s], ≥ 0
    /// @param to    [s], ≥ from
    /// @return      in [from, to], exact to rounding, and the same for every `to`; empty if it does not pass
    [[nodiscard]] std::optional<double> fallsBelowZero(double from, double to) const;

    /// When the velocity changes its sign.
    /// @return  [s], > 0; empty if it does not
    [[nodiscard]] std::optional<double> turns() const;
};

}  // namespace droplet
