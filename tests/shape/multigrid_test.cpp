// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "droplet/shape/solve.h"
#include "shape/constrained.h"
#include "shape/hierarchy.h"
#include "support/domains.h"
#include "support/heights.h"
#include "support/operators.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::heightsOf;
using testing::weighing;

constexpr Solver kSolvers[] = {Solver::Llt, Solver::Multigrid, Solver::Auto};

PlanarMesh discMesh(std::size_t triangles)
{
    return triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = triangles, .edge = {}})[0];
}

std::vector<PlanarMesh> withoutLattice(std::vector<PlanarMesh> meshes)
{
    for (PlanarMesh& mesh : meshes) {
        mesh.lattice = {};
    }
    return meshes;
}

/// Stretches a mesh without its lattice, so that triangles have angles that triangulate() never makes.
PlanarMesh stretched(PlanarMesh mesh, double by)
{
    mesh.lattice = {};
    for (Vec2& v : mesh.vertices) {
        v.x *= by;
    }
    return mesh;
}

/// Solution with unit volume.
ConstrainedSolution solvedAlone(const PlanarMesh& mesh, const Operator& op,
                                const std::function<std::unique_ptr<ConstrainedSolver>(const PlanarMesh&)>& make)
{
    const std::unique_ptr<ConstrainedSolver> solver = make(mesh);
    solver->prepare(op);
    return solver->solve({{}, 1.0});
}

ConstrainedSolution solvedByMultigrid(const PlanarMesh& mesh, const Operator& op)
{
    return solvedAlone(mesh, op, multigridSolver);
}

/// ‖Ax − λm‖/‖λm‖ with the matrix assembled triangle by triangle.
double trueResidual(const PlanarMesh& mesh, const Operator& op, const ConstrainedSolution& solution)
{
    const testing::Assembled system = testing::assembled(mesh, op);
    const Eigen::Map<const Eigen::VectorXd> x(solution.values.data(),
                                              static_cast<Eigen::Index>(solution.values.size()));
    const Eigen::VectorXd load = solution.multiplier * system.load;
    return (load - system.matrix * x).norm() / load.norm();
}

/// Droplets of a footprint, each 1 mm high.
Solution solved(const std::vector<PlanarMesh>& meshes, double gravity, Solver solver)
{
    SolveOptions options;
    options.gravity = gravity;
    options.fill = {FillBy::Height, 1e-3, FillSharing::Each};
    options.solver = solver;
    return solve(meshes, options);
}

// On any mesh every solver converges, agrees with the others, and gives no negative height.
TEST(Solvers, AgreeOnTheZoo)
{
    for (const auto& [name, domain] : testing::zoo()) {
        const std::vector<PlanarMesh> uniform = triangulate(domain, {.triangles = 5000, .edge = {}});
        const std::vector<std::pair<std::string, std::vector<PlanarMesh>>> variants{
            {name, uniform},
            {name + " without its lattice", withoutLattice(uniform)},
            {name + " graded", triangulate(domain, {.triangles = 3000, .edge = {}, .grading = 8})}};
        for (const auto& [variant, meshes] : variants) {
            for (const double gravity : {0.0, 9.81, 1e3}) {
                const Solution reference = solved(meshes, gravity, Solver::Llt);
                for (const Solver solver : kSolvers) {
                    SCOPED_TRACE(variant + ", gravity " + std::to_string(gravity) + ", solver " +
                                 std::to_string(static_cast<int>(solver)));
                    const Solution solution = solved(meshes, gravity, solver);
                    ASSERT_TRUE(solution.report.usable());
                    EXPECT_LT(solution.report.residual, 1e-9);
                    double difference = 0.0;
                    std::size_t not_liquid = 0;
                    for (std::size_t k = 0; k < meshes.size(); ++k) {
                        const CapillarySurface& field = solution.droplets[k];
                        const CapillarySurface& wanted = reference.droplets[k];
                        EXPECT_NEAR(field.pressure / wanted.pressure, 1.0, 1e-8);
                        for (std::uint32_t v = 0; v < meshes[k].vertices.size(); ++v) {
                            const double h = field.vertices[v].z;
                            difference = std::max(difference, std::abs(h - wanted.vertices[v].z));
                            not_liquid += meshes[k].onRim(v) ? (h != 0.0) : !(h > 0.0);
                        }
                    }
                    EXPECT_LT(difference, 1e-8 * 1e-3);
                    EXPECT_EQ(not_liquid, 0U) << "heights that are not 0 on the rim and positive inside";
                }
            }
        }
    }
}

