// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

inline constexpr std::size_t kBodySlices = 28;                      ///< vertices around the footprint
inline constexpr std::size_t kBodyRings = 7;                        ///< rim included, apex not
inline constexpr std::size_t kBodyApex = kBodySlices * kBodyRings;  ///< index of the last vertex
inline constexpr std::size_t kBodyVertices = kBodyApex + 1;         ///< rings from the rim up, then the apex
inline constexpr std::size_t kBodyStride = kBodySlices + 2;         ///< of a ring in a BodyGrid

/// Surface of a droplet over z = 0: rings of slices and the apex. Each ring has a copy of its last slice in front and
/// one of its first slice behind.
struct BodyGrid {
    using Ring = std::array<double, kBodyStride>;

    /// Sets the vertex of a slice on a ring.
    void set(std::size_t ring, std::size_t slice, Vec3 place)
    {
        x[ring][slice + 1] = place.x;
        y[ring][slice + 1] = place.y;
        z[ring][slice + 1] = place.z;
    }

    std::array<Ring, kBodyRings> x;
    std::array<Ring, kBodyRings> y;
    std::array<Ring, kBodyRings> z;
    Vec3 apex;
    std::array<Vec3, kBodySlices> inward;  ///< direction of the surface at the rim, up the slice; of any length
};

/// Triangles of every body, wound outward; mirrored at y = 0.
std::vector<Triangle> bodyTriangles();

/// Fills the copies of slices.
void close(BodyGrid& grid);

/// Volume between the triangles and z = 0 [m³].
/// @param grid  closed
double volumeOf(const BodyGrid& grid);

/// Moves a body so that the centre of mass of its footprint is the origin, and scales it to a volume.
/// @param grid       rim at z = 0; any unit of length
/// @param vertices  receives kBodyVertices vertices [m]
/// @param normals    receives as many normals: across slices and rings
void finish(BodyGrid& grid, double volume, std::span<Vec3> vertices, std::span<Vec3> normals);

/// Writes a ball around the origin; its rim is one point.
void makeBall(double volume, std::span<Vec3> vertices, std::span<Vec3> normals);

}  // namespace droplet
