// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/constrained.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "shape/direct.h"
#include "support/domains.h"
#include "support/operators.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::heldPatches;
using testing::randomTensors;
using testing::unknownsOf;

PlanarMesh discMesh(std::size_t triangles)
{
    return triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = triangles, .edge = {}})[0];
}

/// An operator with everything that there may be.
Operator wildOperator(const PlanarMesh& mesh, double mass, std::mt19937& random)
{
    return {mass / area(mesh), randomTensors(mesh, random), heldPatches(mesh)};
}

std::vector<double> randomRight(const PlanarMesh& mesh, std::mt19937& random)
{
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<double> right(unknownsOf(mesh));
    for (double& r : right) {
        r = uniform(random);
    }
    return right;
}

/// What is asked of a solution, by the matrix assembled triangle by triangle.
void expectSolves(const PlanarMesh& mesh, const Operator& op, const ConstrainedProblem& problem,
                  const ConstrainedSolution& solution)
{
    ASSERT_TRUE(solution.converged);
    ASSERT_EQ(solution.values.size(), unknownsOf(mesh));
    const SparseSystem system = assemble(mesh, op);
    const Eigen::Map<const Eigen::VectorXd> x(solution.values.data(),
                                              static_cast<Eigen::Index>(solution.values.size()));
    Eigen::VectorXd right = Eigen::VectorXd::Zero(x.size());
    if (!problem.right.empty()) {
        right = Eigen::Map<const Eigen::VectorXd>(problem.right.data(), x.size());
    }
    Eigen::VectorXd load = system.load;
    Eigen::VectorXd residual = right + solution.multiplier * load - system.matrix.selfadjointView<Eigen::Lower>() * x;
    for (std::size_t i = 0; i < op.held.size(); ++i) {
        if (op.held[i] != 0) {
            EXPECT_EQ(solution.values[i], 0.0) << i;
            const auto row = static_cast<Eigen::Index>(i);
            right[row] = residual[row] = load[row] = 0.0;
        }
    }
    const double scale = std::max({right.norm(), std::abs(solution.multiplier) * load.norm(),
                                   std::abs(op.mass_weight) * load.cwiseProduct(x).norm()});
    EXPECT_LE(residual.norm(), 1e-9 * scale);
    // The last digits depend on the order of sums.
    EXPECT_NEAR(residual.norm() / scale, solution.residual, 1e-11);
    EXPECT_NEAR(load.dot(x), problem.volume, 1e-11 * (std::abs(problem.volume) + load.cwiseProduct(x).lpNorm<1>()));
}

TEST(DirectSolver, SolvesOnTheZoo)
{
    std::mt19937 random(1);
    for (const auto& [name, domain] : testing::zoo()) {
        const PlanarMesh mesh = triangulate(domain, {.triangles = 3000, .edge = {}})[0];
        for (const Solver kind : {Solver::Llt, Solver::Cholmod}) {
            const auto solver = directSolver(mesh, kind);
            for (const double mass : {0.0, 5.0, 1e4, -1.0}) {
                SCOPED_TRACE(name + " " + std::to_string(mass));
                const Operator op = wildOperator(mesh, mass, random);
                solver->prepare(op);
                EXPECT_STREQ(solver->method(), mass < 0.0                ? "simplicial-ldlt"
                                               : kind == Solver::Cholmod ? "cholmod-supernodal"
                                                                         : "simplicial-llt");
                const double volume = 0.1 * std::pow(area(mesh), 1.5);
                for (const ConstrainedProblem& problem :
                     {ConstrainedProblem{{}, volume}, ConstrainedProblem{randomRight(mesh, random), 0.0},
                      ConstrainedProblem{randomRight(mesh, random), volume}}) {
                    expectSolves(mesh, op, problem, solver->solve(problem));
                }
                // Nothing of the operators before is left.
                const auto fresh = directSolver(mesh, kind);
                fresh->prepare(op);
                EXPECT_EQ(fresh->solve({{}, volume}).values, solver->solve({{}, volume}).values);
            }
        }
    }
}

