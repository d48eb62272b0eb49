// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheets against spherical caps beyond 90°, the Young–Laplace equation, the exact height field, and limits of
// stability.
#include "droplet/shape/sheet.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "droplet/liquid.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/solve.h"
#include "droplet/units.h"
#include "shape/sheet_energy.h"
#include "shape/sheet_newton.h"
#include "shape/sheet_path.h"
#include "support/domains.h"
#include "support/equilibrium.h"
#include "support/young_laplace.h"

namespace droplet {
namespace {

using testing::discMeshes;
using testing::domainOf;
using testing::polygonLoop;
using testing::Revolution;

constexpr double kPi = std::numbers::pi;

MeshPattern patternOf(const CapillarySurface& sheet)
{
    return {sheet.triangles, sheet.vertices.size(), sheet.rimVertexCount()};
}

/// Dome over the unit disc that is no equilibrium.
CapillarySurface dome()
{
    const PlanarMesh mesh = discMeshes(0.2).front();
    CapillarySurface sheet{.triangles = mesh.triangles, .loop_starts = mesh.loop_starts};
    for (const Vec2 p : mesh.vertices) {
        sheet.vertices.push_back({p.x, p.y, 0.6 * (1.0 - dot(p, p)) * (1.0 + 0.3 * p.x)});
    }
    for (std::uint32_t v = 0; v < sheet.rimVertexCount(); ++v) {
        sheet.vertices[v].z = 0.0;
    }
    return sheet;
}

TEST(SheetEnergy, GradientsAreDerivatives)
{
    const CapillarySurface sheet = dome();
    const Vec3 weight{0.3, -0.2, 1.1};
    const SheetGradients gradients = gradientsOf(sheet, weight);
    constexpr double kStep = 1e-5;
    for (std::size_t v = sheet.rimVertexCount(); v < sheet.vertices.size(); v += 7) {
        for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            CapillarySurface moved = sheet;
            moved.vertices[v].*axis += kStep;
            const SheetIntegrals more = integrate(moved, weight);
            moved.vertices[v].*axis -= 2.0 * kStep;
            const SheetIntegrals less = integrate(moved, weight);
            EXPECT_NEAR(gradients.energy[v].*axis, (more.energy() - less.energy()) / (2.0 * kStep), 1e-8);
            EXPECT_NEAR(gradients.volume[v].*axis, (more.volume - less.volume) / (2.0 * kStep), 1e-8);
        }
    }
}

TEST(SheetEnergy, HessianIsTheDerivativeOfTheGradient)
{
    const CapillarySurface sheet = dome();
    const Vec3 weight{0.3, -0.2, 1.1};
    constexpr double kPressure = 1.3;
    const SheetGradients gradients = gradientsOf(sheet, weight);
    std::vector<Vec3> directions;
    for (const Vec3& v : gradients.volume) {
        directions.push_back((1.0 / length(v)) * v);
    }
    const auto unknowns = static_cast<Eigen::Index>(sheet.vertices.size() - sheet.rimVertexCount());
    const auto place_of = [&](Eigen::Index i) { return sheet.rimVertexCount() + static_cast<std::size_t>(i); };
    Eigen::VectorXd motion(unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i) {
        motion[i] = std::sin(3.0 * static_cast<double>(i));
    }
    const auto forces = [&](double step) {
        CapillarySurface moved = sheet;
        for (Eigen::Index i = 0; i < unknowns; ++i) {
            const std::size_t v = place_of(i);
            moved.vertices[v] = moved.vertices[v] + (step * motion[i]) * directions[v];
        }
        const SheetGradients there = gradientsOf(moved, weight);
        Eigen::VectorXd result(unknowns);
        for (Eigen::Index i = 0; i < unknowns; ++i) {
            const std::size_t v = place_of(i);
            result[i] = dot(directions[v], there.energy[v] - kPressure * there.volume[v]);
        }
        return result;
    };
    const Eigen::SparseMatrix<double> hessian = hessianOf(sheet, directions, weight, kPressure, patternOf(sheet));
    const Eigen::VectorXd exact = hessian.selfadjointView<Eigen::Lower>() * motion;
    const Eigen::VectorXd measured = (forces(1e-6) - forces(-1e-6)) / 2e-6;
    EXPECT_LT((exact - measured).norm(), 1e-7 * exact.norm());
}

/// Errors of a cap: relative ones of area, pressure and height, and of the mean angle [rad].
struct CapErrors {
    double area = 0.0;
    double pressure = 0.0;
    double height = 0.0;
    double angle = 0.0;
};

CapErrors capErrors(double angle, double edge)
{
    const double radius = 1.0 / std::sin(angle);
    const double rise = 1.0 - std::cos(angle);
    const double volume = kPi / 3.0 * std::pow(radius, 3) * (2.0 + std::cos(angle)) * rise * rise;
    const PlanarMesh mesh = discMeshes(edge).front();
    const FilledSheet sheet = fillSheet(mesh, {FillBy::Volume, volume}, {{}, edge * radius, 0.0});
    EXPECT_EQ(sheet.end, SheetEnd::Reached);
    EXPECT_NEAR(sheet.volume, volume, 1e-10 * volume);
    return {std::abs(integrate(sheet.mesh, {}).area / (2.0 * kPi * radius * radius * rise) - 1.0),
            std::abs(sheet.pressure * radius / 2.0 - 1.0), std::abs(sheet.height / (radius * rise) - 1.0),
            std::abs(sheet.angle - angle)};
}

TEST(Sheet, CapsBeyondNinetyDegreesConvergeAtSecondOrder)
{
    for (const double degrees : {60.0, 100.0, 120.0, 140.0, 150.0, 160.0}) {
        SCOPED_TRACE(degrees);
        const CapErrors coarse = capErrors(degrees * kDegree, 0.1);
        const CapErrors fine = capErrors(degrees * kDegree, 0.05);
        EXPECT_GT(coarse.area / fine.area, 3.3);
        EXPECT_GT(coarse.pressure / fine.pressure, 3.3);
        // The highest vertex is somewhere beside the apex: its error is bounded by the square of an edge.
        EXPECT_LT(coarse.height, 0.5 * 0.1 * 0.1);
        EXPECT_LT(fine.height, 0.5 * 0.05 * 0.05);
        if (degrees > 90.0) {
            EXPECT_LT(fine.area, 5e-4);
            EXPECT_LT(fine.pressure, 6e-4);
            EXPECT_LT(fine.height, 1e-3);
            EXPECT_LT(fine.angle, 0.05 * kDegree);
        }
    }
}

SolveOptions unitLiquid(double bond, FillBy by, double amount)
{
    SolveOptions options = testing::unitOptions(Model::Exact, bond, 1.0);
    options.fill = {by, amount, FillSharing::Each};
    return options;
}

/// Relative errors of a droplet of revolution: energy, pressure and height, and of the mean angle [rad].
struct RevolutionErrors {
    double energy = 0.0;
    double pressure = 0.0;
    double height = 0.0;
    double angle = 0.0;
    std::size_t triangles = 0;
};

RevolutionErrors errorsOf(const Revolution& exact, double edge)
{
    const SolveOptions options = unitLiquid(exact.weight, FillBy::Volume, exact.volume);
    const SheetResult result = solveSheet(discMeshes(edge).front(), options);
    EXPECT_EQ(result.end, SheetEnd::Reached);
    const ShapeFigures figures = measure(result.surface, options);
    EXPECT_NEAR(figures.volume, exact.volume, 1e-10 * exact.volume);
    return {std::abs((figures.surface_energy + figures.gravity_energy) / exact.energy() - 1.0),
            std::abs(result.surface.pressure / exact.pressure - 1.0), std::abs(figures.height_max / exact.height - 1.0),
            std::abs(figures.contact_angle.mean - exact.rim_angle), result.surface.triangles.size()};
}

/// Puddles of revolution beyond 90°, by their meridian: second order, and small errors at 10 000 triangles or more.
TEST(Sheet, GravityFollowsYoungAndLaplaceAtSecondOrder)
{
    for (const double bond : {0.5, 2.0, 5.0}) {
        for (const double degrees : {120.0, 135.0, 150.0}) {
            SCOPED_TRACE(std::to_string(bond) + " " + std::to_string(degrees));
            const Revolution exact = testing::dropletOfAngle(bond, degrees * kDegree);
            const double edge = bond > 2.0 ? 0.0195 : bond > 1.0 ? 0.0215 : 0.0255;
            const RevolutionErrors coarse = errorsOf(exact, 2.0 * edge);
            const RevolutionErrors fine = errorsOf(exact, edge);
            EXPECT_GT(fine.triangles, 10'000U);
            EXPECT_LT(fine.energy, 3e-4);
            EXPECT_LT(fine.pressure, 8e-4);
            EXPECT_LT(fine.height, 1e-3);
            EXPECT_LT(fine.angle, 0.1 * kDegree);
            const double halvings =
                0.5 * std::log2(static_cast<double>(fine.triangles) / static_cast<double>(coarse.triangles));
            EXPECT_GT(std::log2(coarse.energy / fine.energy) / halvings, 1.8);
            EXPECT_GT(std::log2(coarse.pressure / fine.pressure) / halvings, 1.8);
            // The highest vertex is somewhere beside the apex: its error is bounded by the square of an edge.
            EXPECT_LT(coarse.height, 4.0 * 1e-3);
        }
    }
}

/// A drop under a ceiling at Bond number 0.5.
TEST(Sheet, HangingDropsConvergeAtSecondOrder)
{
    const Revolution exact = testing::dropletOfVolume(-0.5, 5.261);
    EXPECT_NEAR(exact.rim_angle, 101.46 * kDegree, 0.01 * kDegree);
    const RevolutionErrors coarse = errorsOf(exact, 0.08);
    const RevolutionErrors fine = errorsOf(exact, 0.04);
    EXPECT_LT(fine.energy, 3e-4);
    EXPECT_LT(fine.pressure, 8e-4);
    EXPECT_LT(fine.height, 1e-3);
    EXPECT_LT(fine.angle, 0.1 * kDegree);
    EXPECT_GT(coarse.energy / fine.energy, 3.3);
    EXPECT_GT(coarse.pressure / fine.pressure, 3.3);
    // The highest vertex is somewhere beside the apex: its error is bounded by the square of an edge.
    EXPECT_LT(coarse.height, 4.0 * 1e-3);
}

/// At single vertices of a smooth rim, the angle is of first order.
TEST(Sheet, AnglesAtSingleVerticesConverge)
{
    for (const double degrees : {40.0, 100.0, 140.0}) {
        SCOPED_TRACE(degrees);
        const auto largest_error = [&](double edge) {
            const SheetResult result =
                solveSheet(discMeshes(edge).front(), unitLiquid(0.0, FillBy::ContactAngle, degrees * kDegree));
            EXPECT_EQ(result.end, SheetEnd::Reached);
            double largest = 0.0;
            for (const double angle : result.surface.contact_angle) {
                largest = std::max(largest, std::abs(angle - degrees * kDegree));
            }
            return largest;
        };
        const double coarse = largest_error(0.12);
        const double fine = largest_error(0.03);
        EXPECT_LT(fine, 0.4 * kDegree);
        EXPECT_GT(std::log2(coarse / fine) / 2.0, 0.85);
    }
}

/// Square of side 1: energy and pressure of Surface Evolver's refined mesh; and mercury on 4 mm.
TEST(Sheet, SquaresHaveTheFiguresOfSurfaceEvolver)
{
    const auto square = [](double side, double edge) {
        return triangulate(domainOf(polygonLoop({{0, 0}, {side, 0}, {side, side}, {0, side}})), {.edge = edge}).front();
    };
    const SolveOptions light = unitLiquid(0.0, FillBy::Volume, 1.6);
    const SheetResult bead = solveSheet(square(1.0, 0.025), light);
    ASSERT_EQ(bead.end, SheetEnd::Reached);
    EXPECT_NEAR(measure(bead.surface, light).surface_energy, 5.8192, 2e-3);
    EXPECT_NEAR(bead.surface.pressure, 2.6727, 2e-3);

    constexpr double kSide = 4e-3;
    SolveOptions heavy;
    heavy.model = Model::Exact;
    heavy.liquid = liquidNamed("mercury");
    heavy.fill = {FillBy::ContactAngle, 140.0 * kDegree, FillSharing::Each};
    const SheetResult mercury = solveSheet(square(kSide, 0.02 * kSide), heavy);
    ASSERT_EQ(mercury.end, SheetEnd::Reached);
    const ShapeFigures figures = measure(mercury.surface, heavy);
    EXPECT_NEAR(figures.volume / std::pow(kSide, 3), 0.7397, 1e-3);
    EXPECT_NEAR(figures.height_max / kSide, 0.7131, 1e-3);
}

/// Below 90°, a sheet is the height field of the exact model, but for the directions in which vertices move.
TEST(Sheet, IsTheExactHeightFieldWhereThatExists)
{
    const std::vector<PlanarMesh> meshes =
        triangulate(domainOf(polygonLoop({{0, 0}, {1, 0}, {1, 1}, {0, 1}})), {.edge = 0.05});
    const SolveOptions options = unitLiquid(2.0, FillBy::Volume, 0.1);
    const Solution solution = solve(meshes, options);
    ASSERT_TRUE(solution.report.usable());
    const ShapeFigures figures = measure(solution.droplets.front(), options);
    const Vec3 weight{0.0, 0.0, 2.0};
    const FilledSheet sheet = fillSheet(meshes.front(), {FillBy::Volume, 0.1}, {weight, 0.05, 0.0});
    const double energy = integrate(sheet.mesh, weight).energy();
    EXPECT_NEAR(energy, figures.surface_energy + figures.gravity_energy, 1e-3 * energy);
    EXPECT_NEAR(sheet.pressure, solution.droplets.front().pressure, 1e-2 * sheet.pressure);
    EXPECT_NEAR(sheet.angle, figures.contact_angle.mean, 0.5 * kDegree);
}

/// Length of boundary edges, and whether every edge has at most two triangles, wound alike.
void expectBoundedByItsRim(const CapillarySurface& sheet)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle& t : sheet.triangles) {
        for (std::size_t a = 0; a < 3; ++a) {
            EXPECT_EQ(++edges[std::make_pair(t[a], t[(a + 1) % 3])], 1);
        }
    }
    std::size_t boundary = 0;
    for (const auto& [edge, count] : edges) {
        if (!edges.contains(std::make_pair(edge.second, edge.first))) {
            ++boundary;
            EXPECT_LT(std::max(edge.first, edge.second), sheet.rimVertexCount());
        }
    }
    EXPECT_EQ(boundary, sheet.rimVertexCount());
}

