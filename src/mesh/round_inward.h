// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Rounds the corners of a footprint that point inward, and closes slits that are narrower than two radii.
///
/// There liquid lies on the ground outside of its rim, and rolls over it: with a rim that turns by 90° from one edge to
/// the next, no triangles can follow. The footprint only grows, by less the finer it is meshed and by no more than
/// 0.75 %; holes stay, and none are made. Where this needs it, the radius is smaller.
/// @param footprint  valid
/// @param radius     ≥ 0 [m]; with 0, there are new triangles alone
/// @param edge       mean edge of the new triangles [m], > 0
/// @return           new triangles; none if there is no such corner and edges are much as they were
std::optional<PlanarMesh> roundInward(const PlanarMesh& footprint, double radius, double edge);

/// Whether a rim has a corner that points inward and that roundInward() rounds.
bool hasInnerCorner(const PlanarMesh& footprint);

}  // namespace droplet
