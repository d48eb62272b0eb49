// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// For each vertex, the index of the first vertex at the same place.
std::vector<std::uint32_t> firstAtPlace(const std::vector<Vec3>& vertices);

/// Normalises normals. A zero normal is replaced by the mean over the triangles around its place, weighted by their
/// angles there; copies of a vertex share one mean.
/// @param place    firstAtPlace(vertices)
/// @param normals  one per position
void fillNormals(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                 const std::vector<std::uint32_t>& place, std::vector<Vec3>& normals);

/// Triangles with a vertex for every side of their creases.
struct CreasedTriangles {
    std::vector<Triangle> triangles;    ///< as before; corners beyond the vertices name the copies
    std::vector<std::uint32_t> copies;  ///< the vertex that each further vertex copies
    std::vector<Vec3> normals;          ///< of all vertices, the copies too; 0 where no triangle with an area is
};

/// Divides vertices without a normal at creases: edges of 60 degrees or more, and those that not just two triangles
/// share. Each side gets the mean over its own triangles, weighted as by fillNormals. Vertices with a normal stay
/// whole.
/// @param place    firstAtPlace(vertices)
/// @param normals  one per position; 0: none
CreasedTriangles divideAtCreases(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                 const std::vector<std::uint32_t>& place, const std::vector<Vec3>& normals);

}  // namespace droplet
