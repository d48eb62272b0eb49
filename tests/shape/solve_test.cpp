// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact values: Saint-Venant torsion (W. D. Pilkey, "Formulas for stress, strain, and structural matrices", 2nd ed.,
// 2005; series for the rectangle), modified Bessel functions for the disc under gravity.
#include "droplet/shape/solve.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/shape/figures.h"
#include "shape/recovered_normals.h"
#include "support/domains.h"
#include "support/heights.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::heightsOf;
using testing::polygonLoop;
using testing::reversed;

constexpr double kPi = std::numbers::pi;

/// Options with σ = ρ = 1, so that gravity is ρg/σ; with R = 1, k = √gravity.
SolveOptions unitOptions(double gravity, Fill fill, Solver solver = Solver::Auto)
{
    SolveOptions options;
    options.liquid = {"unit", 1.0, 1.0};
    options.gravity = gravity;
    options.fill = fill;
    options.solver = solver;
    return options;
}

/// Tests that every solver must pass.
class SolveWith : public ::testing::TestWithParam<Solver> {};

INSTANTIATE_TEST_SUITE_P(Solvers, SolveWith, ::testing::Values(Solver::Auto, Solver::Llt, Solver::Multigrid),
                         [](const ::testing::TestParamInfo<Solver>& solver) {
                             switch (solver.param) {
                                 case Solver::Auto:
                                     return "Auto";
                                 case Solver::Llt:
                                     return "Llt";
                                 case Solver::Multigrid:
                                     break;
                             }
                             return "Multigrid";
                         });

Fill volume(double v)
{
    return {FillBy::Volume, v, FillSharing::Each};
}

/// Order of convergence from two errors, the second on a mesh with half the edge length.
double order(double coarse, double fine)
{
    return std::log2(coarse / fine);
}

/// ∫φ with −Δφ = 1: V/λ at σ = 1 without gravity; J = 4∫φ.
double torsion(const Loop& loop, double edge, Solver solver)
{
    const std::vector<PlanarMesh> meshes = triangulate(domainOf(loop), {.edge = edge});
    return 4.0 / solve(meshes, unitOptions(0.0, volume(1.0), solver)).droplets[0].pressure;
}

/// Disc of radius 1 with volume 1 under gravity.
struct ExactDisc {
    double k = 0.0;

    [[nodiscard]] double pressure() const { return k > 0 ? k * k * scale() : 8.0 / kPi; }
    [[nodiscard]] double height(double r) const
    {
        return k > 0 ? scale() * (1.0 - bessel(0, k * r) / bessel(0, k)) : 2.0 / kPi * (1.0 - r * r);
    }
    [[nodiscard]] double slope() const { return k > 0 ? scale() * k * bessel(1, k) / bessel(0, k) : 4.0 / kPi; }

private:
    static double bessel(int n, double x) { return std::cyl_bessel_i(n, x); }
    [[nodiscard]] double scale() const { return 1.0 / (2 * kPi * (0.5 - bessel(1, k) / (k * bessel(0, k)))); }
};

struct DiscErrors {
    double l2 = 0.0;
    double pressure = 0.0;
    double apex = 0.0;
    double angle = 0.0;
};

DiscErrors discErrors(double k, double edge, Solver solver)
{
    const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 1)), {.edge = edge});
    const SolveOptions options = unitOptions(k * k, volume(1.0), solver);
    const Solution solution = solve(meshes, options);
    const PlanarMesh& mesh = meshes[0];
    const std::vector<double> h = heightsOf(solution.droplets[0]);
    const ExactDisc exact{k};
    DiscErrors errors;
    double squares = 0.0;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            // Quadrature at the middles of edges, exact for quadratics.
            const std::size_t j = (i + 1) % 3;
            const Vec2 p = 0.5 * (mesh.vertices[t[i]] + mesh.vertices[t[j]]);
            squares += doubleArea(mesh, t) / 6.0 * std::pow(0.5 * (h[t[i]] + h[t[j]]) - exact.height(length(p)), 2.0);
        }
    }
    errors.l2 = std::sqrt(squares);
    errors.pressure = std::abs(solution.droplets[0].pressure - exact.pressure());
    const ShapeFigures figures = measure(solution.droplets[0], options);
    errors.apex = std::abs(figures.height_max - exact.height(0.0));
    errors.angle = std::abs(figures.contact_angle.mean - std::atan(exact.slope()));
    return errors;
}