TEST(Sheet, LeansOverInnerCornersAndLiesOnTheGround)
{
    // A U: liquid closes its slot from the bottom, on ground that is outside of the footprint.
    const Loop loop =
        polygonLoop({{0, 0}, {1.3, 0}, {1.3, 1.5}, {0.8, 1.5}, {0.8, 0.5}, {0.5, 0.5}, {0.5, 1.5}, {0, 1.5}});
    const PlanarMesh mesh = triangulate(domainOf(loop), {.edge = 0.08}).front();
    const SolveOptions options = unitLiquid(0.0, FillBy::Volume, 1.0);
    const SheetResult result = solveSheet(mesh, options);
    ASSERT_EQ(result.end, SheetEnd::Reached);
    expectBoundedByItsRim(result.surface);
    const ShapeFigures figures = measure(result.surface, options);
    EXPECT_NEAR(figures.volume, 1.0, 1e-10);
    EXPECT_GT(figures.contact_angle.max, 175.0 * kDegree);
    EXPECT_GT(figures.overhang, 0.1);
    std::size_t grounded = 0;
    for (std::size_t v = result.surface.rimVertexCount(); v < result.surface.vertices.size(); ++v) {
        EXPECT_GE(result.surface.vertices[v].z, 0.0);
        grounded += result.surface.vertices[v].z == 0.0 ? 1 : 0;
    }
    EXPECT_GT(grounded, 10U);
    // The finer mesh has less energy. With edges of 0.06, folds take nearly all triangles, as they do with 0.08.
    const ShapeFigures fine = [&] {
        const PlanarMesh finer = triangulate(domainOf(loop), {.edge = 0.04}).front();
        return measure(solveSheet(finer, options).surface, options);
    }();
    EXPECT_LT(fine.surface_energy, figures.surface_energy);
    EXPECT_NEAR(fine.surface_energy, figures.surface_energy, 1e-2 * figures.surface_energy);
}

