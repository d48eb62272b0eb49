// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/base_surface.h"
#include "droplet/shape/sheet.h"
#include "droplet/shape/solve.h"

namespace droplet {

/// Droplet, or a part of one, without the ground that it left dry.
struct WetPart {
    PlanarMesh mesh;
    HeightField field;
};

/// Removes the triangles of a droplet whose three vertices are on the ground: dry, or on the rim.
///
/// Guarantees: meshes of the parts have the invariants of PlanarMesh, except that a loop may pass a place more than
/// once, with a vertex each time. They cover each remaining triangle once, and have no lattice. A dry vertex that still
/// has triangles all around it stays an inner vertex. An inner edge between two vertices of the new rim is split in its
/// middle. Along a new rim, liquid and ground have the same tangent plane. The total volume does not change.
/// @param mesh    valid
/// @param field   heights on it; `dry` has one entry per vertex
/// @param ground  ground of the field
/// @return        parts that share no edge, in the order of their first triangles; none if all is dry
std::vector<WetPart> wetParts(const PlanarMesh& mesh, const HeightField& field, const BaseSurface& ground);

/// Removes the triangles of a sheet that lie on flat ground, face up, with all of their vertices.
///
/// Guarantees: as above, but a rim passes no place twice: there, triangles on the ground stay. Footprints have few
/// triangles, as of cover().
/// @return  parts with footprints of their own, none if all is dry; empty if nothing is removed
std::optional<std::vector<ParametricSheet>> wetParts(const ParametricSheet& sheet);

}  // namespace droplet