TEST_P(SolveWith, DiscConvergesWithOrderTwo)
{
    for (const double k : {0.0, 1.0, 3.0, 5.0}) {
        std::vector<DiscErrors> errors;
        for (const double edge : {0.1, 0.05, 0.025, 0.0125}) {
            errors.push_back(discErrors(k, edge, GetParam()));
        }
        for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
            // Measured: 2.00 to 2.29 and 2.01 to 2.15.
            EXPECT_GE(order(errors[i].l2, errors[i + 1].l2), 1.9) << k << " " << i;
            EXPECT_GE(order(errors[i].pressure, errors[i + 1].pressure), 1.9) << k << " " << i;
            EXPECT_GE(order(errors[i].angle, errors[i + 1].angle), 1.9) << k << " " << i;
        }
        EXPECT_LT(errors.back().pressure / ExactDisc{k}.pressure(), 1e-4) << k;
    }
}

// Published values: apex·R²/V and λR⁴/(σV).
TEST_P(SolveWith, DiscUnderGravityAgreesWithTheTable)
{
    struct Row {
        double k;
        double apex;
        double pressure;
    };
    for (const Row row : {Row{1, .623888, 2.968753}, Row{2, .591198, 4.212881}, Row{3, .550190, 6.227669},
                          Row{5, .477128, 12.382770}, Row{10, .392700, 39.283935}}) {
        const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 1)), {.edge = 0.0125});
        const SolveOptions options = unitOptions(row.k * row.k, volume(1.0), GetParam());
        const Solution solution = solve(meshes, options);
        const double apex = measure(solution.droplets[0], options).height_max;
        // Second order: half of h²(1 + k²/4), twice the measured error at every k.
        const double tolerance = 0.5 * 0.0125 * 0.0125 * (1.0 + 0.25 * row.k * row.k);
        EXPECT_NEAR(apex / row.apex, 1.0, tolerance) << row.k;
        EXPECT_NEAR(solution.droplets[0].pressure / row.pressure, 1.0, tolerance) << row.k;
    }
}

struct Section {
    const char* name;
    Loop loop;
    double torsion;
};

TEST_P(SolveWith, TorsionConstantsConvergeWithOrderTwo)
{
    std::vector<Vec2> half;
    for (int i = 0; i <= 4096; ++i) {
        half.push_back({std::cos(kPi * i / 4096), std::sin(kPi * i / 4096)});
    }
    Loop half_disc = testing::smoothLoop(half);
    half_disc.corner.front() = 1;
    half_disc.corner.back() = 1;
    const double side = 1.0 / std::sqrt(3.0);
    for (const Section& s :
         {Section{"ellipse", ellipseLoop(1, 0.5), kPi * 0.125 / 1.25},
          Section{"triangle", polygonLoop({{-side, 0}, {side, 0}, {0, 1}}), 1.0 / (15.0 * std::sqrt(3.0))},
          Section{"square", polygonLoop({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), 4 * .0351442537},
          Section{"rectangle 2", polygonLoop({{0, 0}, {2, 0}, {2, 1}, {0, 1}}), 2 * .2286817},
          Section{"rectangle 5", polygonLoop({{0, 0}, {5, 0}, {5, 1}, {0, 1}}), 5 * .2913168},
          Section{"half disc", half_disc, kPi / 2 - 4 / kPi}}) {
        std::vector<double> errors;
        for (const double edge : {0.1, 0.05, 0.025, 0.0125}) {
            errors.push_back(std::abs(torsion(s.loop, edge, GetParam()) / s.torsion - 1.0));
        }
        // Over three halvings: the error of one mesh also depends on the position of the lattice at the corners.
        EXPECT_GE(order(errors.front(), errors.back()) / 3.0, 1.9) << s.name;
        EXPECT_LT(errors.back(), 1e-3) << s.name;
    }
}

// At a re-entrant corner of 270° the solution is like r^(2/3); on uniform meshes ∫φ converges with order 4/3.
TEST_P(SolveWith, LShapeConvergesWithItsOwnOrder)
{
    const Loop loop = polygonLoop({{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}});
    const double exact = 4 * .214075802220546;
    std::vector<double> errors;
    for (const double edge : {0.1, 0.05, 0.025, 0.0125}) {
        errors.push_back(std::abs(torsion(loop, edge, GetParam()) / exact - 1.0));
    }
    for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
        const double measured = order(errors[i], errors[i + 1]);
        EXPECT_GE(measured, 4.0 / 3.0 - 0.05) << i;
        EXPECT_LE(measured, 1.85) << i;
    }
    EXPECT_LT(errors.back(), 1e-3);
}