TEST(Sheet, SaysWhereTheMeanAngleHasItsMaximum)
{
    // A thin ring has no mean of 150°: its hole closes, or it rolls away, before.
    const Domain ring = domainOf(testing::ellipseLoop(1, 1), {testing::reversed(testing::ellipseLoop(0.8, 0.8))});
    const SolveOptions options = unitLiquid(0.0, FillBy::ContactAngle, 150.0 * kDegree);
    const PlanarMesh mesh = triangulate(ring, {.edge = 0.06}).front();
    const SheetResult result = solveSheet(mesh, options);
    EXPECT_NE(result.end, SheetEnd::Reached);
    EXPECT_GT(result.volume, 0.0);
    EXPECT_GT(result.contact_angle, 60.0 * kDegree);
    EXPECT_LT(result.contact_angle, 150.0 * kDegree);
}

/// A drop that hangs at Bond number 0.5 detaches at V = 9.83526 by the Young–Laplace equation.
TEST(SheetLimits, PendantDropsDetach)
{
    const SolveOptions held = unitLiquid(-0.5, FillBy::Volume, 8.10129);
    const SheetResult drop = solveSheet(discMeshes(0.035).front(), held);
    ASSERT_EQ(drop.end, SheetEnd::Reached);
    EXPECT_NEAR(drop.surface.pressure, 0.70392, 2e-3 * 0.70392);
    EXPECT_NEAR(measure(drop.surface, held).height_max, 2.57215, 1e-3 * 2.57215);
    EXPECT_NEAR(drop.contact_angle, 94.70 * kDegree, 0.1 * kDegree);

    const SheetResult last = solveSheet(discMeshes(0.08).front(), unitLiquid(-0.5, FillBy::Volume, 10.0));
    EXPECT_EQ(last.end, SheetEnd::Unstable);
    EXPECT_NEAR(last.volume, 9.83526, 3e-3 * 9.83526);
}

