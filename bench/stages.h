// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases.h"

namespace droplet::bench {

/// The river's stages: Read, Trace, Draft by picture; Triangulate, Solve, Loft, Topology, Write by number of triangles.
void registerStages(const Plan& plan);

/// Triangles and errors with --grading, over three shapes.
void registerGrading(const Plan& plan);

/// What others do of the same work: CGAL's mesher on the same outline, Eigen's Cholesky on the same matrix.
void registerPeers(const Plan& plan);

}  // namespace droplet::bench
