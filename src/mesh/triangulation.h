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

/// What a triangulation's vertex carries. A struct with defaults: CGAL leaves plain numbers uninitialised.
struct VertexTag {
    std::optional<std::uint32_t> index;  ///< in the mesh that is made of it
    bool is_rim = false;
    bool is_core = false;     ///< a point of the lattice's core, which stays where it is
    std::uint32_t order = 0;  ///< of its insertion, if refinement did it
};

using TriangulationData =
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<VertexTag, Kernel>,
                                         CGAL::Delaunay_mesh_face_base_2<Kernel>>;

/// Crossing constraints throw instead of adding vertices behind our backs.
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, TriangulationData,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

using VertexHandle = Triangulation::Vertex_handle;

/// What a triangulation was begun with.
struct Inserted {
    std::vector<std::vector<VertexHandle>> loops;  ///< every polygon's vertices, in order
    std::vector<VertexHandle> points;              ///< in order
};

/// Inserts closed polygons as constraints, and points, in time that does not depend on their shape.
/// @throws Error InvalidArgument if polygons cross or touch, or a point stands twice
Inserted insert(Triangulation& triangulation, const std::vector<std::vector<Vec2>>& polygons,
                const std::vector<Vec2>& points = {});

/// The error for loops that cross or touch.
[[noreturn]] void throwCrossing();

/// Marks the faces inside the constraints by the even-odd rule.
void markDomain(Triangulation& triangulation);

}  // namespace droplet
