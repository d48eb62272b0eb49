// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "shape/gradient.h"

namespace droplet {

/// Symmetric 2×2 tensor.
struct SymmetricTensor {
    double xx = 1.0;
    double xy = 0.0;
    double yy = 1.0;
};

/// Operator K + wM, divided by the surface tension: ∫∇φ·G∇φ + w∫φφ over functions linear on triangles.
struct Operator {
    double mass_weight = 0.0;  ///< w = ρg⊥/σ; |w| is the inverse square of the capillary length on level ground [1/m²]
    std::vector<SymmetricTensor> tensors;  ///< G on every triangle; empty: the identity, the linear model
    std::vector<std::uint8_t> held;  ///< 1 at inner vertices with the value 0, which are not unknowns; empty: none

    /// Whether all rows in equilateral triangles are the same.
    [[nodiscard]] bool uniform() const { return tensors.empty() && held.empty(); }
};

/// Contribution of one triangle to the operator.
inline std::array<std::array<double, 3>, 3> elementMatrix(const PlanarMesh& mesh, std::size_t triangle,
                                                          const Operator& op)
{
    const Triangle& t = mesh.triangles[triangle];
    const double area = 0.5 * doubleArea(mesh, t);
    const std::array<Vec2, 3> hats = hatGradients(mesh, t);
    const SymmetricTensor g = op.tensors.empty() ? SymmetricTensor{} : op.tensors[triangle];
    std::array<std::array<double, 3>, 3> matrix{};
    for (std::size_t b = 0; b < 3; ++b) {
        const Vec2 flux{g.xx * hats[b].x + g.xy * hats[b].y, g.xy * hats[b].x + g.yy * hats[b].y};
        for (std::size_t a = 0; a < 3; ++a) {
            // ∫∇φa·G∇φb + w∫φaφb; the mass of a triangle is A/6 on the diagonal, A/12 off it.
            matrix[a][b] = area * (dot(hats[a], flux) + op.mass_weight / (a == b ? 6.0 : 12.0));
        }
    }
    return matrix;
}

/// Row of the operator at a point of equilateral triangles.
struct Stencil {
    double diagonal = 0.0;
    double neighbour = 0.0;  ///< value for each of the six neighbours
};

inline Stencil regularStencil(double edge, const Operator& op)
{
    const double area = 0.25 * std::numbers::sqrt3 * edge * edge;
    // Two angles of 60° are opposite to every edge: −½(cot 60° + cot 60°) = −1/√3. A row of K sums to 0.
    return {2.0 * std::numbers::sqrt3 + op.mass_weight * area, -std::numbers::inv_sqrt3 + op.mass_weight * area / 6.0};
}

}  // namespace droplet