TEST(DirectSolver, NothingAskedIsNothing)
{
    const PlanarMesh mesh = discMesh(500);
    const auto solver = directSolver(mesh, Solver::Llt);
    solver->prepare({});
    const ConstrainedSolution solution = solver->solve({});
    EXPECT_TRUE(solution.converged);
    EXPECT_EQ(solution.multiplier, 0.0);
    EXPECT_EQ(solution.values, std::vector<double>(unknownsOf(mesh), 0.0));
}

// A disc under a ceiling: u = c(1 − J₀(kr)/J₀(k)) with k² = −w, λ = wc, V = 2πc(½ − J₁(k)/(kJ₀(k))) on R = 1. At the
// first root of J₀ A is singular and λ = 0, but the volume holds the droplet; at the first root of J₁ it falls.
TEST(DirectSolver, HangsAsBesselSays)
{
    const auto j0 = [](double x) { return std::cyl_bessel_j(0.0, x); };
    const auto j1 = [](double x) { return std::cyl_bessel_j(1.0, x); };
    for (const double k : {1.0, 2.0, 2.404825557695773, 3.0, 3.7}) {
        std::vector<double> errors;
        for (const std::size_t triangles : {4000U, 16000U}) {
            const PlanarMesh mesh = discMesh(triangles);
            const auto solver = directSolver(mesh, Solver::Llt);
            solver->prepare({.mass_weight = -k * k, .tensors = {}, .held = {}});
            const ConstrainedProblem problem{{}, 1.0};
            const ConstrainedSolution solution = solver->solve(problem);
            expectSolves(mesh, {.mass_weight = -k * k, .tensors = {}, .held = {}}, problem, solution);
            // Both of u and V times J₀(k), for the sake of its root.
            const double factor = 1.0 / (2.0 * std::numbers::pi * (0.5 * j0(k) - j1(k) / k));
            double error = std::abs(solution.multiplier + k * k * j0(k) * factor);
            for (std::size_t i = 0; i < solution.values.size(); ++i) {
                const double r = length(mesh.vertices[mesh.rimVertexCount() + i]);
                error = std::max(error, std::abs(solution.values[i] - factor * (j0(k) - j0(k * r))));
            }
            errors.push_back(error);
        }
        EXPECT_LT(errors[0], 0.02) << k;
        EXPECT_GT(errors[0] / errors[1], 3.3) << k;
    }
}

/// The largest −w at which a droplet hangs on a mesh.
double criticalWeight(const PlanarMesh& mesh, double low, double high)
{
    const auto solver = directSolver(mesh, Solver::Llt);
    while (high - low > 1e-7 * high) {
        const double middle = 0.5 * (low + high);
        solver->prepare({.mass_weight = -middle, .tensors = {}, .held = {}});
        (solver->solve({{}, 1.0}).converged ? low : high) = middle;
    }
    return low;
}

TEST(DirectSolver, FallsAtTheCriticalWeight)
{
    constexpr double kRoot = 3.831705970207512;
    const double coarse = criticalWeight(discMesh(2000), 10.0, 20.0) - kRoot * kRoot;
    const double fine = criticalWeight(discMesh(8000), 10.0, 20.0) - kRoot * kRoot;
    EXPECT_LT(std::abs(coarse), 0.1);
    EXPECT_GT(coarse / fine, 3.3);
    // And not again beyond, where A has two negative directions or more.
    const PlanarMesh mesh = discMesh(2000);
    const auto solver = directSolver(mesh, Solver::Llt);
    for (const double weight : {16.0, 25.0, 50.0, 400.0, 1e5}) {
        solver->prepare({.mass_weight = -weight, .tensors = {}, .held = {}});
        EXPECT_FALSE(solver->solve({{}, 1.0}).converged) << weight;
    }
}

}  // namespace
}  // namespace droplet
