// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/liquid.h"
#include "droplet/mesh/planar_mesh.h"
#include "droplet/progress.h"
#include "droplet/shape/base_surface.h"
#include "droplet/shape/capillary_surface.h"
#include "droplet/shape/fill.h"

namespace droplet {

/// Area of the liquid's surface in the energy that is minimised.
enum class Model {
    Linear,  ///< ∫(1 + ½|∇u|²): within 1 % up to contact angles of 5 to 8°, 15 % too high at 40°
    Exact,   ///< ∫√(1 + |∇u|²), the area itself
    Auto,    ///< linear where its height, volume and pressure are within 0.3 % of the exact model's, else exact
};

/// Solver of the linear systems.
enum class Solver {
    Auto,       ///< Llt for the linear model of up to 25,000 unknowns, and where it is faster or the iteration does not
                ///< converge; else Multigrid
    Llt,        ///< Eigen's simplicial Cholesky factorisation
    Multigrid,  ///< conjugate gradients with a multigrid preconditioner on the mesh's lattice
};

/// Result of solving.
enum class Termination {
    Converged,      ///< solved
    NotConverged,   ///< not solved, but a solution may exist
    NoHeightField,  ///< the liquid would hang over its rim; the largest volume that exists is in the report
    OutOfSteps,     ///< not solved with the allowed steps or work; the largest volume reached is in the report
    Unstable,       ///< gravity pulls the liquid off; both Bond numbers are in the report
};

/// Figures of a solve.
struct SolveReport {
    std::string method;            ///< "simplicial-llt", "multigrid-pcg", or, of hanging droplets and sheets,
                                   ///< "multifrontal-ldlt"; if droplets differ, that of the one with most unknowns
    std::size_t unknowns = 0;      ///< number of inner vertices of all droplets
    std::size_t iterations = 0;    ///< largest number for a linear system; 1 for a factorisation
    std::size_t newton_steps = 0;  ///< largest number for a droplet; 1 for the linear model
    double residual = 0.0;  ///< largest relative residual of a droplet: ‖Ax − b‖/‖b‖, or of the exact model's
                            ///< equations
    Termination termination = Termination::NotConverged;  ///< result
    std::size_t failed_droplet = 0;                       ///< index of the first droplet that failed
    double largest_volume = 0.0;        ///< with NoHeightField or OutOfSteps: volume of that droplet, or of all
                                        ///< with FillSharing::Total [m³]
    double bond_number = 0.0;           ///< with Unstable: ρ|g⊥|A/(πσ) of that droplet's footprint
    double critical_bond_number = 0.0;  ///< with Unstable: largest Bond number at which it can hang
    Model model = Model::Linear;        ///< model that was solved, never Auto
    double work = 0.0;                  ///< of all droplets, exact model, as SolveOptions::max_work

    /// Whether there are surfaces.
    [[nodiscard]] bool usable() const { return termination == Termination::Converged; }
};

/// Surfaces of all droplets, and the report.
struct Solution {
    std::vector<CapillarySurface> droplets;  ///< in the order of the meshes
    SolveReport report;                      ///< figures of the solve
};

/// Liquid, forces, ground and fill of a solve.
struct SolveOptions {
    Liquid liquid = {};                 ///< surface tension and density
    double gravity = kStandardGravity;  ///< into level ground; negative under a ceiling [m/s²]
    double tilt = 0.0;  ///< angle of the plane to the horizontal, 0 … π [rad]; π/2: a wall, π: a ceiling
    double tilt_direction = -0.5 * std::numbers::pi;  ///< downhill in the plane, counter-clockwise from +x [rad]
    Model model = Model::Linear;                      ///< linear or exact area, or as needed
    BaseSurface ground = {};                          ///< ground under the droplets
    bool no_penetration = false;         ///< keep u ≥ h: the liquid leaves the ground dry where it would sink into it
    Fill fill = {};                      ///< amount of liquid, unless volumes are given
    std::vector<double> volumes = {};    ///< volume of each droplet, in the order of the meshes [m³]; replaces fill,
                                         ///< whose sharing must be FillSharing::Each. Empty: fill is used
    Solver solver = Solver::Auto;        ///< solver of the linear systems
    std::size_t max_newton_steps = 400;  ///< limit per droplet, exact model; to prove that no droplet exists takes 100
    std::optional<double> max_work = {};  ///< limit per droplet, exact model: sum of unknowns × (iterations + 16)
                                          ///< over its linear systems, and of what costs as much, 0.3 µs each. Empty:
                                          ///< 6e7 plus 2000 per unknown

    /// Checks all options.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Gravity in the coordinates of the plane.
struct PlaneGravity {
    double normal = 0.0;  ///< g⊥, into the ground [m/s²]
    Vec2 along;           ///< g∥, downhill [m/s²]
};

/// Splits gravity into its components across and along the plane.
PlaneGravity planeGravity(const SolveOptions& options);

/// Width of the layer along the rim in which the surface of a puddle bends, √(σ/ρg⊥) [m]. Empty where gravity does not
/// press liquid onto the ground: without it or without density, on a wall, and under a ceiling.
std::optional<double> bendingLayer(const SolveOptions& options);

/// Height of an endless puddle, 2 √(σ/ρg⊥) sin(θ/2), or, where gravity does not press liquid onto the ground, that of a
/// cap on a disc, r tan(θ/2); in the linear model √(σ/ρg⊥) tan θ and r tan(θ)/2.
/// @param options  liquid, gravity, tilt and model
/// @param angle    contact angle θ, 0 … π [rad]; below π/2 in the linear model
/// @param area     of the disc [m²], > 0
/// @return         [m]; infinite under a ceiling, where gravity draws liquid out
double puddleHeight(const SolveOptions& options, double angle, double area);

/// Solves for the heights of all droplets.
///
/// Minimises σ·(area) + ½ρg⊥∫(u² − h²) − ρ∫(g∥·x)(u − h) under the constraint of the fill, with u = h on the rim, over
/// functions that are linear on every triangle: the thesis, chapter 4, eqs. 4.1–4.5, on a tilted plane and any ground.
/// The linear model expands the area to second order in the slope. It solves one linear system per droplet; then u is
/// affine in the volume, and the fill is one scalar equation. The exact model starts from there with Newton's method
/// and keeps the volume at every step. With no_penetration both become complementarity problems.
///
/// Guarantees: a given volume is met to 1e-10 relative; u ≥ h with no_penetration, and without it on level flat ground
/// up to round-off; the same input gives the same bits at any number of threads; heights of different solvers agree to
/// 1e-8 of the largest.
/// @param meshes    valid, at least one
/// @param options   liquid, gravity, ground, model, fill, solver
/// @param progress  called at Stage::Assemble and Stage::Solve; may be empty
/// @return          height fields and report; without them if there is no solution or the solver failed
/// @throws Error    InvalidArgument: options, an empty list of meshes, or a footprint beyond the end of the ground
Solution solve(const std::vector<PlanarMesh>& meshes, const SolveOptions& options = {}, const Progress& progress = {});

}  // namespace droplet
