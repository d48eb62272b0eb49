// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>

#include "droplet/mesh/planar_mesh.h"
#include "shape/linear_solution.h"
#include "shape/operator.h"

namespace droplet {

/// (K + wM)u = ∫φ at the inner vertices of a mesh.
struct SparseSystem {
    Eigen::SparseMatrix<double> matrix;  ///< lower triangle
    Eigen::VectorXd load;                ///< [m²]
};

SparseSystem assemble(const PlanarMesh& mesh, const Operator& op);

/// Solves by Eigen's simplicial factorisation: the reference, and the fastest for small meshes.
LinearSolution solveByLlt(const SparseSystem& system);

/// Solves by CHOLMOD's supernodal factorisation: faster than the simplicial one for large meshes.
LinearSolution solveByCholmod(const SparseSystem& system);

}  // namespace droplet
