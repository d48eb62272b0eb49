// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/base_surface.h"
#include "droplet/shape/solve.h"

namespace droplet {

/// A droplet, or a part of one, without the ground it left dry.
struct WetPart {
    PlanarMesh mesh;
    HeightField field;
};

/// Cuts out of a droplet the triangles whose three vertices are on the ground, dry or on the rim.
///
/// Guarantees: the parts' meshes keep PlanarMesh's invariants, but that a loop may pass the same place more than once,
/// by a vertex each time; they cover the triangles that are left once, and have no lattice. Dry vertices that still
/// have triangles all around them stay inner vertices. An inner edge between two vertices of the new rim is split in
/// its middle. Where the rim is new, liquid and ground have one tangent plane. The volume is the droplet's.
/// @param mesh    valid
/// @param field   heights on it, with `dry` as long as its vertices
/// @param ground  what the field was solved on
/// @return        parts that share no edge, by their first triangles; none if all is dry
std::vector<WetPart> wetParts(const PlanarMesh& mesh, const HeightField& field, const BaseSurface& ground);

}  // namespace droplet