/// Liquid on a ring closes its hole of a fifth of the radius at V = 0.5972, by the Young–Laplace equation, where the
/// footprint's area is π.
TEST(SheetLimits, HolesOfRingsClose)
{
    const double radius = 1.0 / std::sqrt(1.0 - 0.04);
    const Domain ring = domainOf(testing::ellipseLoop(radius, radius),
                                 {testing::reversed(testing::ellipseLoop(0.2 * radius, 0.2 * radius))});
    const PlanarMesh mesh = triangulate(ring, {.edge = 0.05}).front();
    const SheetResult last = solveSheet(mesh, unitLiquid(0.0, FillBy::Volume, 1.0));
    EXPECT_NE(last.end, SheetEnd::Reached);
    EXPECT_GT(last.volume, 0.594);
    EXPECT_LT(last.volume, 0.606);
}

/// A puddle spreads over the ground around its rim once it has 180° all along: the rim does not hold it any more.
TEST(SheetLimits, RimsDoNotHoldPuddlesOf180Degrees)
{
    const Revolution last = testing::dropletOfAngle(3.0, kPi);
    const SheetResult result =
        solveSheet(discMeshes(0.03).front(), unitLiquid(3.0, FillBy::Volume, 3.0 * last.volume), SheetEffort::Modest);
    EXPECT_EQ(result.end, SheetEnd::NotHeld);
    EXPECT_NEAR(result.volume, last.volume, 0.03 * last.volume);
    EXPECT_GT(result.contact_angle, 178.0 * kDegree);
}

