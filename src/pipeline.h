// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/droplet.h"

namespace droplet {

/// The meshes of a droplet's domain, as its model wants them.
std::vector<PlanarMesh> meshesOf(const Domain& domain, const DropletOptions& options);

/// The stages from meshes on: solve, measure, loft.
/// @param droplet  with outline, domain and meshes
/// @param bases    cover() of every mesh, where known; else empty
/// @throws Error   NoSuchDroplet if the solver failed
void finish(Droplet& droplet, const DropletOptions& options, const std::vector<PlanarMesh>& bases,
            const Progress& progress);

/// Guarantees: returns only when the options of every stage but trace are valid.
/// @throws Error InvalidArgument
void validateStages(const DropletOptions& options);

}  // namespace droplet
