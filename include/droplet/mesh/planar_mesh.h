// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

using Triangle = std::array<std::uint32_t, 3>;

/// Vertices of a mesh on neighbouring points of one lattice row.
struct LatticeRun {
    std::int32_t row = 0;
    std::int32_t column = 0;   ///< of the first vertex
    std::uint32_t vertex = 0;  ///< index of the first; the others follow it
    std::uint32_t count = 0;   ///< ≥ 1

    friend bool operator==(const LatticeRun&, const LatticeRun&) = default;
};

/// The regular part of a mesh: where its vertices are points of an equilateral lattice.
///
/// Invariants: runs are apart from one another, in ascending order of row and column, and hold the last vertices of
/// the mesh; any three of their vertices that are mutual neighbours on the lattice form a triangle of the mesh.
struct Lattice {
    double edge = 0.0;  ///< between neighbouring points [m]
    std::vector<LatticeRun> runs;
    std::uint32_t first_regular_triangle =
        0;  ///< from here on triangles join vertices all of whose triangles are equilateral
};

/// The lattice's point: row r lies at y = r·√3/2·edge; its columns at x = column·edge, half an edge further in odd
/// rows.
inline Vec2 latticePoint(double edge, std::int32_t row, std::int32_t column)
{
    return {(static_cast<double>(column) + (row % 2 == 0 ? 0.0 : 0.5)) * edge,
            static_cast<double>(row) * (0.5 * std::numbers::sqrt3 * edge)};
}

/// A triangulated footprint of one droplet.
///
/// Invariants: rim vertices come first, loop after loop in order; triangles are counter-clockwise with positive
/// area and cover the polygon of the loops once; an edge between two rim vertices is an edge of the rim, and no
/// triangle has all three vertices there. (So the surface touches the ground along the rim only.)
struct PlanarMesh {
    std::vector<Vec2> vertices;  ///< [m]
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> loop_starts;  ///< loop k: vertices [loop_starts[k], loop_starts[k+1]); outer first,
                                             ///< liquid on the left; the last entry is the number of rim vertices
    Lattice lattice;                         ///< without runs where nothing is known to be regular

    [[nodiscard]] std::size_t loopCount() const { return loop_starts.empty() ? 0 : loop_starts.size() - 1; }
    [[nodiscard]] std::uint32_t rimVertexCount() const { return loop_starts.empty() ? 0 : loop_starts.back(); }
    [[nodiscard]] bool onRim(std::uint32_t vertex) const { return vertex < rimVertexCount(); }

    /// Guarantees: returns only when indices, winding, rim and lattice invariants hold.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// The vertex after a rim vertex along its loop.
std::uint32_t nextOnRim(const PlanarMesh& mesh, std::size_t loop, std::uint32_t vertex);

/// Twice the signed area of a triangle [m²].
double doubleArea(const PlanarMesh& mesh, const Triangle& triangle);

/// Area covered [m²].
double area(const PlanarMesh& mesh);

/// Length of all rim loops [m].
double rimLength(const PlanarMesh& mesh);

/// Smallest angle of any triangle [rad].
double minAngle(const PlanarMesh& mesh);

}  // namespace droplet
