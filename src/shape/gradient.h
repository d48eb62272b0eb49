// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Gradients of the three linear functions that are 1 at one vertex of a triangle and 0 at the others [1/m].
inline std::array<Vec2, 3> hatGradients(const PlanarMesh& mesh, const Triangle& t)
{
    const double twice = doubleArea(mesh, t);
    std::array<Vec2, 3> gradients{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 opposite = mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[(k + 1) % 3]];
        gradients[k] = (1.0 / twice) * Vec2{-opposite.y, opposite.x};
    }
    return gradients;
}

/// Gradient on a triangle of the linear function with these values at vertices.
inline Vec2 gradient(const PlanarMesh& mesh, const Triangle& t, const std::vector<double>& values)
{
    const std::array<Vec2, 3> hats = hatGradients(mesh, t);
    return values[t[0]] * hats[0] + values[t[1]] * hats[1] + values[t[2]] * hats[2];
}

}  // namespace droplet
