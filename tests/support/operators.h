// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
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

/// The operator as a matrix, and ∫φ; held vertices are treated like all others.
struct Assembled {
    Eigen::SparseMatrix<double> matrix;
    Eigen::VectorXd load;
};

inline Assembled assembled(const PlanarMesh& mesh, const Operator& op)
{
    const std::uint32_t rim = mesh.rimVertexCount();
    const auto size = static_cast<Eigen::Index>(unknownsOf(mesh));
    std::vector<Eigen::Triplet<double>> entries;
    Assembled result{Eigen::SparseMatrix<double>(size, size), Eigen::VectorXd::Zero(size)};
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        const auto matrix = elementMatrix(mesh, i, op);
        for (std::size_t a = 0; a < 3; ++a) {
            if (mesh.onRim(t[a])) {
                continue;
            }
            result.load[t[a] - rim] += doubleArea(mesh, t) / 6.0;
            for (std::size_t b = 0; b < 3; ++b) {
                if (!mesh.onRim(t[b])) {
                    entries.emplace_back(t[a] - rim, t[b] - rim, matrix[a][b]);
                }
            }
        }
    }
    result.matrix.setFromTriplets(entries.begin(), entries.end());
    return result;
}

/// K + wM.
inline Operator weighing(double mass_weight)
{
    return {mass_weight, {}, {}};
}

/// The exact model's operator on a spherical cap over the unit disc; at the rim it is stretched by the squared slope.
inline std::vector<SymmetricTensor> capTensors(const PlanarMesh& mesh, double rim_angle)
{
    std::vector<SymmetricTensor> tensors;
    for (const Triangle& t : mesh.triangles) {
        const Vec2 centre = (1.0 / 3.0) * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
        const Vec2 sine = std::sin(rim_angle) * centre;
        const double cosine = std::sqrt(1.0 - dot(sine, sine));
        tensors.push_back(
            {cosine * (1.0 - sine.x * sine.x), -cosine * sine.x * sine.y, cosine * (1.0 - sine.y * sine.y)});
    }
    return tensors;
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

/// Inner vertices inside two discs around vertices of the mesh.
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