TEST_P(SolveWith, SquareHasThePublishedHeight)
{
    const std::vector<PlanarMesh> meshes =
        triangulate(domainOf(polygonLoop({{0, 0}, {1, 0}, {1, 1}, {0, 1}})), {.edge = 0.0125});
    const Solution solution = solve(meshes, unitOptions(0.0, volume(.0351442537), GetParam()));
    const std::vector<double> h = heightsOf(solution.droplets[0]);
    // Second order: h²/4; measured: h²/8.
    EXPECT_NEAR(*std::max_element(h.begin(), h.end()), .0736713533, 0.25 * 0.0125 * 0.0125);
}

TEST_P(SolveWith, VolumeIsMetOnTheMesh)
{
    const Domain ring = domainOf(ellipseLoop(1e-2, 1e-2), {reversed(ellipseLoop(4e-3, 3e-3))});
    for (const std::size_t triangles : {100U, 3000U, 40000U}) {
        const std::vector<PlanarMesh> meshes = triangulate(ring, {.triangles = triangles, .edge = {}});
        SolveOptions options;
        options.solver = GetParam();
        options.fill = volume(30 * kMicrolitre);
        const Solution solution = solve(meshes, options);
        EXPECT_TRUE(solution.report.usable());
        EXPECT_NEAR(measure(solution.droplets[0], options).volume / (30 * kMicrolitre), 1.0, 1e-10);
    }
}

TEST_P(SolveWith, HeightAndMeanAngleAreMet)
{
    const std::vector<PlanarMesh> meshes =
        triangulate(domainOf(polygonLoop({{0, 0}, {4e-3, 0}, {4e-3, 1e-3}, {1e-3, 1e-3}, {1e-3, 5e-3}, {0, 5e-3}})),
                    {.triangles = 4000, .edge = {}});
    SolveOptions options;
    options.solver = GetParam();
    options.fill = {FillBy::Height, 3e-4, FillSharing::Each};
    EXPECT_NEAR(measure(solve(meshes, options).droplets[0], options).height_max, 3e-4, 1e-15);
    for (const double degrees : {0.1, 20.0, 40.0, 75.0}) {
        options.fill = {FillBy::ContactAngle, degrees * kDegree, FillSharing::Each};
        // Means over vertices and over edges differ by round-off only.
        EXPECT_NEAR(measure(solve(meshes, options).droplets[0], options).contact_angle.mean, degrees * kDegree, 1e-12);
    }
}

TEST_P(SolveWith, OnlyAReservoirHasOnePressure)
{
    Domain domain = domainOf(ellipseLoop(1e-3, 1e-3));
    Loop large = ellipseLoop(3e-3, 2e-3);
    for (Vec2& p : large.points) {
        p.x += 6e-3;
    }
    domain.droplets.push_back({large, {}});
    const std::vector<PlanarMesh> meshes = triangulate(domain, {.triangles = 5000, .edge = {}});
    SolveOptions options;
    options.solver = GetParam();
    options.fill = {FillBy::Volume, 10 * kMicrolitre, FillSharing::Total};
    const Solution total = solve(meshes, options);
    EXPECT_EQ(total.droplets[0].pressure, total.droplets[1].pressure);
    const double v0 = measure(total.droplets[0], options).volume;
    const double v1 = measure(total.droplets[1], options).volume;
    EXPECT_NEAR((v0 + v1) / (10 * kMicrolitre), 1.0, 1e-10);
    EXPECT_LT(v0, v1);

    options.fill.sharing = FillSharing::Each;
    const Solution each = solve(meshes, options);
    EXPECT_GT(each.droplets[0].pressure, each.droplets[1].pressure);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(measure(each.droplets[k], options).volume / (10 * kMicrolitre), 1.0, 1e-10);
    }

    options.fill = {FillBy::Height, 5e-4, FillSharing::Total};
    const Solution height = solve(meshes, options);
    EXPECT_LT(measure(height.droplets[0], options).height_max, 4e-4);
    EXPECT_NEAR(measure(height.droplets[1], options).height_max, 5e-4, 1e-15);
}

// The pressure exactly balances the pull of the rim and the weight: λA = σ∮slope + ρgV.
TEST_P(SolveWith, ForcesBalance)
{
    const std::vector<PlanarMesh> meshes = triangulate(
        domainOf(ellipseLoop(4e-3, 3e-3), {reversed(ellipseLoop(1e-3, 1e-3))}), {.triangles = 3000, .edge = {}});
    SolveOptions options;
    options.solver = GetParam();
    options.fill = volume(20 * kMicrolitre);
    const Solution solution = solve(meshes, options);
    const CapillarySurface& field = solution.droplets[0];
    const ShapeFigures figures = measure(field, options);
    const std::vector<double> slopes = rimSlopes(field, {});
    double pull = 0.0;
    for (std::size_t loop = 0; loop < meshes[0].loopCount(); ++loop) {
        for (std::uint32_t v = meshes[0].loop_starts[loop]; v < meshes[0].loop_starts[loop + 1]; ++v) {
            const std::uint32_t next = nextOnRim(meshes[0], loop, v);
            const double edge = length(meshes[0].vertices[next] - meshes[0].vertices[v]);
            pull += 0.5 * edge * (slopes[v] + slopes[next]);
        }
    }
    const double push = field.pressure * area(meshes[0]);
    EXPECT_NEAR(
        (options.liquid.surface_tension * pull + options.liquid.density * options.gravity * figures.volume) / push, 1.0,
        1e-9);
}

