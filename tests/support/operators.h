// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "shape/operator.h"

namespace droplet::testing {

inline std::size_t unknownsOf(const PlanarMesh& mesh)
{
    return mesh.vertices.size() - mesh.rimVertexCount();
}

/// Positive definite, stretched up to 9 : 1 in any direction.
inline std::vector<SymmetricTensor> randomTensors(const PlanarMesh& mesh, std::mt19937& random)
{
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<SymmetricTensor> tensors;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const double angle = std::numbers::pi * uniform(random);
        const double along = std::pow(3.0, uniform(random));
        const double across = std::pow(3.0, uniform(random));
        const Vec2 d{std::cos(angle), std::sin(angle)};
        tensors.push_back({along * d.x * d.x + across * d.y * d.y, (along - across) * d.x * d.y,
                           along * d.y * d.y + across * d.x * d.x});
    }
    return tensors;
}

/// Inner vertices within two discs about vertices of the mesh.
inline std::vector<std::uint8_t> heldPatches(const PlanarMesh& mesh)
{
    const std::uint32_t rim = mesh.rimVertexCount();
    const double radius = 0.12 * std::sqrt(area(mesh));
    std::vector<std::uint8_t> held(unknownsOf(mesh), 0);
    for (const std::size_t centre : {held.size() / 3, held.size() - 1}) {
        for (std::size_t i = 0; i < held.size(); ++i) {
            if (length(mesh.vertices[rim + i] - mesh.vertices[rim + centre]) < radius) {
                held[i] = 1;
            }
        }
    }
    return held;
}

}  // namespace droplet::testing
