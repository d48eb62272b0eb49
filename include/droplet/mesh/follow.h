// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/footprint/domain.h"
#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// The same connections with the rim somewhere else: inner vertices move as the rim does, harmonically.
/// @param mesh   to start from
/// @param rim    where the rim's vertices are to stand, as many as the mesh has
/// @return       the mesh there, its lattice forgotten; triangles may be turned over
/// @throws Error InvalidArgument
PlanarMesh withRim(const PlanarMesh& mesh, const std::vector<Vec2>& rim);

/// Moves a mesh with a footprint that moves and changes little, so that vertices keep their identity.
///
/// The rim's vertices go where they would go by the nearest way once the loops' middles and sizes are made the same,
/// evenly; corners of the new footprint get a vertex each; then the rim is widened or narrowed until it has the
/// footprint's area. Inner vertices follow harmonically from where they stood in `first`, so nothing adds up over a run
/// of frames.
///
/// Guarantees: connections are those of `first`, triangles are not turned over and have angles of at least 15° or three
/// quarters of the least of `first`, edges are between 2/3 and 3/2 as long in the mean, chords stand off their piece of
/// the loop by less than a fifth of their length. Where that cannot be, there is no mesh: triangulate anew.
/// @param first      the mesh a run of frames began with
/// @param last       the same mesh where it stands now: connections of `first`
/// @param footprint  to go to
/// @throws Error     InvalidArgument if the meshes have different connections
std::optional<PlanarMesh> follow(const PlanarMesh& first, const PlanarMesh& last, const Footprint& footprint);

}  // namespace droplet
