// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "droplet/flow/flow_terrain.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Rings of a seated droplet's base inside its rim, and a middle.
inline constexpr std::size_t kBaseRings = 2;

/// Vertices of a base: the rim, its rings and the middle.
constexpr std::size_t baseVertices(std::size_t rim)
{
    return (1 + kBaseRings) * rim + 1;
}

/// Triangles of a base, which face down. The middle is the last vertex.
/// @param rim  number of vertices on the rim
std::vector<Triangle> baseTriangles(std::size_t rim);

/// Signed volume between triangles and a point [m³]; of a closed mesh the volume that it encloses.
double volumeUnder(std::span<const Vec3> vertices, std::span<const Triangle> triangles, Vec3 origin = {});

/// A droplet on flat ground, in space.
struct FlatDroplet {
    std::span<Vec3> vertices;             ///< those of the rim first, in order, counter-clockwise seen from above
    std::span<Vec3> normals;              ///< unit
    std::span<const Triangle> triangles;  ///< of its open surface, numbered from its first vertex
    std::size_t rim = 0;                  ///< number of vertices on the rim
};

/// Moves a droplet onto the ground below it. Its rim and its base follow the ground along the droplet's normal, its
/// surface the rim, smoothly. Where ground ends, falls away or rises too steeply, as at an edge, the rim is drawn back
/// to there; where it cannot be, the rim goes to the nearest point. The height then gives back the volume, or a
/// larger width, and normals follow.
/// @return  vertices of its base
std::vector<Vec3> seat(const FlowTerrain& terrain, const DropletFrame& frame, FlatDroplet droplet);

}  // namespace droplet
