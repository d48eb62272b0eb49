// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "droplet/surface/surface.h"

namespace droplet {

/// Surface with fewer triangles.
struct SimplifiedSurface {
    Surface surface;     ///< of vertices of the whole one
    double error = 0.0;  ///< root mean square distance of a vertex from the planes of the triangles that it stands for,
                         ///< the largest; single points may lie farther off [m]
};

/// Leaves out vertices of a surface, those first whose loss moves it least, until it has few enough triangles.
///
/// Guarantees: a closed surface stays closed, with as many components and holes; vertices keep their place, normal, uv,
/// contact angle and change by a refill; both copies of a rim vertex go or stay, so that the rim is a polyline between
/// vertices of the old one. Triangles are no halves of quadrilaterals.
/// @param surface    valid
/// @param triangles  largest number of triangles, at least 1; there are more where fewer would change the topology
/// @throws Error     InvalidArgument
SimplifiedSurface simplify(const Surface& surface, std::size_t triangles);

/// Leaves out triangles of a surface, and the vertices that only they have. Quadrilaterals become triangles.
/// @param surface    valid, but its parts may be none
/// @param triangles  those that stay, of the first part first
/// @return           surface with as many parts
Surface withTriangles(const Surface& surface, std::vector<Triangle> triangles);

/// Joins the copies of every vertex to the first, which is the liquid's: one vertex for each place, and smooth shading
/// across the rim. Quadrilaterals become triangles.
/// @param surface  valid
/// @throws Error   InvalidArgument
Surface welded(const Surface& surface);

}  // namespace droplet
