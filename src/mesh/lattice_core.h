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

/// Lattice inside a footprint, in layers; its regular part needs no triangulation.
///
/// Points clear of the rim are loose or fixed. Loose points lie next to the rim and may still be moved. Fixed points
/// have only clear points around them, and regular points only fixed points. A triangle of three fixed points belongs
/// to the core and is known. The band between rim and core is left for the Delaunay triangulation. It has two layers of
/// points, so that refinement at the rim does not reach the core.
class LatticeCore {
public:
    /// @param polygons  outer counter-clockwise, holes clockwise, not crossing
    LatticeCore(const std::vector<std::vector<Vec2>>& polygons, double edge);

    /// Loose points: clear of the rim, but not fixed.
    [[nodiscard]] std::vector<Vec2> loosePoints() const;

    /// Fixed points that have triangles outside the core.
    [[nodiscard]] std::vector<Vec2> seamPoints() const;
    /// Numbers of the seam points among the fixed points, in the same order.
    [[nodiscard]] std::vector<std::uint32_t> seamNumbers() const;

    /// Edges with a core triangle on one side only, as indices into seamPoints().
    [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> boundary() const;

    /// Appends the fixed points as vertices and the core's triangles to a mesh, and describes them in `mesh.lattice`.
    void appendTo(PlanarMesh& mesh) const;

    [[nodiscard]] std::uint32_t fixedCount() const { return fixed_.end(); }

private:
    double edge_;
    LatticeRegion clear_;
    LatticeGrid fixed_;
    LatticeRegion regular_;
    LatticeGrid seam_;
};

/// Number of lattice points of a footprint that are clear of its rim.
std::size_t countClearPoints(const std::vector<std::vector<Vec2>>& polygons, double edge);

/// Lattice points clear of the rim, coarser inward: every second row and column is left out, repeatedly, until edges
/// are `longest` times as long as at the rim.
std::vector<Vec2> gradedPoints(const std::vector<std::vector<Vec2>>& polygons, double edge, int longest);

/// The same for a surface that bends in a layer along the rim, whose width is given [m].
std::vector<Vec2> layeredPoints(const std::vector<std::vector<Vec2>>& polygons, double edge, int longest, double layer);

}  // namespace droplet
