// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Data of a vertex. A struct with defaults, because CGAL leaves plain numbers uninitialised.
struct VertexTag {
    std::optional<std::uint32_t> index;  ///< index in the resulting mesh
    bool is_rim = false;
    bool is_core = false;     ///< a point of the lattice's core, which stays in place
    std::uint32_t order = 0;  ///< order of insertion by refinement; 0 for other vertices
};

using TriangulationData =
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<VertexTag, Kernel>,
                                         CGAL::Delaunay_mesh_face_base_2<Kernel>>;

/// Crossing constraints throw; CGAL would otherwise add vertices silently.
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, TriangulationData,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

using VertexHandle = Triangulation::Vertex_handle;

/// Vertices with which a triangulation begins.
struct Inserted {
    std::vector<std::vector<VertexHandle>> loops;  ///< vertices of every polygon, in order
    std::vector<VertexHandle> points;              ///< in order
};

/// Inserts closed polygons as constraints, and points, in time that does not depend on their shape.
/// @throws Error InvalidArgument if polygons cross or touch, or a point is given twice
Inserted insert(Triangulation& triangulation, const std::vector<std::vector<Vec2>>& polygons,
                const std::vector<Vec2>& points = {});

/// Throws the error for loops that cross or touch.
[[noreturn]] void throwCrossing();

/// Marks the faces inside the constraints by the even-odd rule.
void markDomain(Triangulation& triangulation);

}  // namespace droplet
