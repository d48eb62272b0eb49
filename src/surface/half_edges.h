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

/// Triangles of any kind, from outside, as half-edges. Half-edges hold manifolds alone: a triangle whose edge is taken,
/// that touches a vertex already closed, or names a place twice, stands apart, with copies of its vertices.
struct HalfEdges {
    OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits> mesh;  ///< its first vertices are the places
    std::vector<std::uint32_t> triangles;                 ///< of every face
    std::vector<std::uint32_t> apart;                     ///< triangles that stand apart
};

/// @param places     [m]
/// @param triangles  of places
/// @throws Error     InvalidArgument for more than 2²⁸ triangles
HalfEdges halfEdges(const std::vector<Vec3>& places, const std::vector<Triangle>& triangles);

/// Triangles joined with all others that share an edge, those apart, too.
/// @param triangles  as handed to halfEdges
UnionFind joinedAcrossEdges(const HalfEdges& half_edges, const std::vector<Triangle>& triangles);

/// What triangles are, topologically: as topology(surface), by half-edges.
Topology topology(const HalfEdges& half_edges);

/// The half-edges of a surface, its copies of vertices welded.
/// @param surface  valid
HalfEdges halfEdges(const Surface& surface);

}  // namespace droplet
