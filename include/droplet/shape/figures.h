// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"

namespace droplet {

/// Smallest, mean (by rim length) and largest contact angle along a rim [rad], and where on it.
struct ContactAngle {
    double min = 0.0;
    double mean = 0.0;
    double max = 0.0;
    Vec2 min_at;  ///< [m]
    Vec2 max_at;  ///< [m]
};

/// What can be measured on a solved droplet, or on several together; all integrals over the mesh itself.
struct ShapeFigures {
    double footprint_area = 0.0;  ///< [m²]
    double rim_length = 0.0;      ///< [m]
    double dry_area = 0.0;        ///< of the footprint, where the liquid left the ground dry [m²]
    double volume = 0.0;          ///< ∫(u − h) [m³]
    double height_max = 0.0;      ///< largest u − h [m]
    double depth_max = 0.0;       ///< largest h − u: how far the surface sinks into the ground [m]
    double liquid_area = 0.0;  ///< ∫√(1+|∇u|²) but for what is dry, the true area of the liquid's surface [m²]
    double linear_area = 0.0;  ///< ∫(1 + ½|∇u|²) there, what the linear model takes for it [m²]
    double surface_energy = 0.0;  ///< σ · liquid_area [J]
    double gravity_energy = 0.0;  ///< ½ρg⊥∫(u² − h²) − ρ∫(g∥·x)(u − h) [J]
    double slope_max = 0.0;       ///< steepest triangle [rad]
    double steep_area = 0.0;      ///< of the footprint, where triangles are steeper than 50° [m²]
    double bond_number = 0.0;  ///< ρ|g|A/(πσ): gravity against surface tension, at the radius of a disc of that area
    double projected_width = 0.0;  ///< ½∮|n·d|, the rim's width seen from downhill; 0 without tilt [m]
    ContactAngle contact_angle;
    /// Height of an endless puddle of the mean contact angle θ, 2 √(σ/ρg) sin(θ/2); of level, flat ground alone [m].
    std::optional<double> height_bound = {};
};

/// The angles between which a contact line stays where it is.
struct Hysteresis {
    double advancing = 0.0;  ///< beyond it the rim moves out [rad]
    double receding = 0.0;   ///< below it the rim moves in [rad]

    /// @throws Error InvalidArgument unless 0 ≤ receding ≤ advancing ≤ π
    void validate() const;
};

/// Whether a droplet keeps its place on a tilted plane.
struct Retention {
    double driving_force = 0.0;    ///< ρV|g∥|, downhill [N]
    double retention_force = 0.0;  ///< σw(cos θ_R − cos θ_A) at most, w the projected width [N]

    [[nodiscard]] bool wouldSlide() const { return driving_force > retention_force; }
};

/// The balance of C. G. L. Furmidge, "Studies at phase interfaces" (1962), for a rim of any shape: the retaining force
/// is largest where the angle is θ_A along all of the rim that faces downhill and θ_R along the rest.
Retention retention(const ShapeFigures& figures, const SolveOptions& options, const Hysteresis& hysteresis);

/// Measures one droplet.
/// @param mesh     the mesh `field` was solved on
/// @param field    heights
/// @param options  the physics it was solved with
ShapeFigures measure(const PlanarMesh& mesh, const HeightField& field, const SolveOptions& options);

/// Figures of several droplets together: sums, extremes (also of the Bond number), means weighted by rim length.
ShapeFigures combine(const std::vector<ShapeFigures>& droplets);

}  // namespace droplet
