// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"
#include "shape/operator.h"

namespace droplet {

/// What is asked of a constrained system: Ax = right + λm with mᵀx = volume, A the operator and m = ∫φ.
struct ConstrainedProblem {
    std::vector<double> right;  ///< at inner vertices [m], without effect where held; empty: 0
    double volume = 0.0;        ///< [m³]
    double tolerance = 1e-10;   ///< for iterations: residual in terms of the first
};

/// Residuals beyond this, and beyond twice the tolerance asked for, are no solution. Factorisations of 100,000
/// triangles leave 1e-12 to 1e-11.
inline constexpr double kLargestResidual = 1e-9;

/// Its solution, or not.
struct ConstrainedSolution {
    std::vector<double> values;  ///< x at the mesh's inner vertices, 0 where held [m]
    double multiplier = 0.0;     ///< λ [1/m]
    double residual = 0.0;  ///< ‖right + λm − Ax‖ by the largest of ‖right‖, ‖λm‖ and the weight ‖wm∘x‖
    std::size_t iterations = 0;  ///< 1 for a factorisation
    bool converged = false;
};

/// Solves constrained systems of one mesh, which must outlive it, for one operator after another; keeps what they have
/// in common.
class ConstrainedSolver {
public:
    virtual ~ConstrainedSolver() = default;

    /// Factors or coarsens an operator for the calls of solve() to follow.
    /// @param op  positive definite on functions without volume, or solve() does not converge
    virtual void prepare(const Operator& op) = 0;
    [[nodiscard]] virtual ConstrainedSolution solve(const ConstrainedProblem& problem) const = 0;
    [[nodiscard]] virtual const char* method() const = 0;
};

/// By factorisation: SimplicialLLT where A itself is positive definite, else SimplicialLDLT.
std::unique_ptr<ConstrainedSolver> directSolver(const PlanarMesh& mesh);

/// By conjugate gradients among functions without volume, preconditioned by multigrid.
std::unique_ptr<ConstrainedSolver> multigridSolver(const PlanarMesh& mesh);

}  // namespace droplet
