// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheets on balls, in bowls and gutters, where caps are exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "droplet/shape/base_surface.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/sheet.h"
#include "droplet/shape/solve.h"
#include "droplet/units.h"
#include "shape/sheet_base.h"
#include "shape/work.h"
#include "support/domains.h"
#include "support/equilibrium.h"
#include "support/young_laplace.h"

namespace droplet {
namespace {

constexpr double kPi = std::numbers::pi;

/// Volume of a cap on the circle of radius 1, whose sphere meets the circle's plane at an angle; < 0 below the plane.
double capVolume(double angle)
{
    const double radius = 1.0 / std::sin(angle);
    const double rise = radius * (1.0 - std::cos(angle));
    return kPi / 3.0 * rise * rise * (3.0 * radius - rise);
}

/// Relative errors of a bead on a ball, or in a bowl, and the largest error of an angle at a rim vertex [rad].
struct BeadErrors {
    double area = 0.0;
    double pressure = 0.0;
    double height = 0.0;
    double mean_angle = 0.0;
    double angle = 0.0;
};

/// @param radius  of the ball; negative: a bowl
/// @param angle   of the liquid to the ground
BeadErrors beadErrors(double radius, double angle, double edge)
{
    const double slope = std::asin(1.0 / radius);  // by which the ground falls at the rim
    const double cap = angle + slope;              // to the plane
    SolveOptions options = testing::unitOptions(Model::Exact, 0.0, capVolume(cap) - capVolume(slope));
    options.ground = BaseSurface::sphere(radius);
    const SheetResult result = solveSheet(testing::discMeshes(edge).front(), options);
    EXPECT_EQ(result.end, SheetEnd::Reached);
    const ShapeFigures figures = measure(result.surface, options);
    EXPECT_NEAR(figures.volume, options.fill.amount, 1e-9 * options.fill.amount);
    EXPECT_LT(figures.depth_max, 1e-12);
    const double rise = std::tan(0.5 * cap) - std::tan(0.5 * slope);
    const double sphere = 1.0 / std::sin(cap);
    BeadErrors errors{std::abs(figures.liquid_area / (2.0 * kPi * sphere * sphere * (1.0 - std::cos(cap))) - 1.0),
                      std::abs(result.surface.pressure * sphere / 2.0 - 1.0), std::abs(figures.height_max / rise - 1.0),
                      std::abs(figures.contact_angle.mean - angle), 0.0};
    for (const double own : result.surface.contact_angle) {
        errors.angle = std::max(errors.angle, std::abs(own - angle));
    }
    return errors;
}

TEST(SheetGround, BeadsOnBallsAndInBowlsConvergeAtSecondOrder)
{
    struct Bead {
        double radius;
        double degrees;
    };
    for (const Bead& bead : {Bead{3.0, 110.0}, Bead{1.5, 70.0}, Bead{-2.5, 120.0}}) {
        SCOPED_TRACE(std::to_string(bead.radius) + " " + std::to_string(bead.degrees));
        // Beads are two to four times as large as their footprints, and have as many triangles.
        const BeadErrors coarse = beadErrors(bead.radius, bead.degrees * kDegree, 0.08);
        const BeadErrors fine = beadErrors(bead.radius, bead.degrees * kDegree, 0.04);
        EXPECT_GT(coarse.area / fine.area, 3.0);
        EXPECT_GT(coarse.pressure / fine.pressure, 3.0);
        EXPECT_LT(fine.area, 1e-3);
        EXPECT_LT(fine.pressure, 1.5e-3);
        EXPECT_LT(fine.height, 2e-3);
        EXPECT_LT(fine.mean_angle, 0.1 * kDegree);
        EXPECT_LT(fine.angle, 0.7 * coarse.angle);
    }
}

/// In a gutter, gravity and ground act together: a steep height field and the sheet are the same droplet.
TEST(SheetGround, IsTheExactHeightFieldWhereThatExists)
{
    const std::vector<PlanarMesh> meshes = testing::discMeshes(0.06);
    SolveOptions options = testing::unitOptions(Model::Exact, 2.0, 0.9);
    options.ground = BaseSurface::cylinder(-2.0, 0.4);
    options.tilt = 20.0 * kDegree;
    const Solution solution = solve(meshes, options);
    ASSERT_TRUE(solution.report.usable());
    const ShapeFigures field = measure(solution.droplets.front(), options);
    const SheetResult result = solveSheet(meshes.front(), options);
    ASSERT_EQ(result.end, SheetEnd::Reached);
    const ShapeFigures sheet = measure(result.surface, options);
    EXPECT_NEAR(sheet.volume, field.volume, 1e-9);
    EXPECT_NEAR(sheet.surface_energy, field.surface_energy, 2e-3 * field.surface_energy);
    EXPECT_NEAR(sheet.gravity_energy, field.gravity_energy, 2e-3 * std::abs(field.gravity_energy) + 1e-4);
    EXPECT_NEAR(result.surface.pressure, solution.droplets.front().pressure, 1e-2 * result.surface.pressure);
    EXPECT_NEAR(sheet.contact_angle.mean, field.contact_angle.mean, 0.5 * kDegree);
    EXPECT_NEAR(sheet.contact_angle.max, field.contact_angle.max, 1.5 * kDegree);
}

/// Little liquid leaves the top of a ball dry: the sheet lies on it.
TEST(SheetGround, LiesOnTheTopOfABall)
{
    const double slope = std::asin(1.0 / 1.5);
    SolveOptions options = testing::unitOptions(Model::Exact, 4.0, 0.05 * capVolume(slope));
    options.ground = BaseSurface::sphere(1.5);
    const SheetResult result = solveSheet(testing::discMeshes(0.08).front(), options);
    ASSERT_EQ(result.end, SheetEnd::Reached);
    const ShapeFigures figures = measure(result.surface, options);
    EXPECT_NEAR(figures.volume, options.fill.amount, 1e-9 * options.fill.amount);
    EXPECT_EQ(figures.depth_max, 0.0);
    EXPECT_GE(figures.contact_angle.min, 0.0);
}

/// Two discs at one pressure: caps of one sphere. The larger one is beyond a hemisphere, where more liquid lowers its
/// pressure, so that the smaller one drains into it.
TEST(SharedSheet, DiscsAtOnePressureAreCapsOfOneSphere)
{
    constexpr double kSmall = 0.7;
    const double large_angle = 125.0 * kDegree;
    const double radius = 1.0 / std::sin(large_angle);
    const double small_angle = std::asin(kSmall / radius);
    const double large_volume = capVolume(large_angle);
    const double small_volume = std::pow(kSmall, 3) * capVolume(small_angle);
    std::vector<PlanarMesh> discs = testing::discMeshes(0.05);
    Loop loop = testing::ellipseLoop(kSmall, kSmall);
    for (Vec2& p : loop.points) {
        p.x += 5.0;
    }
    discs.push_back(triangulate(testing::domainOf(loop), {.edge = 0.05}).front());
    SolveOptions options = testing::unitOptions(Model::Exact, 0.0, large_volume + small_volume);
    options.fill.sharing = FillSharing::Total;
    const SheetResult result = solveSheet(discs, options);
    ASSERT_EQ(result.end, SheetEnd::Reached);
    const std::vector<CapillarySurface> sheets = separate(result.surface);
    ASSERT_EQ(sheets.size(), 2U);
    const ShapeFigures large = measure(sheets[0], options);
    const ShapeFigures small = measure(sheets[1], options);
    EXPECT_NEAR(large.volume + small.volume, options.fill.amount, 1e-9 * options.fill.amount);
    EXPECT_EQ(sheets[0].pressure, sheets[1].pressure);
    EXPECT_NEAR(sheets[0].pressure, 2.0 / radius, 2e-3 * 2.0 / radius);
    EXPECT_NEAR(large.volume, large_volume, 5e-3 * large_volume);
    EXPECT_NEAR(small.volume, small_volume, 5e-3 * small_volume);
    EXPECT_NEAR(large.contact_angle.mean, large_angle, 0.2 * kDegree);
    EXPECT_NEAR(small.contact_angle.mean, small_angle, 0.2 * kDegree);
    for (const CapillarySurface& sheet : sheets) {
        sheet.validate();
        sheet.footprint->validate();
    }
}

/// Ground that is far too steep for its triangles, as a height map in metres under a picture of millimetres.
BaseSurface steepGround()
{
    constexpr double kHeight = 50.0;
    constexpr double kWaves = 20.0;
    return BaseSurface([](Vec2 p) {
        return GroundPoint{kHeight * std::sin(kWaves * p.x) * std::cos(kWaves * p.y),
                           kHeight * kWaves *
                               Vec2{std::cos(kWaves * p.x) * std::cos(kWaves * p.y),
                                    -std::sin(kWaves * p.x) * std::sin(kWaves * p.y)}};
    });
}

// Dry triangles are chords of the ground, and so are those of the base: there is no liquid between both, though seen
// from above coarse chords of a ball are far below fine ones.
TEST(SheetGround, DryTrianglesHoldNoLiquid)
{
    const BaseSurface ball = BaseSurface::sphere(1.5);
    const PlanarMesh footprint = testing::discMeshes(0.05).front();
    const SheetBase base = baseOf(footprint, ball, {0.0, 0.3, 1.0});
    for (const double edge : {0.4, 0.2, 0.1}) {
        SCOPED_TRACE(edge);
        const CapillarySurface dry = drySheet(cover(footprint, edge), ball);
        const double chords = integrate(dry, {}).volume - base.integrals.volume;
        EXPECT_LT(chords, -0.01 * edge * edge);
        EXPECT_LT(std::abs(base.liquidUnder(dry, {0.0, 0.3, 1.0}).volume), 0.04 * std::abs(chords));
        EXPECT_LT(std::abs(base.liquidUnder(dry, {0.0, 0.3, 1.0}).gravity), 0.04 * std::abs(chords));
    }
    CapillarySurface wet = drySheet(footprint, ball);
    for (std::size_t v = wet.rimVertexCount(); v < wet.vertices.size(); ++v) {
        wet.vertices[v].z += 0.1;
    }
    EXPECT_EQ(base.liquidUnder(wet, {}).volume, integrate(wet, {}).volume - base.integrals.volume);
}

TEST(SheetGround, FacetsAreFoundEverywhere)
{
    const PlanarMesh footprint = testing::discMeshes(0.1).front();
    CapillarySurface plane = drySheet(footprint, BaseSurface());
    for (Vec3& p : plane.vertices) {
        p.z = 0.5 * p.x - 2.0 * p.y + 1.0;
    }
    const FacetedGround facets(plane);
    std::size_t outside = 0;
    for (int k = 0; k < 4000; ++k) {
        const Vec2 place{std::fmod(0.7548776662 * k, 2.2) - 1.1, std::fmod(0.5698402910 * k, 2.2) - 1.1};
        const std::optional<double> height = facets.heightAt(place);
        EXPECT_TRUE(height || length(place) > 0.99) << place.x << ' ' << place.y;
        outside += height ? 0 : 1;
        EXPECT_NEAR(height.value_or(0.5 * place.x - 2.0 * place.y + 1.0), 0.5 * place.x - 2.0 * place.y + 1.0, 1e-12);
    }
    EXPECT_NEAR(static_cast<double>(outside) / 4000.0, 1.0 - kPi / (2.2 * 2.2), 0.02);
    for (const Vec3& p : plane.vertices) {
        EXPECT_NEAR(facets.heightAt({p.x, p.y}).value_or(9.0), p.z, 1e-12) << "vertices are inside";
    }
}

// Newton's method lays vertices down along normals, and so misses curved ground by rounding.
TEST(SheetGround, LiftLaysDownWhatIsAboveByRoundingAlone)
{
    const SheetBase base{BaseSurface::sphere(2.0)};
    std::vector<Vec3> vertices{{-1.0, 0.0, std::sqrt(3.0)}, {1.0, 0.0, std::sqrt(3.0)}, {0.1, 0.2, 0.0}, {}, {}};
    vertices[2].z = base.under(vertices[2]).height + 1e-15;
    vertices[3] = {0.3, 0.1, base.under({0.3, 0.1, 0.0}).height + 1e-6};
    vertices[4] = {0.3, 0.2, -1.0};
    const double above = vertices[3].z;
    base.lift(vertices, 2);
    EXPECT_EQ(base.clearance(vertices[2]), 0.0);
    EXPECT_EQ(vertices[3].z, above);
    EXPECT_EQ(base.clearance(vertices[4]), 0.0);
}

TEST(SheetGround, WorkIsLimitedWhereTheGroundIsTooSteep)
{
    SolveOptions options = testing::unitOptions(Model::Exact, 0.0, 1.0);
    options.ground = steepGround();
    options.max_work = 1e5;
    const SheetResult result = solveSheet(testing::discMeshes(0.1).front(), options);
    EXPECT_EQ(result.end, SheetEnd::OutOfWork);
    EXPECT_EQ(result.volume, 0.0);
    EXPECT_LE(result.work, 1.5 * *options.max_work);
    EXPECT_LE(result.surface.triangles.size(), trianglesFor(kSheetUnits * *options.max_work, 1.0));
}

TEST(SheetGround, WorkOfTheOptionsIsItsLimit)
{
    SolveOptions options = testing::unitOptions(Model::Exact, 0.0, 4.0);
    const std::vector<PlanarMesh> meshes = testing::discMeshes(0.1);
    const SheetResult whole = solveSheet(meshes.front(), options);
    EXPECT_EQ(whole.end, SheetEnd::Reached);
    options.max_work = 0.3 * whole.work;
    const SheetResult cut = solveSheet(meshes.front(), options);
    EXPECT_EQ(cut.end, SheetEnd::OutOfWork);
    EXPECT_GT(cut.volume, 0.0);
    EXPECT_LT(cut.volume, whole.volume);
    EXPECT_LT(cut.work, whole.work);
}

}  // namespace
}  // namespace droplet
