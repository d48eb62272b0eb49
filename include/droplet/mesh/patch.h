// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/footprint/domain.h"
#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// A mesh that has vertices of older ones.
struct PatchedMesh {
    PlanarMesh mesh;
    std::size_t kept = 0;  ///< vertices that stand where an older mesh had them
};

/// Triangulates a footprint, and keeps of older meshes what stands far from where rims changed: so liquid at rest does
/// not flicker where a drip grows elsewhere, and droplets that meet keep their far ends.
///
/// Vertices of old rims stay where the new rim runs along them, by less than a twentieth of an edge; triangles stay
/// that are more than two edges and a half away from where it does not. What is left is triangulated anew.
///
/// Guarantees: the invariants of PlanarMesh; a rim off the footprint's by less than a fiftieth of an edge in the mean,
/// by area. Where that cannot be, or nothing can be kept, there is no mesh: triangulate anew. Angles of what is new are
/// as those of triangulate(), wherever the old rim and triangles admit it: the caller may look.
/// @param before     meshes that do not overlap
/// @param footprint  to be covered; its loops do not cross
/// @param edge       length of a triangle's edge [m], > 0
std::optional<PatchedMesh> patch(const std::vector<const PlanarMesh*>& before, const Footprint& footprint, double edge);

}  // namespace droplet
