// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/shape/base_surface.h"
#include "droplet/shape/capillary_surface.h"

namespace droplet {

/// Removes the triangles of a surface that lie on the ground, face up: those whose three vertices are dry, or on the
/// rim.
///
/// Guarantees: the parts have the invariants of CapillarySurface, and cover each remaining triangle once. A dry vertex
/// that still has triangles all around it stays an inner vertex. An inner edge between two vertices of the new rim is
/// split in its middle. Along a new rim, liquid and ground have the same tangent plane. The volume does not change.
/// Loops of a height field's parts may pass a place more than once, with a vertex each time. Others do not: there,
/// triangles on the ground stay; and their footprints are those of cover(), on ground that bends with edges as long as
/// those of the surface's footprint.
/// @param ground  under the surface
/// @return        parts that share no edge, in the order of their first triangles, none if all is dry; empty if nothing
///                is removed
std::optional<std::vector<CapillarySurface>> wetParts(const CapillarySurface& surface, const BaseSurface& ground);

}  // namespace droplet