/// Ridge of liquid on a strip of width 1, between mirrors at both ends of a length: part of a cylinder.
CapillarySurface ridge(double angle, double length_of, std::size_t across, std::size_t along)
{
    CapillarySurface sheet;
    const double radius = 0.5 / std::sin(angle);
    const auto place = [&](std::size_t i, std::size_t j) {
        const double turn = angle * (2.0 * static_cast<double>(i) / static_cast<double>(across) - 1.0);
        return Vec3{length_of * static_cast<double>(j) / static_cast<double>(along), -radius * std::sin(turn),
                    radius * (std::cos(turn) - std::cos(angle))};
    };
    std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> number;
    const auto add = [&](std::size_t i, std::size_t j) {
        number[{i, j}] = static_cast<std::uint32_t>(sheet.vertices.size());
        sheet.vertices.push_back(place(i, j));
    };
    for (const std::size_t i : {std::size_t{0}, across}) {
        for (std::size_t j = 0; j <= along; ++j) {
            add(i, j);
        }
    }
    sheet.loop_starts = {0, static_cast<std::uint32_t>(sheet.vertices.size())};
    for (std::size_t i = 1; i < across; ++i) {
        for (std::size_t j = 0; j <= along; ++j) {
            add(i, j);
        }
    }
    for (std::size_t i = 0; i < across; ++i) {
        for (std::size_t j = 0; j < along; ++j) {
            const std::uint32_t a = number[{i, j}];
            const std::uint32_t b = number[{i, j + 1}];
            const std::uint32_t c = number[{i + 1, j + 1}];
            const std::uint32_t d = number[{i + 1, j}];
            // Diagonals alternate, so that the mesh is symmetric.
            if ((i + j) % 2 == 0) {
                sheet.triangles.push_back({a, c, b});
                sheet.triangles.push_back({a, d, c});
            } else {
                sheet.triangles.push_back({a, d, b});
                sheet.triangles.push_back({b, d, c});
            }
        }
    }
    return sheet;
}

