// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// How a surface changes with the amount of liquid: at fill f, weight w = f − 1, its positions are
/// positions + w·change and its normals those of normals + w·change, brought to unit length.
struct Refill {
    double min = 0.0;             ///< fill, from 0
    double max = 2.0;             ///< fill; 1 lies between
    std::vector<Vec3> positions;  ///< change per fill of every vertex [m]; 0 on rim and base
    std::vector<Vec3> normals;    ///< change per fill of the normal, of which the surface has the direction at fill 1
};

/// The droplets' surface in space, ready to be written.
///
/// Invariants: arrays of vertices have one length, but contact_angle may be empty; triangles wind outward; normals have
/// unit length. Where a crisp edge needs two normals (the rim), the position stands twice and `weld` maps both copies
/// to the first.
struct Surface {
    std::vector<Vec3> positions;  ///< [m], z up, the plane at z = 0
    std::vector<Vec3> normals;    ///< unit, outward
    std::vector<Vec2> uvs;        ///< mask coordinates: (0,0) top left of the image, (1,1) bottom right
    std::vector<float>
        contact_angle;  ///< between liquid and ground at the liquid's vertices on the rim [rad]; 0 at others
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> weld;  ///< smallest index of a vertex at the same place; weld[i] ≤ i
    double mean_height = 0.0;         ///< volume over the area of the footprint that is not dry [m], ≥ 0
    std::optional<Refill> refill;     ///< where the surface can be filled and drained

    /// Guarantees: returns only when the invariants hold that can be checked without topology: there is a triangle,
    /// the arrays fit together, indices are in range, numbers finite, normals unit to 1e-6, welded copies at one place,
    /// and that they change alike.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// The surface with that many fills of liquid, as a viewer shows it at weight fill − 1.
/// @param surface  valid, with a refill
/// @param fill     from min to max
/// @return         without a refill; contact angles are left out, as they are not affine
/// @throws Error   InvalidArgument
Surface refilled(const Surface& surface, double fill);

/// What a surface is, topologically, with copies of a vertex welded. Only a manifold is counted: otherwise all is 0.
struct Topology {
    bool manifold = false;  ///< every edge in at most two triangles, consistently wound, every vertex one fan
    bool closed = false;    ///< manifold and no boundary edge
    long euler = 0;         ///< V − E + F over all components
    std::size_t components = 0;
    std::size_t boundary_loops = 0;
};

/// Examines how triangles lie around every vertex.
/// @throws Error InvalidArgument for an invalid surface, or one of more than 1 431 655 765 triangles
Topology topology(const Surface& surface);

/// Whether a surface is a manifold without boundary: topology(surface).closed alone.
/// @throws Error InvalidArgument as topology
bool isClosed(const Surface& surface);

/// Volume enclosed by a closed surface, by the divergence theorem on z [m³]; of an open one, the volume between it and
/// z = 0, where a base at z = 0 adds nothing.
double enclosedVolume(const Surface& surface);

}  // namespace droplet
