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
    std::optional<double> edge;      ///< length of a triangle's edge [m], > 0; with grading, of those along the rim
    int grading = 1;                 ///< how many times longer edges may be far from the rim: 1, 2, 4, … 64

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Triangulates every droplet's footprint with equilateral triangles inside and a Delaunay band along the rim.
///
/// Without grading the equilateral part is described in PlanarMesh::lattice, which makes solving fast. With grading
/// fewer triangles do inside: worth it where a droplet is wider than a few capillary lengths, and where only the rim
/// matters (bench/RESULTS.md compares errors).
///
/// Guarantees, for every mesh: the invariants of PlanarMesh; angles of at least 20°, except near corners of the rim
/// that are sharper than 40°: there, within two of the loop's own points, at least half the corner; corners stand as
/// they are, other rim vertices off their loop by less than a chord's sagitta, so that the polygon keeps the loop's
/// area. Narrow parts get shorter edges than asked. Droplets share one edge length, found so that the number of
/// triangles is within 10 % of the wish wherever the footprint's detail allows so few.
/// @param domain   loops that do not cross
/// @param options  number of triangles or edge length
/// @return         one mesh per droplet, in the domain's order
/// @throws Error   InvalidArgument for options or crossing loops; InvalidInput if the footprint's detail takes
///                 more than 2²⁰ triangles and more than were asked for
std::vector<PlanarMesh> triangulate(const Domain& domain, const TriangulateOptions& options = {});

/// Covers the same polygon as a mesh with few triangles: for the ground, which is flat.
///
/// Guarantees: the vertices of `mesh`'s rim come first, in its order, and no other vertex is on the rim; inner edges
/// may join two rim vertices. Triangles grow inward.
PlanarMesh cover(const PlanarMesh& mesh);

}  // namespace droplet
