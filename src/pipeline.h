// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/droplet.h"

namespace droplet {

/// Meshes of a domain, suited to the model.
std::vector<PlanarMesh> meshesOf(const Domain& domain, const DropletOptions& options);

/// Whether all triangles of such meshes have about the same size.
bool meshesAreEven(const DropletOptions& options);

/// Runs the stages after meshing: solve, measure, loft.
/// @param droplet  with outline, domain and meshes
/// @param bases    cover() of every mesh, if known; otherwise empty
/// @throws Error   NoSuchDroplet if the solver failed
void finish(Droplet& droplet, const DropletOptions& options, const std::vector<PlanarMesh>& bases,
            const Progress& progress);

/// Checks the options of all stages but trace.
/// @throws Error InvalidArgument
void validateStages(const DropletOptions& options);

}  // namespace droplet
