// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <numbers>

#include "droplet/mesh/planar_mesh.h"
#include "shape/gradient.h"

namespace droplet {

/// The operator K + wM of the linear model, divided by the surface tension: stiffness and mass matrix of functions
/// linear on triangles, w = ρg/σ the inverse square of the capillary length [1/m²].
struct Operator {
    double mass_weight = 0.0;
};

/// One triangle's share of the operator.
inline std::array<std::array<double, 3>, 3> elementMatrix(const PlanarMesh& mesh, const Triangle& t, const Operator& op)
{
    const double area = 0.5 * doubleArea(mesh, t);
    const std::array<Vec2, 3> hats = hatGradients(mesh, t);
    std::array<std::array<double, 3>, 3> matrix{};
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
            // ∫∇φa·∇φb + w∫φaφb; the mass of a triangle is A/6 on the diagonal, A/12 off it.
            matrix[a][b] = area * (dot(hats[a], hats[b]) + op.mass_weight / (a == b ? 6.0 : 12.0));
        }
    }
    return matrix;
}

/// The operator's row at a point around which all triangles are equilateral.
struct Stencil {
    double diagonal = 0.0;
    double neighbour = 0.0;  ///< each of the six
};

inline Stencil regularStencil(double edge, const Operator& op)
{
    const double area = 0.25 * std::numbers::sqrt3 * edge * edge;
    // Two angles of 60° face every edge: −½(cot 60° + cot 60°) = −1/√3; a row of K sums to 0.
    return {2.0 * std::numbers::sqrt3 + op.mass_weight * area, -std::numbers::inv_sqrt3 + op.mass_weight * area / 6.0};
}

}  // namespace droplet
