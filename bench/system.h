// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"

namespace droplet::bench {

/// The equations of one droplet at unit pressure, put together without the library: what solvers are judged by.
struct System {
    Eigen::SparseMatrix<double> matrix;  ///< σK + ρgM over inner vertices, lower triangle
    Eigen::VectorXd load;                ///< ∫φ
};

System assemble(const PlanarMesh& mesh, const SolveOptions& physics);

/// ‖Au − λm‖/‖λm‖ of a droplet's heights.
double residual(const System& system, const PlanarMesh& mesh, const HeightField& field);

/// ∫u [m³].
double volume(const PlanarMesh& mesh, const HeightField& field);

}  // namespace droplet::bench
