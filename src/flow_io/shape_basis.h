// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Vertices and normals of a mesh.
struct MeshShape {
    std::vector<Vec3> vertices;  ///< [m]
    std::vector<Vec3> normals;   ///< unit
};

/// Shapes of a mesh as sums: the first one, and a few changes with the weights of the shape.
struct ShapeBasis {
    std::vector<MeshShape> changes;  ///< of vertices and normals
    std::vector<std::vector<double>>
        weights;  ///< of every shape, one for each change; from 0 to 1, in the first shape 0
};

/// Largest deviations.
struct ShapeTolerance {
    double vertices = 0.0;  ///< [m]
    double normals = 0.0;   ///< of unit vectors, at 99 % of the vertices
};

/// Finds as few changes as shapes within a tolerance need: principal components, which are far fewer than the shapes
/// where bones move.
/// @param shapes  at least one, all of one size
ShapeBasis shapeBasis(const std::vector<MeshShape>& shapes, const ShapeTolerance& tolerance);

}  // namespace droplet
