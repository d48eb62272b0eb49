// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"
#include "mesh/lattice_grid.h"

namespace droplet {

/// The lattice inside a footprint, in layers: where it is regular it needs no triangulating.
///
/// Of the points clear of the rim, those next to it may still be moved; the fixed ones have only clear points around
/// them, the regular ones only fixed points. A triangle of three fixed points belongs to the core and is known. What is
/// left for the Delaunay triangulation is the band between rim and core, with two layers of points in it: so nothing
/// that is refined at the rim comes near the core.
class LatticeCore {
public:
    /// @param polygons  outer counter-clockwise, holes clockwise, not crossing
    LatticeCore(const std::vector<std::vector<Vec2>>& polygons, double edge);

    /// Points clear of the rim that are not fixed.
    [[nodiscard]] std::vector<Vec2> loosePoints() const;

    /// Fixed points with triangles outside the core.
    [[nodiscard]] std::vector<Vec2> seamPoints() const;
    /// The same by their numbers among the fixed ones, in the same order.
    [[nodiscard]] std::vector<std::uint32_t> seamNumbers() const;

    /// Edges between a triangle of the core and none, as indices into seamPoints().
    [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> boundary() const;

    /// Appends the fixed points as vertices and the core's triangles, and describes them in `mesh.lattice`.
    void appendTo(PlanarMesh& mesh) const;

    [[nodiscard]] std::uint32_t fixedCount() const { return fixed_.end(); }

private:
    double edge_;
    LatticeRegion clear_;
    LatticeGrid fixed_;
    LatticeRegion regular_;
    LatticeGrid seam_;
};

/// How many lattice points a footprint holds clear of its rim.
std::size_t countClearPoints(const std::vector<std::vector<Vec2>>& polygons, double edge);

/// Lattice points clear of the rim, fewer and fewer inward: every second row and column is left out, again and again,
/// until edges are `longest` times as long as at the rim.
std::vector<Vec2> gradedPoints(const std::vector<std::vector<Vec2>>& polygons, double edge, int longest);

}  // namespace droplet
