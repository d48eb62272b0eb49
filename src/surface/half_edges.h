// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/surface/surface.h"
#include "droplet/vector.h"
#include "union_find.h"

namespace droplet {

struct HalfEdgeTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};

/// Half-edges of any triangles from outside. Half-edges can only store manifolds. So a triangle gets copies of its
/// vertices if its edge is taken, if one of its vertices is closed already, or if it contains a place twice.
struct HalfEdges {
    OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits> mesh;  ///< its first vertices are the given vertices
    std::vector<std::uint32_t> triangles;                 ///< triangle of every face
    std::vector<std::uint32_t> separate;                  ///< triangles with vertices of their own
};

/// Makes half-edges.
/// @param places     vertices [m]
/// @param triangles  indices of places
/// @throws Error     InvalidArgument: more than 2²⁸ triangles
HalfEdges halfEdges(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles);

/// Joins triangles that share an edge, also those with vertices of their own.
/// @param triangles  argument of halfEdges
UnionFind joinedAcrossEdges(const HalfEdges& half_edges, const std::vector<Triangle>& triangles);

/// Topology of triangles, as topology(surface).
Topology topology(const HalfEdges& half_edges);

/// Half-edges of a surface, with copies of a vertex welded.
/// @param surface  valid
HalfEdges halfEdges(const Surface& surface);

}  // namespace droplet
