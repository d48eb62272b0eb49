// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/domain/domain.h"
#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Moves the rim of a mesh; inner vertices follow harmonically, connections stay. Where triangles would be turned over,
/// single inner vertices step aside.
/// @param mesh   mesh to start from
/// @param rim    new places of the rim's vertices [m], as many as the mesh has
/// @return       the moved mesh, without its lattice; empty if triangles are turned over all the same
/// @throws Error InvalidArgument if the number of places is wrong
std::optional<PlanarMesh> moveRim(const PlanarMesh& mesh, const std::vector<Vec2>& rim);

/// Covers the polygon of a mesh as cover() does, with triangles that can follow its rim: every inner edge between two
/// rim vertices is split in its middle. A triangle of three rim vertices would be turned over where its corner bends
/// the other way, and no vertex could step aside.
///
/// Guarantees: as cover(); no inner edge joins two rim vertices.
/// @param mesh  its rim alone counts
PlanarMesh movableCover(const PlanarMesh& mesh);

/// Moves a mesh to a footprint that moved and changed little, so that vertices keep their identity.
///
/// First, the old and new loops are brought to the same centre and size. Each rim vertex then goes to the nearest place
/// on the new loop, and places that are too close or too far apart are evened out, relative to those of `first`. Each
/// corner of the new footprint gets a vertex, and so does each bend that an edge would cut off. Finally the rim is
/// widened or narrowed until its area is that of the footprint. Inner vertices move harmonically from their places in
/// `first`, so errors do not add up over a run of frames. Where angles would become too small, single vertices are
/// moved until they are not; if that fails, all are moved from their places in `last`.
///
/// Guarantees: connections are those of `first`; no triangle is turned over; angles are at least 15°, or a share of the
/// smallest angle of `first` if that is below 15°; the mean edge is between 2/3 and 3/2 as long; chords lie off their
/// piece of the loop by less than a fifth of their length.
/// @param first      mesh with which the run of frames began
/// @param last       the same mesh at its present place, with the connections of `first`
/// @param footprint  footprint to move to
/// @param angles     that share, 0 … 1; with 0 the rim alone counts
/// @return           the moved mesh; empty if the guarantees cannot be met, then triangulate the footprint anew
/// @throws Error     InvalidArgument if the meshes have different connections
std::optional<PlanarMesh> follow(const PlanarMesh& first, const PlanarMesh& last, const Footprint& footprint,
                                 double angles = 0.75);

}  // namespace droplet
