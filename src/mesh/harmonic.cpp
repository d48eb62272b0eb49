// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/harmonic.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace droplet {

Eigen::MatrixX2d harmonic(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                          const Eigen::MatrixX2d& rim)
{
    const auto on_rim = static_cast<std::uint32_t>(rim.rows());
    const Eigen::Index inner = static_cast<Eigen::Index>(vertices.size()) - rim.rows();
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(inner, 2);
    if (inner == 0) {
        return right;
    }
    const auto row_of = [&](std::uint32_t v) { return static_cast<int>(v - on_rim); };
    std::vector<Eigen::Triplet<double>> entries;
    for (const Triangle& t : triangles) {
        const double twice = length(cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]));
        for (std::size_t k = 0; k < 3; ++k) {
            // Weight of the edge opposite vertex k: half the cotangent of the angle at k.
            const std::uint32_t a = t[(k + 1) % 3];
            const std::uint32_t b = t[(k + 2) % 3];
            const Vec3& tip = vertices[t[k]];
            const double weight = 0.5 * dot(vertices[a] - tip, vertices[b] - tip) / twice;
            for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
                if (from < on_rim) {
                    continue;
                }
                entries.emplace_back(row_of(from), row_of(from), weight);
                if (to < on_rim) {
                    right.row(row_of(from)) += weight * rim.row(static_cast<Eigen::Index>(to));
                } else {
                    entries.emplace_back(row_of(from), row_of(to), -weight);
                }
            }
        }
    }
    Eigen::SparseMatrix<double> matrix(inner, inner);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
}

}  // namespace droplet