/// Number of negative eigenvalues of the bordered matrix of a ridge: 1 if it is stable at its volume.
int negativesOf(const CapillarySurface& sheet, double pressure)
{
    const SheetGradients gradients = gradientsOf(sheet, {});
    std::vector<Vec3> directions;
    double end = 0.0;
    for (const Vec3& p : sheet.vertices) {
        end = std::max(end, p.x);
    }
    for (std::size_t v = 0; v < sheet.vertices.size(); ++v) {
        Vec3 direction = gradients.volume[v];
        if (sheet.vertices[v].x == 0.0 || sheet.vertices[v].x == end) {
            direction.x = 0.0;  // mirrors
        }
        directions.push_back((1.0 / length(direction)) * direction);
    }
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(
        hessianOf(sheet, directions, {}, pressure, patternOf(sheet)));
    Eigen::VectorXd border(static_cast<Eigen::Index>(sheet.vertices.size() - sheet.rimVertexCount()));
    for (Eigen::Index i = 0; i < border.size(); ++i) {
        const std::size_t v = sheet.rimVertexCount() + static_cast<std::size_t>(i);
        border[i] = dot(directions[v], gradients.volume[v]);
    }
    const Eigen::VectorXd response = factor.solve(border);
    return static_cast<int>((factor.vectorD().array() < 0.0).count()) + (border.dot(response) > 0.0 ? 1 : 0);
}

