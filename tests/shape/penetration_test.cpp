// SPDX-License-Identifier: GPL-3.0-or-later
//
// u ≥ h: radially symmetric obstacle problems in closed form; on all others the conditions of Karush, Kuhn and Tucker;
// and the thesis, figure 4.14: a large disc on a tilted plane.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/solve.h"
#include "droplet/units.h"
#include "support/domains.h"
#include "support/equilibrium.h"
#include "support/heights.h"
#include "support/young_laplace.h"

namespace droplet {
namespace {

using testing::discMeshes;
using testing::domainOf;
using testing::ellipseLoop;
using testing::Equilibrium;
using testing::equilibrium;
using testing::heightsOf;
using testing::l2Error;
using testing::meanOrder;
using testing::polygonLoop;
using testing::RingSurface;
using testing::unitOptions;

constexpr double kPi = std::numbers::pi;

/// Hill that is flat at the rim of the disc of radius 1: h = b(1 − r²)².
BaseSurface hill(double b)
{
    return BaseSurface([=](Vec2 p) {
        const double q = 1.0 - dot(p, p);
        return GroundPoint{b * q * q, (-4.0 * b * q) * p};
    });
}

/// Film without gravity around a hill that rises through it in r < a.
struct Film {
    double pressure = 0.0;
    double volume = 0.0;
    double rim_angle = 0.0;
    double area = 0.0;
    std::function<double(double)> height;
};

/// Linear model. v = u − h has −Δv = λ − 8b(1 − 2r²) outside, v = v' = 0 at a, v = 0 at 1.
Film linearFilm(double b, double a)
{
    const double p = (1.0 - a * a) / 4.0 + a * a * std::log(a) / 2.0;
    const double q = (1.0 - std::pow(a, 4)) / 4.0 + std::pow(a, 4) * std::log(a);
    Film film;
    film.pressure = 8.0 * b - 4.0 * b * q / p;
    const double excess = film.pressure - 8.0 * b;
    const auto thickness = [=](double r) {
        return r <= a ? 0.0
                      : -excess * ((r * r - a * a) / 4.0 - a * a * std::log(r / a) / 2.0) -
                            4.0 * b * ((std::pow(r, 4) - std::pow(a, 4)) / 4.0 - std::pow(a, 4) * std::log(r / a));
    };
    film.volume = 2.0 * kPi * testing::simpson(a, 1.0, [&](double r) { return r * thickness(r); });
    film.rim_angle = std::atan(0.5 * excess * (1.0 - a * a) + 4.0 * b * (1.0 - std::pow(a, 4)));
    film.height = [=](double r) { return b * std::pow(1.0 - r * r, 2) + thickness(r); };
    return film;
}

/// Exact model: constant mean curvature outside, tangent to the hill at a.
Film exactFilm(double b, double a)
{
    const double fall = 4.0 * b * a * (1.0 - a * a);
    const double sine = fall / std::hypot(1.0, fall);
    RingSurface ring{a, 0.0, 0.0};
    double low = -0.5;
    double high = 1.5;
    for (int k = 0; k < 60; ++k) {
        ring.pressure = 0.5 * (low + high);
        ring.constant = a * (sine - 0.5 * ring.pressure * a);
        (ring.drop(a, 1.0) < b * std::pow(1.0 - a * a, 2) ? low : high) = ring.pressure;
    }
    Film film;
    film.pressure = ring.pressure;
    film.volume = ring.volume() - kPi * b * std::pow(1.0 - a * a, 3) / 3.0;
    film.rim_angle = std::asin(ring.sine(1.0));
    film.area = ring.area();
    film.height = [=](double r) { return r <= a ? b * std::pow(1.0 - r * r, 2) : ring.drop(r, 1.0, 40); };
    return film;
}

void expectKkt(const PlanarMesh& mesh, const CapillarySurface& field, const SolveOptions& options)
{
    const Equilibrium found = equilibrium(mesh, field, options);
    EXPECT_LT(found.free_force, 1e-8);
    EXPECT_GE(found.held_force, -1e-8);
    EXPECT_EQ(found.held_gap, 0.0);
    EXPECT_EQ(found.rim_gap, 0.0);
    EXPECT_GE(found.min_thickness, 0.0);
    if (options.fill.by == FillBy::Volume && options.fill.sharing == FillSharing::Each) {
        EXPECT_NEAR(found.volume / options.fill.amount, 1.0, 1e-10);
    }
}

void expectFilmsConverge(Model model, const Film& film, double b, double a)
{
    std::vector<double> l2;
    std::vector<double> pressure;
    std::vector<double> dry;
    std::vector<double> angle;
    std::vector<double> area_error;
    double edge = 0.1;
    for (int k = 0; k < 4; ++k, edge *= 0.5) {
        const std::vector<PlanarMesh> meshes = discMeshes(edge);
        SolveOptions options = unitOptions(model, 0.0, film.volume);
        options.ground = hill(b);
        options.no_penetration = true;
        const Solution solution = solve(meshes, options);
        ASSERT_TRUE(solution.report.usable());
        const CapillarySurface& field = solution.droplets[0];
        expectKkt(meshes[0], field, options);
        const ShapeFigures figures = measure(field, options);
        l2.push_back(l2Error(meshes[0], field, [&](Vec2 p) { return film.height(std::min(length(p), 1.0)); }));
        pressure.push_back(std::abs(field.pressure - film.pressure));
        dry.push_back(std::abs(figures.dry_area - kPi * a * a));
        angle.push_back(std::abs(figures.contact_angle.mean - film.rim_angle));
        if (model == Model::Exact) {
            area_error.push_back(std::abs(figures.liquid_area - film.area));
        }
        // An error of one edge all around would be 2πa · edge.
        EXPECT_LT(dry.back(), 2.0 * kPi * a * edge);
        ASSERT_EQ(field.dry.size(), heightsOf(field).size());
        for (std::uint32_t v = 0; v < field.dry.size(); ++v) {
            const double r = length(meshes[0].vertices[v]);
            EXPECT_TRUE(field.dry[v] == 1 || r > a - edge) << r;
            EXPECT_TRUE(field.dry[v] == 0 || r < a + edge) << r;
        }
    }
    // Measured: 2.05 to 2.22; 1.40 to 1.59 for areas, which are bounded by edges of triangles.
    EXPECT_GE(meanOrder(l2), 1.9);
    EXPECT_GE(meanOrder(pressure), 1.9);
    EXPECT_GE(meanOrder(angle), 1.9);
    EXPECT_GE(meanOrder(dry), 0.9);
    if (model == Model::Exact) {
        EXPECT_GE(meanOrder(area_error), 0.9);
    }
}

TEST(Penetration, LinearFilmAroundAHillConvergesWithOrderTwo)
{
    for (const double a : {0.3, 0.5}) {
        SCOPED_TRACE(a);
        const Film film = linearFilm(0.5, a);
        ASSERT_GT(film.volume, 0.0);
        // The ground pushes up: −Δh − λ ≥ 0 up to a.
        ASSERT_GT(8.0 * 0.5 * (1.0 - 2.0 * a * a), film.pressure);
        expectFilmsConverge(Model::Linear, film, 0.5, a);
    }
}

TEST(Penetration, ExactFilmAroundAHillConvergesWithOrderTwo)
{
    for (const double a : {0.3, 0.5}) {
        SCOPED_TRACE(a);
        const Film film = exactFilm(0.5, a);
        ASSERT_GT(film.volume, 0.0);
        expectFilmsConverge(Model::Exact, film, 0.5, a);
    }
}

// For low hills both models agree.
TEST(Penetration, FilmsOfBothModelsAgreeOnLowHills)
{
    const Film linear = linearFilm(1e-3, 0.4);
    const Film exact = exactFilm(1e-3, 0.4);
    EXPECT_NEAR(exact.pressure / linear.pressure, 1.0, 1e-4);
    EXPECT_NEAR(exact.volume / linear.volume, 1.0, 1e-4);
    EXPECT_NEAR(exact.rim_angle / linear.rim_angle, 1.0, 1e-4);
    EXPECT_NEAR(exact.height(0.7) / linear.height(0.7), 1.0, 1e-4);
}

// Thesis, figure 4.14: without the condition the upper part sinks into the ground; with it, the ground is dry there.
TEST(Penetration, LargeTiltedDiscIsDryAtItsUpperEnd)
{
    constexpr double kRadius = 5e-3;
    constexpr double kVolume = 30 * kMicrolitre;
    const std::vector<PlanarMesh> meshes =
        triangulate(domainOf(ellipseLoop(kRadius, kRadius)), {.triangles = 12'000, .edge = {}});
    SolveOptions options;
    options.tilt = 90 * kDegree;
    options.fill = {FillBy::Volume, kVolume, FillSharing::Each};
    // u = (R² − r²)(p/4 + ρgx/8)/σ is lowest on the line of slope through the middle.
    const double p = 8.0 * options.liquid.surface_tension * kVolume / (kPi * std::pow(kRadius, 4));
    double deepest = 0.0;
    for (int k = 0; k < 10'000; ++k) {
        const double x = -kRadius * k / 10'000;
        const double head = options.liquid.density * options.gravity * x;
        deepest =
            std::min(deepest, (kRadius * kRadius - x * x) * (p / 4.0 + head / 8.0) / options.liquid.surface_tension);
    }
    ASSERT_LT(deepest, 0.0);
    const Solution before = solve(meshes, options);
    ASSERT_TRUE(before.report.usable());
    const ShapeFigures sunk = measure(before.droplets[0], options);
    EXPECT_NEAR(sunk.depth_max / -deepest, 1.0, 0.01);
    EXPECT_EQ(sunk.dry_area, 0.0);

    for (const Model model : {Model::Linear, Model::Exact}) {
        SolveOptions held = options;
        held.model = model;
        held.no_penetration = true;
        const Solution after = solve(meshes, held);
        ASSERT_TRUE(after.report.usable());
        const CapillarySurface& field = after.droplets[0];
        expectKkt(meshes[0], field, held);
        const ShapeFigures figures = measure(field, held);
        EXPECT_EQ(figures.depth_max, 0.0);
        EXPECT_NEAR(figures.volume / kVolume, 1.0, 1e-10);
        EXPECT_GT(figures.dry_area, 0.05 * figures.footprint_area);
        EXPECT_LT(figures.dry_area, 0.5 * figures.footprint_area);
        for (std::uint32_t v = 0; v < field.dry.size(); ++v) {
            EXPECT_TRUE(field.dry[v] == 0 || meshes[0].vertices[v].y > 0.0);
        }
        if (model == Model::Linear) {
            const double free_energy = sunk.linear_area * options.liquid.surface_tension + sunk.gravity_energy;
            // Dry parts have the area of the ground.
            const double held_energy =
                (figures.linear_area + figures.dry_area) * options.liquid.surface_tension + figures.gravity_energy;
            EXPECT_GT(held_energy, free_energy);
        }
    }
}

TEST(Penetration, DryRimHasNoContactAngle)
{
    const std::vector<PlanarMesh> meshes = discMeshes(0.05);
    SolveOptions options = unitOptions(Model::Linear, 6.0, 0.2);
    options.tilt = 90 * kDegree;
    options.no_penetration = true;
    const Solution solution = solve(meshes, options);
    ASSERT_TRUE(solution.report.usable());
    const CapillarySurface& field = solution.droplets[0];
    std::vector<double> wet(meshes[0].rimVertexCount(), 0.0);
    for (const Triangle& t : meshes[0].triangles) {
        const double thickest = std::max({field.vertices[t[0]].z, field.vertices[t[1]].z, field.vertices[t[2]].z});
        for (const std::uint32_t v : t) {
            if (meshes[0].onRim(v)) {
                wet[v] = std::max(wet[v], thickest);
            }
        }
    }
    std::size_t dry = 0;
    for (std::size_t v = 0; v < wet.size(); ++v) {
        EXPECT_GE(field.contact_angle[v], -1e-9);
        if (wet[v] == 0.0) {
            EXPECT_NEAR(field.contact_angle[v], 0.0, 1e-9);
            ++dry;
        }
    }
    EXPECT_GT(dry, 5U);
}

// On a wall the liquid stands upright at the lower end of a disc while most of the rim is flat. The mean angle says
// nothing about it.
TEST(Penetration, LiquidOnAWallIsRefusedWhereItWouldHangOver)
{
    const std::vector<PlanarMesh> meshes =
        triangulate(domainOf(ellipseLoop(10 * kMillimetre, 10 * kMillimetre)), {.triangles = 10000, .edge = {}});
    SolveOptions options;
    options.tilt = 90 * kDegree;
    options.no_penetration = true;
    options.model = Model::Exact;
    const auto at = [&](double volume) {
        options.fill = {FillBy::Volume, volume * kMicrolitre, FillSharing::Each};
        return solve(meshes, options);
    };
    const Solution flat = at(50.0);
    ASSERT_TRUE(flat.report.usable());
    const auto steepest = [](const Solution& solution) {
        const std::vector<double>& angles = solution.droplets[0].contact_angle;
        return *std::max_element(angles.begin(), angles.end());
    };
    EXPECT_LT(steepest(flat), 80 * kDegree);
    EXPECT_GT(steepest(flat), 70 * kDegree);
    for (const double volume : {75.0, 144.0, 165.0}) {
        const Solution refused = at(volume);
        EXPECT_EQ(refused.report.termination, Termination::NoHeightField) << volume;
        EXPECT_GT(refused.report.largest_volume, 60 * kMicrolitre) << volume;
        EXPECT_LT(refused.report.largest_volume, 68 * kMicrolitre) << volume;
    }
}

TEST(Penetration, KktHoldOnAnyFootprintGroundAndTilt)
{
    const BaseSurface flat;
    const BaseSurface waves([](Vec2 p) {
        return GroundPoint{
            0.15 * std::sin(7 * p.x) * std::cos(5 * p.y),
            {1.05 * std::cos(7 * p.x) * std::cos(5 * p.y), -0.75 * std::sin(7 * p.x) * std::sin(5 * p.y)}};
    });
    const BaseSurface ramp([](Vec2 p) { return GroundPoint{0.3 * p.x, {0.3, 0.0}}; });
    const Loop ell = polygonLoop({{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}});
    std::size_t dry_runs = 0;
    for (const Domain& domain : {domainOf(ellipseLoop(1, 1)), domainOf(ell),
                                 domainOf(ellipseLoop(1, 0.8), {testing::reversed(ellipseLoop(0.3, 0.4))})}) {
        const std::vector<PlanarMesh> meshes = triangulate(domain, {.triangles = 2500, .edge = {}});
        for (const BaseSurface* ground : {&flat, &waves, &ramp}) {
            for (const Model model : {Model::Linear, Model::Exact}) {
                for (const double tilt : {0.0, 0.7, 0.5 * kPi}) {
                    for (const double volume : {0.02, 0.1}) {
                        SolveOptions options = unitOptions(model, 3.0, volume);
                        options.tilt = tilt;
                        options.ground = *ground;
                        options.no_penetration = true;
                        SCOPED_TRACE(std::to_string(meshes[0].loopCount()) + " " +
                                     std::to_string(meshes[0].vertices.size()) +
                                     (ground == &flat    ? " flat"
                                      : ground == &waves ? " waves"
                                                         : " ramp") +
                                     (model == Model::Linear ? " linear " : " exact ") + std::to_string(tilt) + " " +
                                     std::to_string(volume));
                        const Solution solution = solve(meshes, options);
                        EXPECT_TRUE(solution.report.usable());
                        if (!solution.report.usable()) {
                            continue;
                        }
                        expectKkt(meshes[0], solution.droplets[0], options);
                        const double dry = measure(solution.droplets[0], options).dry_area;
                        EXPECT_EQ(dry > 0.0 && solution.droplets[0].dry.empty(), false);
                        dry_runs += dry > 0.0 ? 1 : 0;
                    }
                }
            }
        }
    }
    EXPECT_GT(dry_runs, 30U);
}

TEST(Penetration, ChangesNothingIfNothingSinks)
{
    const std::vector<PlanarMesh> meshes = discMeshes(0.05);
    for (const Model model : {Model::Linear, Model::Exact}) {
        for (const double height : {0.0, 0.1}) {
            SolveOptions options = unitOptions(model, 2.0, 0.6);
            options.tilt = 0.2;
            options.ground = height > 0.0 ? hill(height) : BaseSurface();
            const Solution free = solve(meshes, options);
            options.no_penetration = true;
            const Solution held = solve(meshes, options);
            ASSERT_TRUE(free.report.usable() && held.report.usable());
            EXPECT_TRUE(held.droplets[0].dry.empty());
            EXPECT_NEAR(held.droplets[0].pressure, free.droplets[0].pressure, 1e-9);
            for (std::size_t v = 0; v < meshes[0].vertices.size(); ++v) {
                EXPECT_NEAR(held.droplets[0].vertices[v].z, free.droplets[0].vertices[v].z, 1e-9);
            }
            EXPECT_EQ(measure(held.droplets[0], options).dry_area, 0.0);
        }
    }
}

TEST(Penetration, SolversAgreeAndThreadsDoNotMatter)
{
    const std::vector<PlanarMesh> meshes = discMeshes(0.02);
    for (const Model model : {Model::Linear, Model::Exact}) {
        SolveOptions options = unitOptions(model, 2.0, 0.1);
        options.tilt = 0.6;
        options.ground = hill(0.4);
        options.no_penetration = true;
        std::vector<Solution> solutions;
        for (const Solver solver : {Solver::Llt, Solver::Multigrid, Solver::Auto}) {
            options.solver = solver;
            solutions.push_back(solve(meshes, options));
            ASSERT_TRUE(solutions.back().report.usable());
            for (std::size_t v = 0; v < meshes[0].vertices.size(); ++v) {
                EXPECT_NEAR(solutions.back().droplets[0].vertices[v].z, solutions[0].droplets[0].vertices[v].z, 1e-8);
            }
            EXPECT_EQ(solutions.back().droplets[0].dry, solutions[0].droplets[0].dry) << solutions.back().report.method;
        }
        EXPECT_FALSE(solutions[0].droplets[0].dry.empty());
        std::vector<Solution> runs;
        for (const int threads : {1, 2}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
            tbb::task_arena arena(threads);
            arena.execute([&] { runs.push_back(solve(meshes, options)); });
        }
        EXPECT_EQ(heightsOf(runs[0].droplets[0]), heightsOf(runs[1].droplets[0]));
        EXPECT_EQ(runs[0].droplets[0].dry, runs[1].droplets[0].dry);
        EXPECT_EQ(runs[0].droplets[0].pressure, runs[1].droplets[0].pressure);
    }
}

// Discs on a slope with one reservoir have one pressure and the total volume, and are nowhere below the ground.
TEST(Penetration, OneReservoirKeepsItsVolume)
{
    Domain domain = domainOf(ellipseLoop(1, 1));
    for (const double y : {-2.3, -4.4}) {
        Loop lower = ellipseLoop(0.9, 0.9);
        for (Vec2& p : lower.points) {
            p.y += y;
        }
        domain.droplets.push_back({lower, {}});
    }
    const std::vector<PlanarMesh> meshes = triangulate(domain, {.edge = 0.08});
    for (const Model model : {Model::Linear, Model::Exact}) {
        for (const double gravity : {0.5, 1.5}) {
            SolveOptions options = unitOptions(model, gravity, 0.9);
            options.fill.sharing = FillSharing::Total;
            options.tilt = 0.5;
            options.no_penetration = true;
            const Solution solution = solve(meshes, options);
            SCOPED_TRACE((model == Model::Linear ? "linear " : "exact ") + std::to_string(gravity));
            EXPECT_TRUE(solution.report.usable());
            if (!solution.report.usable()) {
                continue;
            }
            double volume = 0.0;
            for (std::size_t k = 0; k < meshes.size(); ++k) {
                EXPECT_EQ(solution.droplets[k].pressure, solution.droplets[0].pressure);
                expectKkt(meshes[k], solution.droplets[k], options);
                volume += measure(solution.droplets[k], options).volume;
            }
            EXPECT_NEAR(volume / 0.9, 1.0, 1e-8);
        }
    }
}

TEST(Penetration, HeightAndMeanAngleAreMet)
{
    const std::vector<PlanarMesh> meshes = discMeshes(0.06);
    for (const Model model : {Model::Linear, Model::Exact}) {
        SolveOptions options = unitOptions(model, 3.0, 1.0);
        options.tilt = 1.2;
        options.no_penetration = true;
        options.fill = {FillBy::Height, 0.2, FillSharing::Each};
        const Solution by_height = solve(meshes, options);
        ASSERT_TRUE(by_height.report.usable());
        expectKkt(meshes[0], by_height.droplets[0], options);
        const ShapeFigures tall = measure(by_height.droplets[0], options);
        EXPECT_NEAR(tall.height_max / 0.2, 1.0, 1e-8);
        EXPECT_GT(tall.dry_area, 0.0);
        options.fill = {FillBy::ContactAngle, 15 * kDegree, FillSharing::Each};
        const Solution by_angle = solve(meshes, options);
        ASSERT_TRUE(by_angle.report.usable());
        expectKkt(meshes[0], by_angle.droplets[0], options);
        const ShapeFigures wide = measure(by_angle.droplets[0], options);
        EXPECT_NEAR(wide.contact_angle.mean / (15 * kDegree), 1.0, 1e-6);
        EXPECT_GT(wide.dry_area, 0.0);
    }
}

}  // namespace
}  // namespace droplet
