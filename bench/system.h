// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"

namespace droplet::bench {

/// Equations of one droplet at unit pressure, assembled without the library, to judge solvers.
struct System {
    Eigen::SparseMatrix<double> matrix;  ///< σK + ρgM over inner vertices, lower triangle
    Eigen::VectorXd load;                ///< ∫φ over inner vertices
};

/// Equations on a mesh.
System assemble(const PlanarMesh& mesh, const SolveOptions& physics);

/// Relative residual of a droplet's heights, ‖Au − λm‖/‖λm‖.
double residual(const System& system, const CapillarySurface& field);

/// Volume of a height field, ∫u [m³].
double volume(const CapillarySurface& field);

/// Largest height of a height field [m].
double height(const CapillarySurface& field);

}  // namespace droplet::bench
