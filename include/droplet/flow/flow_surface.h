// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// What a mesh had that droplets have to get over.
struct FlowSurfaceReport {
    std::size_t triangles = 0;       ///< of the mesh
    std::size_t without_area = 0;    ///< triangles that were left out: too thin to have a normal
    std::size_t duplicates = 0;      ///< triangles that were left out: another has the same corners
    std::size_t turned = 0;          ///< triangles that were turned over to face outward, or as their neighbours do
    std::size_t inside_out = 0;      ///< of these, triangles of closed parts that faced inward as a whole
    std::size_t boundary_edges = 0;  ///< droplets fall off there
    std::size_t parts = 0;           ///< connected over edges
};

/// A mesh of triangles that droplets run over: each triangle knows its neighbours (the paper's neighbourhood graph).
///
/// Invariants: arrays have one length; every triangle has an area; neighbours name one another.
struct FlowSurface {
    /// No neighbour: an edge of the surface.
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    /// A triangle and its neighbours.
    struct Face {
        std::array<Vec3, 3> corners;             ///< [m]
        Vec3 normal;                             ///< unit, outward
        std::array<Vec3, 3> inward;              ///< unit, in the plane, away from the side from corner k to k + 1
        std::array<std::uint32_t, 3> neighbour;  ///< over that side, or kNone
        std::uint32_t source = 0;                ///< number of the triangle in the mesh
    };

    std::vector<Face> faces;   ///< triangles that droplets can stand on
    FlowSurfaceReport report;  ///< defects of the mesh
};

/// Makes the graph of a mesh from outside, by half-edges. Parts whose triangles wind differently are turned to agree;
/// a closed part that is inside out is turned as a whole.
/// @param vertices  [m], finite
/// @param triangles  indices of vertices; corners at the same place are joined
/// @throws Error     InvalidInput if no triangle has an area
FlowSurface flowSurface(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles);

/// The same surface with its long edges halved, until none is longer than a length: what droplets do to a face, they do
/// to the whole of it. Faces keep their `source`; the report stays that of the mesh.
/// @param surface  made by flowSurface()
/// @param longest  [m], > 0
/// @param most     halving ends before there are more faces, and twice as many as there were: needles need very many
/// @return         the surface itself if that leads to triangles without an area, by rounding
FlowSurface refined(const FlowSurface& surface, double longest, std::size_t most = 600'000);

}  // namespace droplet
