// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"
#include "mesh/lattice_core.h"

namespace droplet {

/// Triangulates polygons with a lattice core inside: constrained Delaunay and refined in the band between, known inside
/// the core.
/// @param polygons  outer counter-clockwise, holes clockwise
/// @param core      of the same polygons
/// @param finest    length below which nothing is refined [m]
/// @throws Error    InvalidArgument if polygons cross or touch
PlanarMesh triangulateBand(const std::vector<std::vector<Vec2>>& polygons, const LatticeCore& core, double finest);

/// Triangulates polygons with points inside: constrained Delaunay, and refined.
/// @param points  inside the polygons, none twice
PlanarMesh triangulatePoints(const std::vector<std::vector<Vec2>>& polygons, const std::vector<Vec2>& points,
                             double finest);

/// What is to be triangulated between a rim and triangles that stay.
struct Cavity {
    std::vector<std::vector<Vec2>> polygons;         ///< liquid on the left
    std::vector<std::vector<std::uint8_t>> on_rim;   ///< of every vertex: whether it is on the rim
    std::vector<std::vector<std::uint8_t>> at_seam;  ///< whether a triangle that stays has it; an edge between two such
                                                     ///< vertices is not split
};

/// What a cavity is filled with.
struct Filling {
    std::vector<Vec2> points;         ///< new ones
    std::vector<Triangle> triangles;  ///< by index: vertices of the polygons in order, then the points
    std::vector<std::vector<std::vector<std::uint32_t>>> splits;  ///< points on every edge of every polygon, in order
};

/// Fills a cavity with triangles: constrained Delaunay, and refined.
/// @param points  inside, none twice
/// @throws Error  InvalidArgument if polygons cross or touch
Filling fill(const Cavity& cavity, const std::vector<Vec2>& points, double finest);

/// Triangulates polygons with points inside, and adds no vertex: inner edges may join two rim vertices.
/// @return triangles by index: vertices of the polygons in order, then the points
std::vector<Triangle> triangulateAsIs(const std::vector<std::vector<Vec2>>& polygons, const std::vector<Vec2>& points);

}  // namespace droplet
