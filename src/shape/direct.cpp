// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/direct.h"

#include <Eigen/SparseCholesky>
#include <array>
#include <cstdint>
#include <vector>

#include "shape/cholmod_factor.h"

namespace droplet {
namespace {

template <typename Factor>
LinearSolution solveFactored(const Factor& factor, const SparseSystem& system)
{
    LinearSolution solution;
    if (factor.info() != Eigen::Success) {
        return solution;
    }
    const auto symmetric = system.matrix.selfadjointView<Eigen::Lower>();
    Eigen::VectorXd values = factor.solve(system.load);
    // One step of refinement: the factorisation of a fine mesh loses some digits.
    values += factor.solve(Eigen::VectorXd(system.load - symmetric * values));
    solution.residual = Eigen::VectorXd(system.load - symmetric * values).norm() / system.load.norm();
    solution.integral = system.load.dot(values);
    solution.values.assign(values.data(), values.data() + values.size());
    solution.iterations = 1;
    solution.converged = solution.residual < kLargestResidual;
    return solution;
}

}  // namespace

SparseSystem assemble(const PlanarMesh& mesh, const Operator& op)
{
    const std::uint32_t rim = mesh.rimVertexCount();
    const auto inner = static_cast<Eigen::Index>(mesh.vertices.size() - rim);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(6 * mesh.triangles.size());
    SparseSystem system;
    system.load = Eigen::VectorXd::Zero(inner);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        const auto matrix = elementMatrix(mesh, i, op);
        const double third = doubleArea(mesh, t) / 6.0;
        for (std::size_t a = 0; a < 3; ++a) {
            if (mesh.onRim(t[a])) {
                continue;
            }
            system.load[t[a] - rim] += third;
            for (std::size_t b = 0; b < 3; ++b) {
                if (!mesh.onRim(t[b]) && t[a] >= t[b]) {
                    entries.emplace_back(t[a] - rim, t[b] - rim, matrix[a][b]);
                }
            }
        }
    }
    system.matrix.resize(inner, inner);
    system.matrix.setFromTriplets(entries.begin(), entries.end());
    return system;
}

LinearSolution solveByLlt(const SparseSystem& system)
{
    return solveFactored(Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower>(system.matrix), system);
}

LinearSolution solveByCholmod(const SparseSystem& system)
{
    return solveFactored(CholmodFactor(system.matrix), system);
}

}  // namespace droplet