// The solution minimises the discrete energy: any other field with the same volume has a larger one.
TEST_P(SolveWith, IsTheMinimumOfItsEnergy)
{
    const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 0.7)), {.triangles = 400, .edge = {}});
    const PlanarMesh& mesh = meshes[0];
    const Solution solution = solve(meshes, unitOptions(4.0, volume(0.3), GetParam()));
    std::vector<double> loads(mesh.vertices.size(), 0.0);
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            loads[v] += doubleArea(mesh, t) / 6.0;
        }
    }
    const auto energy = [&](const std::vector<double>& u) {
        double sum = 0.0;
        for (const Triangle& t : mesh.triangles) {
            const double area = 0.5 * doubleArea(mesh, t);
            const Vec2 e1 = mesh.vertices[t[1]] - mesh.vertices[t[0]];
            const Vec2 e2 = mesh.vertices[t[2]] - mesh.vertices[t[0]];
            const double d1 = u[t[1]] - u[t[0]];
            const double d2 = u[t[2]] - u[t[0]];
            const Vec2 g{(d1 * e2.y - d2 * e1.y) / (2 * area), (d2 * e1.x - d1 * e2.x) / (2 * area)};
            const double a = u[t[0]];
            const double b = u[t[1]];
            const double c = u[t[2]];
            sum += area * (0.5 * dot(g, g) + 0.5 * 4.0 * (a * a + b * b + c * c + a * b + b * c + c * a) / 6.0);
        }
        return sum;
    };
    const std::vector<double> u = heightsOf(solution.droplets[0]);
    const double min = energy(u);
    const auto first = mesh.rimVertexCount();
    for (std::uint32_t v = first; v + 1 < mesh.vertices.size(); v += 7) {
        // Move liquid from one vertex to the next at the same volume.
        std::vector<double> other = u;
        other[v] += 1e-3 / loads[v];
        other[v + 1] -= 1e-3 / loads[v + 1];
        EXPECT_GT(energy(other), min);
        std::vector<double> back = u;
        back[v] -= 1e-3 / loads[v];
        back[v + 1] += 1e-3 / loads[v + 1];
        EXPECT_GT(energy(back), min);
    }
}

TEST(Solve, SameBitsAtAnyNumberOfThreads)
{
    Domain domain = domainOf(ellipseLoop(1e-3, 1e-3));
    for (int k = 1; k < 6; ++k) {
        Loop loop = ellipseLoop(1e-3 + 1e-4 * k, 8e-4);
        for (Vec2& p : loop.points) {
            p.x += 3e-3 * k;
        }
        domain.droplets.push_back({loop, {}});
    }
    const std::vector<PlanarMesh> small = triangulate(domain, {.triangles = 6000, .edge = {}});
    // Large enough for several threads in every loop over unknowns.
    const std::vector<PlanarMesh> large =
        triangulate(domainOf(ellipseLoop(1e-2, 1e-2)), {.triangles = 100'000, .edge = {}});
    for (const std::vector<PlanarMesh>* meshes : {&small, &large}) {
        for (const Solver solver : {Solver::Auto, Solver::Llt, Solver::Multigrid}) {
            SolveOptions options;
            options.solver = solver;
            std::vector<Solution> runs;
            for (const int threads : {1, 2, 2, 7}) {
                const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                                static_cast<std::size_t>(threads));
                // The default arena has no more slots than cores.
                tbb::task_arena arena(threads);
                arena.execute([&] { runs.push_back(solve(*meshes, options)); });
            }
            for (const Solution& run : runs) {
                EXPECT_EQ(run.report.iterations, runs[0].report.iterations);
                EXPECT_EQ(run.report.residual, runs[0].report.residual);
                for (std::size_t k = 0; k < meshes->size(); ++k) {
                    EXPECT_EQ(heightsOf(run.droplets[k]), heightsOf(runs[0].droplets[k]));
                    EXPECT_EQ(run.droplets[k].contact_angle, runs[0].droplets[k].contact_angle);
                    EXPECT_EQ(run.droplets[k].pressure, runs[0].droplets[k].pressure);
                }
            }
        }
    }
}

struct Method {
    Solver solver;
    const char* name;
    double residual;  ///< upper limit for the method
};

TEST(Solve, ReportsItsMethodAndFigures)
{
    const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = 2000, .edge = {}});
    for (const Method& method :
         {Method{Solver::Llt, "simplicial-llt", 1e-12}, Method{Solver::Multigrid, "multigrid-pcg", 1e-9}}) {
        const Solution solution = solve(meshes, unitOptions(1.0, volume(1.0), method.solver));
        EXPECT_EQ(solution.report.method, method.name);
        EXPECT_EQ(solution.report.unknowns, meshes[0].vertices.size() - meshes[0].rimVertexCount());
        EXPECT_TRUE(solution.report.usable());
        EXPECT_LT(solution.report.residual, method.residual) << method.name;
        EXPECT_GT(solution.report.residual, 0.0) << method.name;
        if (method.solver == Solver::Multigrid) {
            EXPECT_GT(solution.report.iterations, 1U);
        } else {
            EXPECT_EQ(solution.report.iterations, 1U);
        }
    }
    std::vector<Stage> stages;
    (void)solve(meshes, {}, [&](Stage stage, double /*share*/) { stages.push_back(stage); });
    EXPECT_EQ(stages, (std::vector<Stage>{Stage::Assemble, Stage::Solve}));
}

