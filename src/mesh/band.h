// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

/// Triangulates polygons with points inside, and adds no vertex: inner edges may join two rim vertices.
/// @return triangles by index: vertices of the polygons in order, then the points
std::vector<Triangle> triangulateAsIs(const std::vector<std::vector<Vec2>>& polygons, const std::vector<Vec2>& points);

}  // namespace droplet
