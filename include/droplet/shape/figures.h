// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/shape/capillary_surface.h"
#include "droplet/shape/solve.h"

namespace droplet {

/// Contact angles along a rim.
struct ContactAngle {
    double min = 0.0;   ///< smallest angle [rad]
    double mean = 0.0;  ///< mean by rim length [rad]
    double max = 0.0;   ///< largest angle [rad]
    Vec2 min_at;        ///< point of the smallest angle [m]
    Vec2 max_at;        ///< point of the largest angle [m]
};

/// Measured figures of one solved droplet, or of several together. All integrals are over the mesh itself.
struct ShapeFigures {
    double footprint_area = 0.0;   ///< [m²]
    double rim_length = 0.0;       ///< [m]
    double dry_area = 0.0;         ///< part of the footprint that the liquid left dry [m²]
    double volume = 0.0;           ///< ∫(u − h) [m³]
    double height_max = 0.0;       ///< largest u − h [m]
    double depth_max = 0.0;        ///< largest h − u: how far the surface sinks into the ground [m]
    double overhang = 0.0;         ///< how far the liquid leans out over its rim, seen from above [m]
    double liquid_area = 0.0;      ///< ∫√(1+|∇u|²) where it is wet: true area of the liquid's surface [m²]
    double linear_area = 0.0;      ///< ∫(1 + ½|∇u|²) where it is wet: that area in the linear model [m²]
    double surface_energy = 0.0;   ///< σ · liquid_area [J]
    double gravity_energy = 0.0;   ///< ½ρg⊥∫(u² − h²) − ρ∫(g∥·x)(u − h) [J]
    double slope_max = 0.0;        ///< slope of the steepest triangle [rad]
    double steep_area = 0.0;       ///< part of the footprint under triangles steeper than 50° [m²]
    double bond_number = 0.0;      ///< ρ|g|A/(πσ): weight against surface tension, for a disc of the same area
    double projected_width = 0.0;  ///< ½∮|n·d|: width of the rim, seen from downhill; 0 without tilt [m]
    ContactAngle contact_angle;    ///< contact angles along the rim
    /// Height of an infinite puddle with the mean contact angle θ, 2 √(σ/ρg) sin(θ/2) [m]; empty unless the ground is
    /// level and flat.
    std::optional<double> height_bound = {};
};

/// Contact angles between which a rim stays in place.
struct Hysteresis {
    double advancing = 0.0;  ///< beyond it the rim moves out [rad]
    double receding = 0.0;   ///< below it the rim moves in [rad]

    /// Checks both angles.
    /// @throws Error InvalidArgument unless 0 ≤ receding ≤ advancing ≤ π
    void validate() const;
};

/// Forces that decide whether a droplet stays in place on a tilted plane.
struct Retention {
    double driving_force = 0.0;    ///< ρV|g∥|: weight along the plane, downhill [N]
    double retention_force = 0.0;  ///< largest retention σw(cos θ_R − cos θ_A); w is the projected width [N]

    /// Whether the droplet would slide.
    [[nodiscard]] bool wouldSlide() const { return driving_force > retention_force; }
};

/// Balance of forces by C. G. L. Furmidge, "Studies at phase interfaces" (1962), for a rim of any shape. The retention
/// is largest if the contact angle is θ_A wherever the rim faces downhill, and θ_R elsewhere.
/// @param figures     figures of the droplet
/// @param options     options it was solved with
/// @param hysteresis  advancing and receding angle
/// @throws Error      InvalidArgument
Retention retention(const ShapeFigures& figures, const SolveOptions& options, const Hysteresis& hysteresis);

/// Measures one droplet. Areas of the linear model and of steep triangles are 0 unless it is a height field.
/// @param surface  of the droplet
/// @param options  options it was solved with
ShapeFigures measure(const CapillarySurface& surface, const SolveOptions& options);

/// Combines the figures of several droplets: sums, extremes (also of the Bond number), and means by rim length.
ShapeFigures combine(const std::vector<ShapeFigures>& droplets);

}  // namespace droplet
