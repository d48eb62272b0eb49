// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Triangles of the first of all copies of every vertex.
/// @param weld  index of the first copy, for each vertex
std::vector<Triangle> weldedTriangles(std::vector<Triangle> triangles, const std::vector<std::uint32_t>& weld);

/// First and second vertex.
using DirectedEdge = std::array<std::uint32_t, 2>;

/// Edges without a neighbour, in the direction of their triangles; ascending.
std::vector<DirectedEdge> openEdges(const std::vector<Triangle>& triangles);

/// Loops of edges, against their direction: as the triangles on the other side have them. Loops that touch in a vertex
/// are several. Each begins with its smallest vertex, unless it touches another.
std::vector<std::vector<std::uint32_t>> loopsOf(const std::vector<DirectedEdge>& edges);

}  // namespace droplet