// Auto factors small or irregular meshes, iterates on lattices, and reports the method of the largest droplet.
TEST(Solve, AutoChoosesBySizeAndLattice)
{
    const auto method_for = [](const std::vector<PlanarMesh>& meshes, Model model = Model::Exact) {
        SolveOptions options = unitOptions(1.0, volume(0.1));
        options.model = model;
        return solve(meshes, options).report.method;
    };
    const std::vector<PlanarMesh> coarse = triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = 300, .edge = {}});
    std::vector<PlanarMesh> fine = triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = 4000, .edge = {}});
    EXPECT_EQ(method_for(coarse), "simplicial-llt");
    EXPECT_EQ(method_for(fine), "multigrid-pcg");
    EXPECT_EQ(method_for({coarse[0], fine[0], coarse[0]}), "multigrid-pcg");
    // The linear model has one system alone; the usual size is a factorisation's.
    EXPECT_EQ(method_for(fine, Model::Linear), "simplicial-llt");
    EXPECT_EQ(method_for(triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = 40'000, .edge = {}}), Model::Linear),
              "simplicial-llt");
    EXPECT_EQ(method_for(triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = 60'000, .edge = {}}), Model::Linear),
              "multigrid-pcg");
    fine[0].lattice = {};
    EXPECT_EQ(method_for(fine), "simplicial-llt");
}

TEST(Solve, RefusesOptionsOutOfRange)
{
    const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = 100, .edge = {}});
    const auto refuses = [&](const SolveOptions& options) {
        try {
            (void)solve(meshes, options);
        } catch (const Error& error) {
            return error.code() == ErrorCode::InvalidArgument;
        }
        return false;
    };
    EXPECT_TRUE(refuses(unitOptions(std::nan(""), volume(1.0))));
    EXPECT_TRUE(refuses(unitOptions(1.0, volume(0.0))));
    EXPECT_TRUE(refuses(unitOptions(1.0, volume(-1.0))));
    EXPECT_TRUE(refuses(unitOptions(1.0, volume(std::nan("")))));
    EXPECT_TRUE(refuses(unitOptions(1.0, {FillBy::Height, 0.0, FillSharing::Each})));
    EXPECT_TRUE(refuses(unitOptions(1.0, {FillBy::ContactAngle, 90 * kDegree, FillSharing::Each})));
    SolveOptions options = unitOptions(1.0, volume(1.0));
    options.liquid.surface_tension = 0.0;
    EXPECT_TRUE(refuses(options));
    EXPECT_THROW((void)solve({}, unitOptions(1.0, volume(1.0))), Error);
}

TEST_P(SolveWith, RefusesAMeshWithoutInnerVertices)
{
    const std::vector<PlanarMesh> disc = triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = 100, .edge = {}});
    PlanarMesh flat;
    flat.vertices = {{0, 0}, {1, 0}, {0, 1}};
    flat.triangles = {{0, 1, 2}};
    flat.loop_starts = {0, 3};
    try {
        (void)solve({disc[0], flat}, unitOptions(1.0, volume(1.0), GetParam()));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
        EXPECT_NE(std::string(error.what()).find("meshes[1]"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace droplet
