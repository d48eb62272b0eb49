// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// Surface of the liquid over one footprint, or over several at one pressure: triangles in space, pinned along the rim.
///
/// Where liquid does not hang over its rim, the surface is a height field: its vertices are straight above or below
/// those of the mesh that it was solved on, in the same order, and have the same triangles. Otherwise it has triangles
/// of its own, and a footprint.
///
/// Invariants: a manifold whose boundary is the rim; the rim's vertices come first, loop after loop, as those of
/// PlanarMesh; triangles are counter-clockwise from outside.
struct CapillarySurface {
    std::vector<Vec3> vertices = {};              ///< places; those of the rim are on the ground [m]
    std::vector<Triangle> triangles = {};         ///< indices of three vertices
    std::vector<std::uint32_t> loop_starts = {};  ///< as of PlanarMesh; of several footprints, one after another, each
                                                  ///< beginning with its outer loop
    std::vector<std::uint8_t> dry = {};           ///< 1 at inner vertices that lie on the ground; empty: there are none
    /// Angle between liquid and ground at every rim vertex [rad]; up to π, and below 0 where a height field sinks into
    /// the ground, or hardly rises from it.
    std::vector<double> contact_angle = {};
    double pressure = 0.0;                        ///< λ, the pressure at the plane's origin [Pa]
    std::shared_ptr<const Lattice> lattice = {};  ///< of a height field's mesh
    /// Footprint that the liquid may hang over, with rounded inner corners; none: the surface is a height field.
    std::optional<PlanarMesh> footprint = {};

    /// Number of rim vertices.
    [[nodiscard]] std::uint32_t rimVertexCount() const { return loop_starts.empty() ? 0 : loop_starts.back(); }
    /// Whether a vertex is on the rim.
    [[nodiscard]] bool onRim(std::uint32_t vertex) const { return vertex < rimVertexCount(); }
    /// Whether the surface is a height field.
    [[nodiscard]] bool isHeightField() const { return !footprint; }

    /// Checks that counts and indices belong together.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Ground under a surface, seen from above: the footprint of a height field has the places and triangles of its
/// surface.
PlanarMesh footprintOf(const CapillarySurface& surface);

/// Rim of a surface, seen from above: a mesh without inner vertices and triangles.
PlanarMesh rimOf(const CapillarySurface& surface);

/// Smallest angle of all triangles of a surface [rad].
double minAngle(const CapillarySurface& surface);

/// Surfaces at one pressure as one that covers several footprints.
/// @param surfaces  at least one, not height fields
CapillarySurface join(const std::vector<CapillarySurface>& surfaces);

/// Surfaces over the single footprints of one that covers several, in their order; the inverse of join().
std::vector<CapillarySurface> separate(const CapillarySurface& surface);

}  // namespace droplet
