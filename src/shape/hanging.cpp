// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/hanging.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "blocks.h"

namespace droplet {
namespace {

/// ∫φφ·x at inner vertices, for an x that is 0 on the rim.
std::vector<double> massTimes(const PlanarMesh& mesh, const std::vector<double>& x)
{
    const std::uint32_t rim = mesh.rimVertexCount();
    std::vector<double> result(x.size(), 0.0);
    const auto at = [&](std::uint32_t v) { return mesh.onRim(v) ? 0.0 : x[v - rim]; };
    for (const Triangle& t : mesh.triangles) {
        const double twelfth = doubleArea(mesh, t) / 24.0;
        const double sum = at(t[0]) + at(t[1]) + at(t[2]);
        for (const std::uint32_t v : t) {
            if (!mesh.onRim(v)) {
                result[v - rim] += twelfth * (sum + at(v));
            }
        }
    }
    return result;
}

}  // namespace

double criticalWeight(const Energy& energy, const Operator& op, ConstrainedSolver& solver)
{
    constexpr int kMaxIterations = 300;
    constexpr double kTolerance = 1e-9;  // for the eigenvalue; its error is the square of the vector's error
    const PlanarMesh& mesh = energy.mesh();
    Operator stiffness = op;
    stiffness.mass_weight = 0.0;
    solver.prepare(stiffness);

    // Inverse iteration. Fractions of multiples of the golden ratio have a share in every direction.
    const std::size_t inner = mesh.vertices.size() - mesh.rimVertexCount();
    std::vector<double> x(inner);
    for (std::size_t i = 0; i < inner; ++i) {
        x[i] = std::fmod(0.6180339887498949 * static_cast<double>(i + 1), 1.0) - 0.5;
        x[i] = op.held.empty() || op.held[i] == 0 ? x[i] : 0.0;
    }
    double eigenvalue = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kMaxIterations; ++k) {
        ConstrainedProblem problem;
        problem.right = massTimes(mesh, x);
        ConstrainedSolution solution = solver.solve(problem);
        if (!solution.converged) {
            return 0.0;
        }
        const std::vector<double>& y = solution.values;
        const std::vector<double> mass = massTimes(mesh, y);
        // Ky = Mx + λm and mᵀy = 0: the Rayleigh quotient is yᵀMx / yᵀMy.
        const double quotient = dotProduct(y, problem.right) / dotProduct(y, mass);
        const double scale = 1.0 / std::sqrt(dotProduct(y, mass));
        x = std::move(solution.values);
        for (double& value : x) {
            value *= scale;
        }
        const bool settled = std::abs(quotient - eigenvalue) <= kTolerance * quotient;
        eigenvalue = quotient;
        if (settled) {
            break;
        }
    }
    return eigenvalue;
}

bool shareOnePressure(const std::vector<double>& pressure_rises)
{
    double compliance = 0.0;
    for (const double rise : pressure_rises) {
        compliance += 1.0 / rise;
    }
    const auto falling = std::count_if(pressure_rises.begin(), pressure_rises.end(), [](double r) { return r < 0.0; });
    return falling == 0 || (falling == 1 && compliance < 0.0);
}

double criticalSharedWeight(const std::vector<Member>& droplets)
{
    constexpr double kTolerance = 1e-3;
    double high = std::numeric_limits<double>::infinity();
    for (const Member& droplet : droplets) {
        high = std::min(high, criticalWeight(*droplet.energy, Operator{}, *droplet.solver));
    }
    double low = 0.0;
    while (high - low > kTolerance * high) {
        const double middle = 0.5 * (low + high);
        std::vector<double> rises;
        bool solved = true;
        for (const Member& droplet : droplets) {
            Operator op;
            op.mass_weight = -middle;
            droplet.solver->prepare(op);
            const ConstrainedSolution solution = droplet.solver->solve({{}, 1.0});
            rises.push_back(solution.multiplier);
            solved = solved && solution.converged;
        }
        (solved && shareOnePressure(rises) ? low : high) = middle;
    }
    return low;
}

}  // namespace droplet
