// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/domain/domain.h"
#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Mesh that keeps vertices of older meshes.
struct PatchedMesh {
    PlanarMesh mesh;       ///< the new mesh
    std::size_t kept = 0;  ///< number of vertices at the place they have in an older mesh
};

/// Triangulates a footprint, and keeps the old triangles that are far from changes of the rim. So liquid at rest does
/// not flicker while a drip grows elsewhere, and droplets that meet keep their far ends.
///
/// Old rim vertices stay where the new rim runs less than a twentieth of an edge away from them. Triangles stay if they
/// are more than two and a half edges away from all other parts of the rim. The rest is triangulated anew.
///
/// Guarantees: the invariants of PlanarMesh; the rim lies off the footprint's rim by less than a fiftieth of an edge in
/// the mean, by area. New triangles have the angles of triangulate() where the old rim and triangles allow it; the
/// caller may check.
/// @param before     old meshes, which do not overlap
/// @param footprint  region to cover; its loops do not cross
/// @param edge       length of a triangle's edge [m], > 0
/// @return           the mesh; empty if the guarantees cannot be met or nothing can be kept, then triangulate the
///                   footprint anew
std::optional<PatchedMesh> patch(const std::vector<const PlanarMesh*>& before, const Footprint& footprint, double edge);

}  // namespace droplet
