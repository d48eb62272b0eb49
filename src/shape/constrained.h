// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"
#include "shape/operator.h"

namespace droplet {

/// Constrained system: Ax = right + λm with mᵀx = volume, where A is the operator and m = ∫φ.
struct ConstrainedProblem {
    std::vector<double> right;  ///< at inner vertices [m], ignored at held ones; empty: 0
    double volume = 0.0;        ///< [m³]
    double tolerance = 1e-10;   ///< relative residual at which an iteration ends
};

/// A result with a larger residual, and more than twice the tolerance, is not a solution. Factorisations for 100,000
/// triangles have 1e-12 to 1e-11.
inline constexpr double kLargestResidual = 1e-9;

/// Result of a constrained system.
struct ConstrainedSolution {
    std::vector<double> values;  ///< x at the mesh's inner vertices, 0 where held [m]
    double multiplier = 0.0;     ///< λ [1/m]
    double residual = 0.0;  ///< ‖right + λm − Ax‖ divided by the largest of ‖right‖, ‖λm‖ and ‖wm∘x‖
    std::size_t iterations = 0;  ///< 1 for a factorisation
    bool converged = false;
};

/// Solves constrained systems of one mesh for one operator after another, and keeps what they have in common. The mesh
/// must outlive it.
class ConstrainedSolver {
public:
    virtual ~ConstrainedSolver() = default;

    /// Factors or coarsens an operator for the next calls of solve().
    /// @param op  positive definite on functions without volume; otherwise solve() does not converge
    virtual void prepare(const Operator& op) = 0;
    [[nodiscard]] virtual ConstrainedSolution solve(const ConstrainedProblem& problem) const = 0;
    [[nodiscard]] virtual const char* method() const = 0;
    /// Work of the last prepare(), as SolveOptions::max_work.
    [[nodiscard]] virtual double prepareWork() const { return 0.0; }
};

/// Solver by factorisation: choleskyFactor() if A itself is positive definite, otherwise multifrontalFactor().
std::unique_ptr<ConstrainedSolver> directSolver(const PlanarMesh& mesh);

/// Solver by conjugate gradients among functions without volume, with a multigrid preconditioner.
std::unique_ptr<ConstrainedSolver> multigridSolver(const PlanarMesh& mesh);

}  // namespace droplet