/// A ridge of length 4 between mirrors bulges from V = 0.47163 · 4 on: r q = √(1 − (π/2θ)²), q = π/4.
TEST(SheetLimits, RidgesBetweenMirrorsBulge)
{
    constexpr double kLength = 4.0;
    double stable = 95.0 * kDegree;
    double unstable = 125.0 * kDegree;
    const auto negatives = [](double angle) {
        // The pressure of the inscribed prism: its edges are chords.
        constexpr std::size_t kAcross = 44;
        const double radius = 0.5 / std::sin(angle);
        const double pressure = 1.0 / (radius * std::cos(angle / kAcross));
        return negativesOf(ridge(angle, kLength, kAcross, 110), pressure);
    };
    ASSERT_EQ(negatives(stable), 1);
    ASSERT_GT(negatives(unstable), 1);
    while (unstable - stable > 1e-4) {
        const double middle = 0.5 * (stable + unstable);
        (negatives(middle) == 1 ? stable : unstable) = middle;
    }
    const double radius = 0.5 / std::sin(stable);
    EXPECT_NEAR(radius * radius * (stable - std::sin(stable) * std::cos(stable)), 0.47163, 3e-3 * 0.47163);
}

/// Liquid on a rectangle of aspect 6 gathers in its middle without a loss of stability.
TEST(SheetLimits, ShortRectanglesHoldAnyVolume)
{
    const PlanarMesh mesh = triangulate(domainOf(polygonLoop({{0, 0}, {6, 0}, {6, 1}, {0, 1}})), {.edge = 0.1}).front();
    const SolveOptions options = unitLiquid(0.0, FillBy::Volume, 12.0);
    const SheetResult bulge = solveSheet(mesh, options);
    ASSERT_EQ(bulge.end, SheetEnd::Reached);
    EXPECT_NEAR(measure(bulge.surface, options).surface_energy, 24.84, 0.05);
}

TEST(Sheet, EndsAtAnEquilibriumWhenItsWorkIsDone)
{
    const PlanarMesh mesh = discMeshes(0.1).front();
    const SheetOptions options_of_whole{{}, 0.1, 0.3, mesh.triangles.size()};
    SheetOptions options = options_of_whole;
    const FilledSheet whole = fillSheet(mesh, {FillBy::Volume, 4.0}, options);
    ASSERT_EQ(whole.end, SheetEnd::Reached);
    options.max_work = 3e6;
    const FilledSheet part = fillSheet(mesh, {FillBy::Volume, 4.0}, options);
    ASSERT_EQ(part.end, SheetEnd::OutOfWork);
    EXPECT_GT(part.volume, 0.0);
    EXPECT_LT(part.volume, 4.0);
    EXPECT_NEAR(integrate(part.mesh, {}).volume, part.volume, 1e-10);
    EXPECT_LT(part.newton_steps, whole.newton_steps);
    // It is the cap of its volume.
    const FilledSheet cap = fillSheet(mesh, {FillBy::Volume, part.volume}, options_of_whole);
    EXPECT_NEAR(part.pressure, cap.pressure, 1e-3 * cap.pressure);
}

TEST(Sheet, GivesTheSameBytesAgain)
{
    const PlanarMesh mesh = discMeshes(0.1).front();
    const SolveOptions options = unitLiquid(1.0, FillBy::ContactAngle, 130.0 * kDegree);
    const SheetResult one = solveSheet(mesh, options);
    const SheetResult other = solveSheet(mesh, options);
    EXPECT_TRUE(one.surface.vertices == other.surface.vertices);
    EXPECT_TRUE(one.surface.triangles == other.surface.triangles);
    EXPECT_NEAR(one.contact_angle, 130.0 * kDegree, 1e-7);
}

}  // namespace
}  // namespace droplet
