// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Region of the plane, bounded by closed polylines, by the even-odd rule.
/// Invariant: every loop has at least three points, all finite.
struct Region {
    std::vector<std::vector<Vec2>> loops;  ///< [m], y up; the first point is not repeated at the end
};

/// Region of a rectangle.
Region rectangle(Vec2 lower, Vec2 upper);

/// Region of a regular polygon with 96 corners and the area of the circle.
Region circle(Vec2 centre, double radius);

/// Liquid at the start.
struct LiquidBody {
    Region region;       ///< filled with particles, but for walls, earlier bodies and what is beyond the margin
    Vec2 velocity{};     ///< [m/s]
    double spin = 0.0;   ///< angular velocity about the region's centroid, positive counter-clockwise [rad/s]
    bool rings = false;  ///< whether a disc's particles lie in rings: a lattice makes steps at its rim
};

/// Oscillation of a wall about its place: displacement amplitude·sin(2πt/period + phase).
struct WallMotion {
    Vec2 amplitude{};     ///< of the displacement [m]
    double swing = 0.0;   ///< amplitude of the rotation about `pivot` [rad]
    Vec2 pivot{};         ///< [m]
    double period = 1.0;  ///< [s], > 0
    double phase = 0.0;   ///< [rad]
    double begin = 0.0;   ///< time before which the wall rests at its place [s]; it starts smoothly
};

/// Solid that liquid cannot enter.
struct Wall {
    Region region;                     ///< at rest
    std::optional<WallMotion> motion;  ///< empty: fixed
    bool visible = true;               ///< whether pictures show it
};

/// Source of liquid: a nozzle with a straight opening.
struct Emitter {
    Vec2 position{};     ///< middle of the opening [m]
    Vec2 velocity{};     ///< of the liquid, at right angles to the opening [m/s], not zero
    double width = 0.0;  ///< of the opening [m], > 0
    double begin = 0.0;  ///< [s]
    double end = 1e9;    ///< [s]
};

/// Everything that a simulation of a 2D liquid starts from.
struct FluidScene {
    Vec2 size{4.0, 2.25};             ///< of the shown window, its lower left corner at the origin [m], > 0
    double spacing = 0.02;            ///< distance of particles at rest [m], > 0
    Vec2 gravity{0.0, -9.81};         ///< [m/s²]
    double density = 1000.0;          ///< [kg/m³], > 0
    double surface_tension = 0.0;     ///< [N/m], ≥ 0
    std::optional<double> viscosity;  ///< kinematic [m²/s], ≥ 0; empty: as little as keeps the particles in order
    double margin = 0.5;              ///< particles farther than this outside of the window are removed [m], ≥ 0
    std::size_t max_particles = 1000000;  ///< emitters stop there
    std::vector<LiquidBody> liquid;       ///< at the start
    std::vector<Wall> walls;              ///< solids
    std::vector<Emitter> emitters;        ///< sources

    /// Checks all ranges.
    /// @throws Error InvalidArgument, naming field, value and constraint
    void validate() const;
};

}  // namespace droplet
