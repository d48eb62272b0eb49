// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheets against spherical caps beyond 90°, the Young–Laplace equation, the exact height field, and limits of
// stability.
#include "droplet/shape/sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

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

/// Dome over the unit disc that is no equilibrium.
SheetMesh dome()
{
    const PlanarMesh mesh = discMeshes(0.2).front();
    SheetMesh sheet{{}, mesh.triangles, mesh.rimVertexCount()};
    for (const Vec2 p : mesh.vertices) {
        sheet.places.push_back({p.x, p.y, 0.6 * (1.0 - dot(p, p)) * (1.0 + 0.3 * p.x)});
    }
    for (std::uint32_t v = 0; v < sheet.rim; ++v) {
        sheet.places[v].z = 0.0;
    }
    return sheet;
}

TEST(SheetEnergy, GradientsAreDerivatives)
{
    const SheetMesh sheet = dome();
    const Vec3 weight{0.3, -0.2, 1.1};
    const SheetGradients gradients = gradientsOf(sheet, weight);
    constexpr double kStep = 1e-5;
    for (std::size_t v = sheet.rim; v < sheet.places.size(); v += 7) {
        for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            SheetMesh moved = sheet;
            moved.places[v].*axis += kStep;
            const SheetIntegrals more = integrate(moved, weight);
            moved.places[v].*axis -= 2.0 * kStep;
            const SheetIntegrals less = integrate(moved, weight);
            EXPECT_NEAR(gradients.energy[v].*axis, (more.energy() - less.energy()) / (2.0 * kStep), 1e-8);
            EXPECT_NEAR(gradients.volume[v].*axis, (more.volume - less.volume) / (2.0 * kStep), 1e-8);
        }
    }
}

