// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/domain/domain.h"
#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Density of the triangles on a footprint.
struct TriangulateOptions {
    std::size_t triangles = 40'000;    ///< requested number in all droplets together, ≥ 1; ignored if edge is set
    std::optional<double> edge;        ///< length of a triangle's edge [m], > 0; with grading, of edges along the rim
    std::optional<int> grading = {};   ///< how many times longer edges may be far from the rim: 1, 2, 4, … 64. Empty:
                                       ///< gradingOf() decides
    std::optional<double> layer = {};  ///< width of the layer along the rim in which the surface bends, as the
                                       ///< capillary length of a puddle [m], > 0; used if grading is empty
    bool quads =
        false;  ///< right-angled triangles in pairs, along the rim, for joinTriangles(); not with a grading over 1
    std::optional<double> max_edge = {};  ///< longest edge along the rim [m], > 0; where the number of triangles does
                                          ///< not suffice for it, there are more

    /// @throws Error InvalidArgument if a value is out of its range
    void validate() const;
};

/// Grading that a footprint is triangulated with: options.grading if set. Otherwise 64 if a layer is given, its area
/// over the length of its rim is more than twice the layer, and six of the edges that the number of triangles allows
/// without grading are longer than the layer; 1 if not, or for quads.
int gradingOf(const Domain& domain, const TriangulateOptions& options);

/// Triangulates every droplet's footprint: equilateral triangles inside, a Delaunay band along the rim.
///
/// Without grading, PlanarMesh::lattice describes the equilateral part, which makes solving fast. With grading, fewer
/// triangles are used inside. This pays where a droplet is wider than a few capillary lengths, and where only the rim
/// matters (bench/RESULTS.md compares errors). With a layer, edges become twice as long over its width.
///
/// With quads, nearly all triangles are halves of squares whose sides follow the rim, as smoothly as its directions
/// continue inward; lengths of edges are those of the squares' sides. Solving takes the general way.
///
/// Guarantees for every mesh: the invariants of PlanarMesh; angles of at least 20°, except near rim corners sharper
/// than 40°: there, within two of the loop's own points, angles are at least half the corner. Corners stay in place.
/// Other rim vertices move off their loop by less than a chord's sagitta, so that the polygon keeps the loop's area.
/// Narrow parts get shorter edges than requested. All droplets have the same edge length. It is chosen so that the
/// number of triangles is within 10 % of the requested number if the detail of the footprint and max_edge allow so few.
/// @param domain   its loops do not cross
/// @param options  number of triangles or edge length
/// @return         one mesh per droplet, in the domain's order
/// @throws Error   InvalidArgument for options, an edge over max_edge, or crossing loops; InvalidInput if the detail of
///                 the footprint, or max_edge, needs more than 2²⁰ triangles and more than requested
std::vector<PlanarMesh> triangulate(const Domain& domain, const TriangulateOptions& options = {});

/// Covers the polygon of a mesh: with few triangles, which grow inward, for flat ground; or with even ones.
///
/// Guarantees: the vertices of `mesh`'s rim come first, in the same order, and no other vertex is on the rim. Inner
/// edges may join two rim vertices.
/// @param mesh  its rim alone counts
/// @param edge  length of even edges [m], for ground that bends
PlanarMesh cover(const PlanarMesh& mesh, std::optional<double> edge = {});

}  // namespace droplet
