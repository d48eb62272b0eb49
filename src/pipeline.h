// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/shape/sheet.h"
#include "shape/liquid_shapes.h"
#include "shape/own_options.h"

namespace droplet {

/// Meshes of a domain, suited to the model.
struct DomainMeshes {
    std::vector<PlanarMesh> meshes;  ///< one per droplet
    bool are_even = true;            ///< whether all triangles have about the same size
};
DomainMeshes meshesOf(const Domain& domain, const DropletOptions& options);

/// What is known of a droplet in a film.
struct FilmState {
    std::vector<PlanarMesh> bases = {};  ///< movableCover() of every mesh, or of its sheet's footprint; or empty
    /// Sheets that are solved already, one per droplet, or one for all at one pressure; or empty.
    std::vector<std::optional<SheetResult>> followed = {};
    bool keeps_triangles = false;  ///< those of sheets stay from frame to frame, as of LoftOptions::keeps_dry
};

/// Runs the stages after meshing: solve, measure, loft.
/// @param droplet  with outline, domain and meshes
/// @throws Error   NoSuchDroplet if the solver failed
void finish(Droplet& droplet, const DropletOptions& options, const Progress& progress, FilmState film = {});

/// Volumes that the fill of the options gives to droplets [m³].
/// @throws Error  NoSuchDroplet
std::vector<double> volumesOf(const std::vector<PlanarMesh>& meshes, const DropletOptions& options);

/// Whether two meshes have the same rim.
bool sameRim(const PlanarMesh& a, const PlanarMesh& b);

/// Checks the options of all stages but trace.
/// @throws Error InvalidArgument
void validateStages(const DropletOptions& options);

}  // namespace droplet