TEST(SheetEnergy, HessianIsTheDerivativeOfTheGradient)
{
    const SheetMesh sheet = dome();
    const Vec3 weight{0.3, -0.2, 1.1};
    constexpr double kPressure = 1.3;
    const SheetGradients gradients = gradientsOf(sheet, weight);
    std::vector<Vec3> directions;
    for (const Vec3& v : gradients.volume) {
        directions.push_back((1.0 / length(v)) * v);
    }
    const auto unknowns = static_cast<Eigen::Index>(sheet.places.size() - sheet.rim);
    const auto place_of = [&](Eigen::Index i) { return sheet.rim + static_cast<std::size_t>(i); };
    Eigen::VectorXd motion(unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i) {
        motion[i] = std::sin(3.0 * static_cast<double>(i));
    }
    const auto forces = [&](double step) {
        SheetMesh moved = sheet;
        for (Eigen::Index i = 0; i < unknowns; ++i) {
            const std::size_t v = place_of(i);
            moved.places[v] = moved.places[v] + (step * motion[i]) * directions[v];
        }
        const SheetGradients there = gradientsOf(moved, weight);
        Eigen::VectorXd result(unknowns);
        for (Eigen::Index i = 0; i < unknowns; ++i) {
            const std::size_t v = place_of(i);
            result[i] = dot(directions[v], there.energy[v] - kPressure * there.volume[v]);
        }
        return result;
    };
    const Eigen::SparseMatrix<double> hessian = SheetPattern(sheet).hessian(sheet, directions, weight, kPressure);
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
    for (const double degrees : {60.0, 100.0, 140.0, 160.0}) {
        SCOPED_TRACE(degrees);
        const CapErrors coarse = capErrors(degrees * kDegree, 0.1);
        const CapErrors fine = capErrors(degrees * kDegree, 0.05);
        EXPECT_GT(coarse.area / fine.area, 3.3);
        EXPECT_GT(coarse.pressure / fine.pressure, 3.3);
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

/// Puddles of revolution beyond 90°, by their meridian.
TEST(Sheet, GravityFollowsYoungAndLaplace)
{
    const PlanarMesh mesh = discMeshes(0.05).front();
    for (const double bond : {0.5, 2.0, 5.0}) {
        for (const double degrees : {120.0, 135.0}) {
            SCOPED_TRACE(std::to_string(bond) + " " + std::to_string(degrees));
            const Revolution exact = testing::dropletOfAngle(bond, degrees * kDegree);
            const SolveOptions options = unitLiquid(bond, FillBy::Volume, exact.volume);
            const SheetResult result = solveSheet(mesh, options);
            ASSERT_EQ(result.end, SheetEnd::Reached);
            const ShapeFigures figures = measure(result.sheet, options);
            // At Bond number 5 the foot is sharp: there the errors are largest.
            EXPECT_NEAR(figures.height_max, exact.height, 3e-3 * exact.height);
            EXPECT_NEAR(figures.surface_energy + figures.gravity_energy, exact.energy(), 1.5e-3 * exact.energy());
            EXPECT_NEAR(result.sheet.pressure, exact.pressure, 2.5e-3 * exact.pressure);
            EXPECT_NEAR(figures.contact_angle.mean, degrees * kDegree, 0.3 * kDegree);
        }
    }
}

/// Below 90°, a sheet is the height field of the exact model, but for the directions in which vertices move.
TEST(Sheet, IsTheExactHeightFieldWhereThatExists)
{
    const std::vector<PlanarMesh> meshes =
        triangulate(domainOf(polygonLoop({{0, 0}, {1, 0}, {1, 1}, {0, 1}})), {.edge = 0.05});
    const SolveOptions options = unitLiquid(2.0, FillBy::Volume, 0.1);
    const Solution solution = solve(meshes, options);
    ASSERT_TRUE(solution.report.usable());
    const ShapeFigures figures = measure(meshes.front(), solution.droplets.front(), options);
    const Vec3 weight{0.0, 0.0, 2.0};
    const FilledSheet sheet = fillSheet(meshes.front(), {FillBy::Volume, 0.1}, {weight, 0.05, 0.0});
    const double energy = integrate(sheet.mesh, weight).energy();
    EXPECT_NEAR(energy, figures.surface_energy + figures.gravity_energy, 1e-3 * energy);
    EXPECT_NEAR(sheet.pressure, solution.droplets.front().pressure, 1e-2 * sheet.pressure);
    EXPECT_NEAR(sheet.angle, figures.contact_angle.mean, 0.5 * kDegree);
}

/// Length of boundary edges, and whether every edge has at most two triangles, wound alike.
void expectBoundedByItsRim(const ParametricSheet& sheet)
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
            EXPECT_LT(std::max(edge.first, edge.second), sheet.rim);
        }
    }
    EXPECT_EQ(boundary, sheet.rim);
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
    expectBoundedByItsRim(result.sheet);
    const ShapeFigures figures = measure(result.sheet, options);
    EXPECT_NEAR(figures.volume, 1.0, 1e-10);
    EXPECT_GT(figures.contact_angle.max, 175.0 * kDegree);
    EXPECT_GT(figures.overhang, 0.1);
    std::size_t grounded = 0;
    for (std::size_t v = result.sheet.rim; v < result.sheet.places.size(); ++v) {
        EXPECT_GE(result.sheet.places[v].z, 0.0);
        grounded += result.sheet.places[v].z == 0.0 ? 1 : 0;
    }
    EXPECT_GT(grounded, 10U);
    // The finer mesh has less energy.
    const ShapeFigures fine = [&] {
        const PlanarMesh finer = triangulate(domainOf(loop), {.edge = 0.06}).front();
        return measure(solveSheet(finer, options).sheet, options);
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
    const SheetResult drop = solveSheet(discMeshes(0.06).front(), held);
    ASSERT_EQ(drop.end, SheetEnd::Reached);
    EXPECT_NEAR(drop.sheet.pressure, 0.70392, 2e-3 * 0.70392);
    EXPECT_NEAR(measure(drop.sheet, held).height_max, 2.57215, 1e-3 * 2.57215);
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

/// Liquid on a rectangle of aspect 6 gathers in its middle without a loss of stability.
TEST(SheetLimits, ShortRectanglesHoldAnyVolume)
{
    const PlanarMesh mesh = triangulate(domainOf(polygonLoop({{0, 0}, {6, 0}, {6, 1}, {0, 1}})), {.edge = 0.1}).front();
    const SolveOptions options = unitLiquid(0.0, FillBy::Volume, 12.0);
    const SheetResult bulge = solveSheet(mesh, options);
    ASSERT_EQ(bulge.end, SheetEnd::Reached);
    EXPECT_NEAR(measure(bulge.sheet, options).surface_energy, 24.84, 0.05);
}

TEST(Sheet, EndsAtAnEquilibriumWhenItsWorkIsDone)
{
    const PlanarMesh mesh = discMeshes(0.1).front();
    SheetOptions options{{}, 0.1, 0.3};
    const FilledSheet whole = fillSheet(mesh, {FillBy::Volume, 4.0}, options);
    ASSERT_EQ(whole.end, SheetEnd::Reached);
    options.max_work = 1e6;
    const FilledSheet part = fillSheet(mesh, {FillBy::Volume, 4.0}, options);
    ASSERT_EQ(part.end, SheetEnd::OutOfWork);
    EXPECT_GT(part.volume, 0.0);
    EXPECT_LT(part.volume, 4.0);
    EXPECT_NEAR(integrate(part.mesh, {}).volume, part.volume, 1e-10);
    EXPECT_LT(part.newton_steps, whole.newton_steps);
    // It is the cap of its volume.
    const FilledSheet cap = fillSheet(mesh, {FillBy::Volume, part.volume}, {{}, 0.1, 0.3});
    EXPECT_NEAR(part.pressure, cap.pressure, 1e-3 * cap.pressure);
}

TEST(Sheet, GivesTheSameBytesAgain)
{
    const PlanarMesh mesh = discMeshes(0.1).front();
    const SolveOptions options = unitLiquid(1.0, FillBy::ContactAngle, 130.0 * kDegree);
    const SheetResult one = solveSheet(mesh, options);
    const SheetResult other = solveSheet(mesh, options);
    EXPECT_TRUE(one.sheet.places == other.sheet.places);
    EXPECT_TRUE(one.sheet.triangles == other.sheet.triangles);
    EXPECT_NEAR(one.contact_angle, 130.0 * kDegree, 1e-7);
}

}  // namespace
}  // namespace droplet
