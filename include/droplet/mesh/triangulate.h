// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/footprint/domain.h"
#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// How finely a footprint is triangulated.
struct TriangulateOptions {
    std::size_t triangles = 40'000;  ///< wanted in all droplets together, ≥ 1; ignored if edge is set
    std::optional<double> edge;      ///< length of a triangle's edge away from the rim [m], > 0

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Triangulates every droplet's footprint with equilateral triangles inside and a Delaunay band along the rim.
///
/// Guarantees, for every mesh: the invariants of PlanarMesh; angles of at least 20°, except near corners of the rim
/// that are sharper than 40°: there, within two of the loop's own points, at least half the corner; corners stand as
/// they are, other rim vertices off their loop by less than a chord's sagitta, so that the polygon keeps the loop's
/// area. Narrow parts get shorter edges than asked. Droplets share one edge length, found so that the number of
/// triangles is within 10 % of the wish wherever the footprint's detail allows so few.
/// @param domain   loops that do not cross
/// @param options  number of triangles or edge length
/// @return         one mesh per droplet, in the domain's order
/// @throws Error   InvalidArgument for options or crossing loops
std::vector<PlanarMesh> triangulate(const Domain& domain, const TriangulateOptions& options = {});

}  // namespace droplet
