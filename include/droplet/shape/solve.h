// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/liquid.h"
#include "droplet/mesh/planar_mesh.h"
#include "droplet/progress.h"
#include "droplet/shape/fill.h"

namespace droplet {

/// The liquid's height over one footprint, linear on every triangle.
struct HeightField {
    std::vector<double> height;     ///< at every vertex of the mesh [m], 0 on the rim
    std::vector<double> rim_slope;  ///< ∂u/∂n along the inward normal at every rim vertex; arctan is the contact angle
    double pressure = 0.0;          ///< λ, the pressure at height 0 [Pa]
};

/// How the linear systems are solved.
enum class Solver {
    Auto,       ///< whichever is fastest for each droplet; if the iteration does not converge, Cholmod
    Llt,        ///< Eigen's simplicial Cholesky factorisation
    Cholmod,    ///< CHOLMOD's supernodal Cholesky factorisation
    Multigrid,  ///< conjugate gradients preconditioned by multigrid on the mesh's lattice
};

/// How solving went: numbers, not words, except `method`.
struct SolveReport {
    std::string method;        ///< "simplicial-llt", "cholmod-supernodal", "multigrid-pcg"; where droplets differ, the
                               ///< one with most unknowns
    std::size_t unknowns = 0;  ///< interior vertices of all droplets
    std::size_t iterations = 0;  ///< most of any droplet; 1 for a factorisation
    double residual = 0.0;       ///< largest relative residual ‖Ax − b‖/‖b‖ of any droplet
    bool converged = false;      ///< every droplet's residual below 1e-9, all figures finite

    [[nodiscard]] bool usable() const { return converged; }
};

/// Heights of all droplets, with the report.
struct Solution {
    std::vector<HeightField> droplets;  ///< in the order of the meshes
    SolveReport report;
};

/// What acts on the liquid, and how much of it there is.
struct SolveOptions {
    Liquid liquid;
    double gravity = kStandardGravity;  ///< into the ground [m/s²], ≥ 0
    Fill fill;
    Solver solver = Solver::Auto;

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Minimises σ∫(1 + ½|∇u|²) + ½ρg∫u² under the fill's constraint, with u = 0 on the rim, over functions linear on
/// every triangle: the linear model of the thesis (chapter 4, eqs. 4.1–4.5 with the Taylor area).
///
/// The matrix does not depend on the pressure: one linear system per droplet, after which the solution is affine in λ
/// and the fill one scalar equation. Guarantees: height ≥ 0 up to round-off; a prescribed volume is met to 1e-10
/// relative; the same input gives the same bits at any number of threads (with Solver::Cholmod as far as the installed
/// BLAS does so); heights of different solvers agree to 1e-8 of the largest.
/// @param meshes    valid, at least one
/// @param options   liquid, gravity, fill, solver
/// @param progress  told of Stage::Assemble and Stage::Solve; may be empty
/// @return          heights and report; what could not be solved is reported, not thrown
/// @throws Error    InvalidArgument for options or an empty list of meshes
Solution solve(const std::vector<PlanarMesh>& meshes, const SolveOptions& options = {}, const Progress& progress = {});

}  // namespace droplet
