// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

using Triangle = std::array<std::uint32_t, 3>;  ///< indices of three vertices

/// Part of a mesh that is an equilateral lattice, as triangulate() recorded it; solving is fast there.
struct Lattice;

/// Triangulated footprint of one droplet.
///
/// Invariants: rim vertices come first, loop after loop, in order. Triangles are counter-clockwise with positive area
/// and cover the polygon of the loops once. An edge between two rim vertices is an edge of the rim, and no triangle has
/// three rim vertices; so the surface touches the ground only along the rim.
struct PlanarMesh {
    std::vector<Vec2> vertices;              ///< [m]
    std::vector<Triangle> triangles;         ///< counter-clockwise
    std::vector<std::uint32_t> loop_starts;  ///< loop k: vertices loop_starts[k] … loop_starts[k+1] − 1; outer loop
                                             ///< first, liquid on the left; last entry: number of rim vertices
    std::shared_ptr<const Lattice> lattice;  ///< null if no part is known to be regular; reset it when you move
                                             ///< vertices or change triangles

    /// Number of loops.
    [[nodiscard]] std::size_t loopCount() const { return loop_starts.empty() ? 0 : loop_starts.size() - 1; }
    /// Number of rim vertices.
    [[nodiscard]] std::uint32_t rimVertexCount() const { return loop_starts.empty() ? 0 : loop_starts.back(); }
    /// Whether a vertex is on the rim.
    [[nodiscard]] bool onRim(std::uint32_t vertex) const { return vertex < rimVertexCount(); }

    /// Checks indices, winding, rim and the recorded lattice.
    /// @throws Error InvalidArgument if one is wrong
    void validate() const;
};

/// Next vertex after a rim vertex along its loop.
std::uint32_t nextOnRim(const PlanarMesh& mesh, std::size_t loop, std::uint32_t vertex);

/// Twice the signed area of a triangle [m²].
double doubleArea(const PlanarMesh& mesh, const Triangle& triangle);

/// Area of a mesh [m²].
double area(const PlanarMesh& mesh);

/// Length of all rim loops [m].
double rimLength(const PlanarMesh& mesh);

/// Smallest angle of any triangle [rad].
double minAngle(const PlanarMesh& mesh);

}  // namespace droplet
