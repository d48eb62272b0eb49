// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

using Triangle = std::array<std::uint32_t, 3>;

/// What triangulate() knows of the part of a mesh that is an equilateral lattice: solving is fast there.
struct Lattice;

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
    std::shared_ptr<const Lattice> lattice;  ///< null where nothing is known to be regular; whoever moves vertices or
                                             ///< changes triangles forgets it

    [[nodiscard]] std::size_t loopCount() const { return loop_starts.empty() ? 0 : loop_starts.size() - 1; }
    [[nodiscard]] std::uint32_t rimVertexCount() const { return loop_starts.empty() ? 0 : loop_starts.back(); }
    [[nodiscard]] bool onRim(std::uint32_t vertex) const { return vertex < rimVertexCount(); }

    /// Guarantees: returns only when indices, winding, rim hold, and what is known of the lattice is true.
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
