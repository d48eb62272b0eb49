// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases.h"

namespace droplet::bench {

/// Registers the pipeline's stages: Read, Trace, Draft for each picture; Triangulate, Solve, Loft, Topology, Write for
/// each number of triangles.
void registerStages(const Plan& plan);

/// Registers triangles and errors with --grading on three shapes.
void registerGrading(const Plan& plan);

/// Registers other programs on the same work: CGAL's mesher on the same outline, Eigen's Cholesky on the same matrix.
void registerPeers(const Plan& plan);

}  // namespace droplet::bench