TEST(Multigrid, ResidualIsTheTrueOne)
{
    const PlanarMesh disc = discMesh(20000);
    const PlanarMesh graded =
        triangulate(domainOf(ellipseLoop(1, 0.6)), {.triangles = 10000, .edge = {}, .grading = 16})[0];
    const PlanarMesh bare = stretched(discMesh(10000), 1.0);
    for (const PlanarMesh* mesh : {&disc, &graded, &bare}) {
        for (const double mass : {0.0, 25.0, 1e4}) {
            const ConstrainedSolution solution = solvedByMultigrid(*mesh, weighing(mass));
            EXPECT_TRUE(solution.converged);
            const double residual = trueResidual(*mesh, weighing(mass), solution);
            EXPECT_LT(residual, 1e-9);
            // The last digits depend on the order of sums.
            EXPECT_NEAR(residual, solution.residual, 1e-12);
            const ConstrainedSolution reference = solvedAlone(*mesh, weighing(mass), directSolver);
            EXPECT_NEAR(solution.multiplier / reference.multiplier, 1.0, 1e-9);
        }
    }
}

// Measured: 7 to 9 without gravity, fewer with gravity.
TEST(Multigrid, IterationsHardlyGrowWithTheMesh)
{
    std::vector<std::size_t> sizes{2000, 8000, 32000, 128000};
#ifndef __SANITIZE_ADDRESS__
    sizes.push_back(500'000);
#endif
    for (const double mass : {0.0, 25.0}) {
        std::vector<std::size_t> iterations;
        for (const std::size_t triangles : sizes) {
            const ConstrainedSolution solution = solvedByMultigrid(discMesh(triangles), weighing(mass));
            EXPECT_TRUE(solution.converged) << triangles;
            iterations.push_back(solution.iterations);
        }
        EXPECT_LE(*std::max_element(iterations.begin(), iterations.end()), 14U) << mass;
        EXPECT_LE(iterations.back(), iterations.front() + 4) << mass;
    }
}

TEST(Multigrid, OneLevelIsAFactorisation)
{
    const PlanarMesh mesh = discMesh(400);
    ASSERT_EQ(buildHierarchy(mesh, {}).levels.size(), 1U);
    const ConstrainedSolution solution = solvedByMultigrid(mesh, {});
    EXPECT_TRUE(solution.converged);
    // The factorisation is exact to single precision; a second iteration corrects this.
    EXPECT_LE(solution.iterations, 3U);
}

TEST(Multigrid, SameBitsAtAnyNumberOfThreads)
{
    for (const PlanarMesh& mesh : {discMesh(150'000), stretched(discMesh(60000), 1.0)}) {
        std::vector<ConstrainedSolution> runs;
        for (const int threads : {1, 2, 2, 7}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
            tbb::task_arena arena(threads);
            arena.execute([&] { runs.push_back(solvedByMultigrid(mesh, weighing(25.0))); });
        }
        for (const ConstrainedSolution& run : runs) {
            EXPECT_EQ(run.values, runs[0].values);
            EXPECT_EQ(run.multiplier, runs[0].multiplier);
            EXPECT_EQ(run.residual, runs[0].residual);
            EXPECT_EQ(run.iterations, runs[0].iterations);
        }
    }
}

// On triangles a thousand times as long as high the iteration reaches its limit and reports this. Solver::Auto then
// uses a factorisation.
TEST(Multigrid, AutoFactorsIfItDoesNotConverge)
{
    const std::vector<PlanarMesh> meshes{stretched(discMesh(110'000), 1000.0)};
    ASSERT_NO_THROW(meshes[0].validate());
    // Auto tries multigrid first on meshes of this size.
    ASSERT_GT(meshes[0].vertices.size() - meshes[0].rimVertexCount(), 50'000U);

    const Solution forced = solved(meshes, 0.0, Solver::Multigrid);
    EXPECT_EQ(forced.report.method, "multigrid-pcg");
    EXPECT_FALSE(forced.report.usable());
    EXPECT_GT(forced.report.residual, 1e-9);
    EXPECT_TRUE(forced.droplets.empty());

    const Solution automatic = solved(meshes, 0.0, Solver::Auto);
    EXPECT_EQ(automatic.report.method, "simplicial-llt");
    ASSERT_TRUE(automatic.report.usable());
    EXPECT_LT(automatic.report.residual, 1e-9);
    EXPECT_EQ(heightsOf(automatic.droplets[0]), heightsOf(solved(meshes, 0.0, Solver::Llt).droplets[0]));
}

// Only the droplet that does not converge is factored; all droplets are solved.
TEST(Multigrid, AutoFactorsOnlyDropletsThatDoNotConverge)
{
    const std::vector<PlanarMesh> meshes{discMesh(60'000), stretched(discMesh(110'000), 1000.0)};
    const Solution both = solved(meshes, 0.0, Solver::Auto);
    ASSERT_TRUE(both.report.usable());
    EXPECT_EQ(both.report.method, "simplicial-llt");
    EXPECT_GT(both.report.iterations, 1U);
    EXPECT_EQ(heightsOf(both.droplets[0]), heightsOf(solved({meshes[0]}, 0.0, Solver::Multigrid).droplets[0]));
}

}  // namespace
}  // namespace droplet
