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
#include "droplet/shape/fill.h"

namespace droplet {

/// The surface of the liquid over one footprint, linear on every triangle.
struct HeightField {
    std::vector<double> height;     ///< u at every vertex of the mesh, out of the plane [m]; on the rim the ground's
    std::vector<double> ground;     ///< h at every vertex [m]; empty where the ground is flat, at 0
    std::vector<std::uint8_t> dry;  ///< 1 at inner vertices where the liquid is held on the ground; empty if at none
    std::vector<double> rim_slope;  ///< ∂u/∂n along the inward normal at every rim vertex
    std::vector<double> contact_angle;  ///< between liquid and ground, at every rim vertex [rad]
    double pressure = 0.0;              ///< λ, the pressure at height 0 above the plane's origin [Pa]

    /// h at a vertex [m].
    [[nodiscard]] double groundAt(std::uint32_t vertex) const { return ground.empty() ? 0.0 : ground[vertex]; }
    /// u − h at a vertex [m].
    [[nodiscard]] double thicknessAt(std::uint32_t vertex) const { return height[vertex] - groundAt(vertex); }
};

/// What is minimised for the area of the liquid's surface.
enum class Model {
    Linear,  ///< ∫(1 + ½|∇u|²): good to slopes of some 50°
    Exact,   ///< ∫√(1 + |∇u|²), the area itself
};

/// How the linear systems are solved.
enum class Solver {
    Auto,       ///< whichever is fastest for each droplet; if the iteration does not converge, Llt
    Llt,        ///< Eigen's simplicial Cholesky factorisation
    Multigrid,  ///< conjugate gradients preconditioned by multigrid on the mesh's lattice
};

/// How solving ended.
enum class Termination {
    Converged,
    NotConverged,   ///< neither solved nor shown to have no solution
    NoHeightField,  ///< the liquid would hang over its rim; SolveReport::largest_volume says how much does not
    OutOfSteps,     ///< as NotConverged, for want of steps or work; SolveReport::largest_volume says how far they went
    Unstable,       ///< gravity pulls the liquid off; SolveReport::bond_number and critical_bond_number say how much
};

/// How solving went: numbers, not words, except `method`.
struct SolveReport {
    std::string method;            ///< "simplicial-llt", "simplicial-ldlt", "multigrid-pcg"; where droplets differ, the
                                   ///< one with most unknowns
    std::size_t unknowns = 0;      ///< interior vertices of all droplets
    std::size_t iterations = 0;    ///< most of any linear system; 1 for a factorisation
    std::size_t newton_steps = 0;  ///< most of any droplet; 1 for the linear model
    double residual = 0.0;  ///< largest relative residual of any droplet: ‖Ax − b‖/‖b‖, or of the exact model's
                            ///< equations
    Termination termination = Termination::NotConverged;
    std::size_t failed_droplet = 0;     ///< of several the first, if termination is not Converged
    double largest_volume = 0.0;        ///< with NoHeightField or OutOfSteps: of that one, or of all with
                                        ///< FillSharing::Total [m³]
    double bond_number = 0.0;           ///< with Unstable: ρ|g⊥|A/(πσ) of that one's footprint
    double critical_bond_number = 0.0;  ///< with Unstable: beyond which it cannot hang

    [[nodiscard]] bool usable() const { return termination == Termination::Converged; }
};

/// Heights of all droplets, with the report.
struct Solution {
    std::vector<HeightField> droplets;  ///< in the order of the meshes
    SolveReport report;
};

/// What acts on the liquid, what it stands on, and how much of it there is.
struct SolveOptions {
    Liquid liquid;
    double gravity = kStandardGravity;  ///< into the ground when level; negative under a ceiling [m/s²]
    double tilt = 0.0;  ///< of the plane against level, 0 … π [rad]: upright at π/2, a ceiling at π
    double tilt_direction = -0.5 * std::numbers::pi;  ///< of downhill in the plane, counter-clockwise from +x [rad]
    Model model = Model::Linear;
    BaseSurface ground;
    bool no_penetration = false;  ///< keep u ≥ h: where the liquid would sink into the ground, it leaves it dry
    Fill fill;
    std::vector<double> volumes =
        {};  ///< each droplet's own, in the order of the meshes [m³]; then fill is left aside,
             ///< but for FillSharing::Each, which it must have. Empty: fill says how much
    Solver solver = Solver::Auto;
    std::size_t max_newton_steps = 400;  ///< of the exact model, for a droplet; to show that there is none takes 100
    std::optional<double> max_work =
        {};  ///< of the exact model, for a droplet: unknowns times iterations of their linear systems, and 16 for every
             ///< step. Empty: 6e7, and 2000 for every unknown

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Gravity in the plane's frame.
struct PlaneGravity {
    double normal = 0.0;  ///< g⊥, into the ground [m/s²]
    Vec2 along;           ///< g∥, downhill [m/s²]
};

PlaneGravity planeGravity(const SolveOptions& options);

/// Minimises σ·(area) + ½ρg⊥∫(u² − h²) − ρ∫(g∥·x)(u − h) under the fill's constraint, with u = h on the rim, over
/// functions linear on every triangle: the thesis, chapter 4, eqs. 4.1–4.5, on a tilted plane and any ground.
///
/// The linear model takes the area to second order in the slope: one linear system per droplet, after which u is affine
/// in the volume and the fill one scalar equation. The exact model takes the area itself: Newton's method from there,
/// the volume kept at every step. With no_penetration either becomes a complementarity problem.
///
/// Guarantees: a prescribed volume is met to 1e-10 relative; u ≥ h with no_penetration, and without it on level flat
/// ground up to round-off; the same input gives the same bits at any number of threads; heights of different solvers
/// agree to 1e-8 of the largest.
/// @param meshes    valid, at least one
/// @param options   liquid, gravity, ground, model, fill, solver
/// @param progress  told of Stage::Assemble and Stage::Solve; may be empty
/// @return          heights and report; what could not be solved, or does not exist, is reported, not thrown, and then
///                  there are no heights
/// @throws Error    InvalidArgument for options, an empty list of meshes, or a footprint beyond the ground's end
Solution solve(const std::vector<PlanarMesh>& meshes, const SolveOptions& options = {}, const Progress& progress = {});

}  // namespace droplet
