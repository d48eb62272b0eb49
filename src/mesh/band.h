// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"
#include "mesh/lattice_core.h"

namespace droplet {

/// Triangulates polygons with a lattice core inside. The band between them is constrained Delaunay and refined; the
/// triangles of the core are known.
/// @param polygons  outer counter-clockwise, holes clockwise
/// @param core      made from the same polygons
/// @param finest    length below which nothing is refined [m]
/// @throws Error    InvalidArgument if polygons cross or touch
PlanarMesh triangulateBand(const std::vector<std::vector<Vec2>>& polygons, const LatticeCore& core, double finest);

/// Triangulates polygons with points inside: constrained Delaunay, refined.
/// @param points  inside the polygons, all different
PlanarMesh triangulatePoints(const std::vector<std::vector<Vec2>>& polygons, const std::vector<Vec2>& points,
                             double finest);

/// Region to triangulate between a rim and triangles that stay.
struct Cavity {
    std::vector<std::vector<Vec2>> polygons;         ///< liquid on the left
    std::vector<std::vector<std::uint8_t>> on_rim;   ///< whether a vertex is on the rim
    std::vector<std::vector<std::uint8_t>> at_seam;  ///< whether a vertex belongs to a triangle that stays; edges
                                                     ///< between two such vertices are not split
};

/// Triangles that fill a cavity.
struct Filling {
    std::vector<Vec2> points;         ///< new points
    std::vector<Triangle> triangles;  ///< indices: the polygons' vertices in order, then the points
    std::vector<std::vector<std::vector<std::uint32_t>>> splits;  ///< points on every edge of every polygon, in order
};

/// Fills a cavity with triangles: constrained Delaunay, refined.
/// @param points  inside, all different
/// @throws Error  InvalidArgument if polygons cross or touch
Filling fill(const Cavity& cavity, const std::vector<Vec2>& points, double finest);

/// Triangulates polygons with points inside and adds no vertex; inner edges may join two rim vertices.
/// @return triangles by index: the polygons' vertices in order, then the points; each begins with its smallest index,
/// and
///         they ascend
std::vector<Triangle> triangulateUnrefined(const std::vector<std::vector<Vec2>>& polygons,
                                           const std::vector<Vec2>& points);

}  // namespace droplet
