// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheets whose rims move, against sheets that are solved anew, and against spherical caps.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "droplet/error.h"
#include "droplet/mesh/follow.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/shape/sheet.h"
#include "droplet/units.h"
#include "mesh/carry_points.h"
#include "support/domains.h"
#include "support/equilibrium.h"

namespace droplet {
namespace {

using testing::discMeshes;
using testing::domainOf;
using testing::ellipseLoop;
using testing::polygonLoop;
using testing::smoothLoop;

constexpr double kPi = std::numbers::pi;

/// σ = ρ = 1, so that gravity is ρg/σ.
SolveOptions optionsFor(double gravity, Fill fill)
{
    SolveOptions options;
    options.liquid = {"unit", 1.0, 1.0};
    options.gravity = gravity;
    options.model = Model::Exact;
    options.fill = fill;
    return options;
}

Fill angleOf(double angle)
{
    return {FillBy::ContactAngle, angle * kDegree, FillSharing::Each};
}

PlanarMesh moved(const PlanarMesh& mesh, const std::function<Vec2(Vec2)>& motion)
{
    std::vector<Vec2> rim;
    for (std::uint32_t v = 0; v < mesh.rimVertexCount(); ++v) {
        rim.push_back(motion(mesh.vertices[v]));
    }
    return moveRim(mesh, rim).value();
}

double energyOf(const CapillarySurface& sheet, const SolveOptions& options)
{
    const ShapeFigures figures = measure(sheet, options);
    return figures.surface_energy + figures.gravity_energy;
}

/// Largest distance of a sheet's vertices from where a motion brings those of another.
double gap(const CapillarySurface& from, const CapillarySurface& to, const std::function<Vec3(Vec3)>& motion)
{
    double largest = 0.0;
    for (std::size_t v = 0; v < from.vertices.size(); ++v) {
        largest = std::max(largest, length(to.vertices[v] - motion(from.vertices[v])));
    }
    return largest;
}

TEST(SheetFollow, ABeadOnAGrowingDiscIsACap)
{
    const double angle = 140.0 * kDegree;
    const SolveOptions options = optionsFor(0.0, angleOf(140.0));
    // The bead is four times as large as its footprint, and has as many triangles.
    const SheetResult first = solveSheet(discMeshes(0.035).front(), options);
    ASSERT_EQ(first.end, SheetEnd::Reached);
    CapillarySurface last = first.surface;
    double radius = 1.0;
    for (int frame = 1; frame <= 10; ++frame) {
        radius *= 1.01;
        const PlanarMesh footprint = moved(*first.surface.footprint, [&](Vec2 p) { return radius * p; });
        const SheetResult next = follow(first.surface, last, footprint, options);
        ASSERT_EQ(next.end, SheetEnd::Reached) << frame;
        EXPECT_EQ(next.surface.triangles, first.surface.triangles);
        last = next.surface;
    }
    const double ball = radius / std::sin(angle);
    const ShapeFigures figures = measure(last, options);
    EXPECT_NEAR(figures.contact_angle.mean, angle, 1e-8);
    EXPECT_NEAR(figures.height_max, ball * (1.0 - std::cos(angle)), 1e-3 * figures.height_max);
    EXPECT_NEAR(figures.liquid_area, 2.0 * kPi * ball * ball * (1.0 - std::cos(angle)), 5e-4 * figures.liquid_area);
    EXPECT_NEAR(last.pressure, 2.0 / ball, 6e-4 * last.pressure);
    // Without gravity all of it grows alike.
    EXPECT_LT(gap(first.surface, last, [&](Vec3 p) { return radius * p; }), 1e-8);
}

TEST(SheetFollow, APuddleOnAGrowingDiscIsAsSolvedAnew)
{
    SolveOptions options = optionsFor(2.0, {FillBy::Volume, 3.0, FillSharing::Each});
    const SheetResult first = solveSheet(discMeshes(0.05).front(), options);
    ASSERT_EQ(first.end, SheetEnd::Reached);
    CapillarySurface last = first.surface;
    double radius = 1.0;
    for (int frame = 1; frame <= 10; ++frame) {
        radius *= 1.01;
        options.fill.amount *= 1.02;
        const PlanarMesh footprint = moved(*first.surface.footprint, [&](Vec2 p) { return radius * p; });
        const SheetResult next = follow(first.surface, last, footprint, options);
        ASSERT_EQ(next.end, SheetEnd::Reached) << frame;
        EXPECT_NEAR(next.volume, options.fill.amount, 1e-10 * options.fill.amount);
        EXPECT_NEAR(measure(next.surface, options).volume, options.fill.amount, 1e-10 * options.fill.amount);
        last = next.surface;
    }
    EXPECT_EQ(last.triangles, first.surface.triangles);
    const SheetResult anew = solveSheet(*last.footprint, options);
    ASSERT_EQ(anew.end, SheetEnd::Reached);
    EXPECT_NEAR(energyOf(last, options), energyOf(anew.surface, options), 3e-4 * energyOf(anew.surface, options));
    EXPECT_NEAR(last.pressure, anew.surface.pressure, 1e-3 * anew.surface.pressure);
    EXPECT_NEAR(measure(last, options).contact_angle.mean, anew.contact_angle, 0.1 * kDegree);
}

TEST(SheetFollow, ABeadThatMovesKeepsItsShape)
{
    // On a slope, the pressure at the origin changes with the place.
    SolveOptions options = optionsFor(0.5, angleOf(120.0));
    options.tilt = 20.0 * kDegree;
    const SheetResult first = solveSheet(discMeshes(0.1).front(), options);
    ASSERT_EQ(first.end, SheetEnd::Reached);
    const Vec2 way{0.08, -0.06};
    const SheetResult next =
        follow(first.surface, first.surface, moved(*first.surface.footprint, [&](Vec2 p) { return p + way; }), options);
    ASSERT_EQ(next.end, SheetEnd::Reached);
    EXPECT_LT(gap(first.surface, next.surface, [&](Vec3 p) { return p + Vec3{way.x, way.y, 0.0}; }), 1e-9);
    EXPECT_NEAR(next.volume, first.volume, 1e-9 * first.volume);
    EXPECT_NE(next.surface.pressure, first.surface.pressure);
}

TEST(SheetFollow, AnEllipseThatTurnsIsAsSolvedAnew)
{
    const SolveOptions options = optionsFor(1.0, angleOf(115.0));
    const Footprint ellipse{ellipseLoop(1.3, 0.8), {}};
    const PlanarMesh start = triangulate({{ellipse}, {}}, {.edge = 0.07}).front();
    const SheetResult first = solveSheet(start, options);
    ASSERT_EQ(first.end, SheetEnd::Reached);
    // Rim vertices go to the nearest place on the turned ellipse: they do not turn with it.
    PlanarMesh mesh = start;
    CapillarySurface last = first.surface;
    for (int frame = 1; frame <= 8; ++frame) {
        const double turn = 5.0 * kDegree * frame;
        std::vector<Vec2> points;
        for (const Vec2 p : ellipse.rim.points) {
            points.push_back(
                {std::cos(turn) * p.x - std::sin(turn) * p.y, std::sin(turn) * p.x + std::cos(turn) * p.y});
        }
        const std::optional<PlanarMesh> footprint = follow(start, mesh, {smoothLoop(points), {}});
        ASSERT_TRUE(footprint);
        mesh = *footprint;
        const SheetResult next = follow(first.surface, last, mesh, options);
        ASSERT_EQ(next.end, SheetEnd::Reached) << frame;
        EXPECT_EQ(next.surface.triangles, first.surface.triangles);
        EXPECT_NEAR(measure(next.surface, options).contact_angle.mean, 115.0 * kDegree, 1e-8);
        EXPECT_NEAR(energyOf(next.surface, options), energyOf(first.surface, options),
                    1e-3 * energyOf(first.surface, options))
            << frame;
        EXPECT_NEAR(next.surface.pressure, first.surface.pressure, 1e-3 * first.surface.pressure) << frame;
        last = next.surface;
    }
}

TEST(SheetFollow, ABeadThatTurnsAtOnceKeepsItsShape)
{
    const SolveOptions options = optionsFor(1.0, angleOf(115.0));
    const SheetResult first = solveSheet(triangulate(domainOf(ellipseLoop(1.3, 0.8)), {.edge = 0.1}).front(), options);
    ASSERT_EQ(first.end, SheetEnd::Reached);
    const double c = std::cos(15.0 * kDegree);
    const double s = std::sin(15.0 * kDegree);
    const PlanarMesh footprint = moved(*first.surface.footprint, [=](Vec2 p) {
        return Vec2{c * p.x - s * p.y, s * p.x + c * p.y};
    });
    const SheetResult next = follow(first.surface, first.surface, footprint, options);
    ASSERT_EQ(next.end, SheetEnd::Reached);
    EXPECT_LT(gap(first.surface, next.surface,
                  [=](Vec3 p) {
                      return Vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
                  }),
              1e-8);
}

TEST(SheetFollow, RoundedInnerCornersMoveAlong)
{
    const PlanarMesh el =
        triangulate(domainOf(polygonLoop({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}})), {.edge = 0.15}).front();
    const SolveOptions options = optionsFor(0.0, angleOf(60.0));
    const SheetResult first = solveSheet(el, options);
    ASSERT_EQ(first.end, SheetEnd::Reached);
    ASSERT_NE(first.surface.footprint->rimVertexCount(), el.rimVertexCount());
    const auto bent = [](Vec2 p) { return Vec2{1.02 * p.x + 0.01 * p.y * p.y, p.y + 0.03 * p.x}; };
    const PlanarMesh after = moved(el, bent);
    std::vector<Vec2> points(first.surface.footprint->vertices.begin(),
                             first.surface.footprint->vertices.begin() + first.surface.footprint->rimVertexCount());
    const PlanarMesh footprint = moveRim(*first.surface.footprint, carryPoints(el, after, points)).value();
    EXPECT_NEAR(area(footprint) / area(after), area(*first.surface.footprint) / area(el), 1e-4);
    const SheetResult next = follow(first.surface, first.surface, footprint, options);
    ASSERT_EQ(next.end, SheetEnd::Reached);
    const SheetResult anew = solveSheet(after, options);
    ASSERT_EQ(anew.end, SheetEnd::Reached);
    EXPECT_NEAR(next.volume, anew.volume, 5e-3 * anew.volume);
    EXPECT_NEAR(next.surface.pressure, anew.surface.pressure, 5e-3 * anew.surface.pressure);
}

// solveSheet() would round the corner of the dent.
TEST(SheetFollow, FollowsARimThatGetsAnInnerCorner)
{
    for (const double angle : {60.0, 100.0, 120.0}) {
        SCOPED_TRACE(angle);
        const SolveOptions options = optionsFor(0.0, angleOf(angle));
        const PlanarMesh disc = discMeshes(0.1).front();
        const SheetResult first = solveSheet(disc, options);
        ASSERT_EQ(first.end, SheetEnd::Reached);
        const auto dent = [](Vec2 p) { return p.x > 0.0 ? Vec2{p.x * (0.6 + 0.4 * std::abs(p.y)), p.y} : p; };
        const SheetResult next = follow(first.surface, first.surface, moved(*first.surface.footprint, dent), options);
        ASSERT_EQ(next.end, SheetEnd::Reached);
        const SheetResult anew = solveSheet(moved(disc, dent), options);
        ASSERT_EQ(anew.end, SheetEnd::Reached);
        EXPECT_NEAR(next.volume, anew.volume, 0.01 * anew.volume);
        EXPECT_NEAR(next.surface.pressure, anew.surface.pressure, 0.01 * anew.surface.pressure);
    }
}

TEST(SheetFollow, TellsWhatItCannotFollow)
{
    const SolveOptions options = optionsFor(0.0, angleOf(120.0));
    const SheetResult first = solveSheet(discMeshes(0.15).front(), options);
    ASSERT_EQ(first.end, SheetEnd::Reached);
    const CapillarySurface& sheet = first.surface;
    const auto endOf = [&](const std::function<Vec2(Vec2)>& motion) {
        return follow(sheet, sheet, moved(*sheet.footprint, motion), options).end;
    };
    EXPECT_EQ(endOf([](Vec2 p) { return 1.2 * p; }), SheetEnd::Reached);
    EXPECT_NE(endOf([](Vec2 p) { return 1.6 * p; }), SheetEnd::Reached) << "triangles would be too large";
    EXPECT_NE(endOf([](Vec2 p) { return Vec2{4.0 * p.x, 0.25 * p.y}; }), SheetEnd::Reached) << "triangles are worn";
    PlanarMesh other = discMeshes(0.1).front();
    EXPECT_THROW((void)follow(sheet, sheet, other, options), Error);
}

TEST(SheetFollow, GivesTheSameBitsAtAnyNumberOfThreads)
{
    const SolveOptions options = optionsFor(1.0, angleOf(120.0));
    const SheetResult first = solveSheet(discMeshes(0.1).front(), options);
    const PlanarMesh footprint = moved(*first.surface.footprint, [](Vec2 p) { return Vec2{1.04 * p.x, 0.98 * p.y}; });
    std::vector<SheetResult> results;
    for (const std::size_t threads : {1U, 2U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        results.push_back(follow(first.surface, first.surface, footprint, options));
    }
    ASSERT_EQ(results.front().end, SheetEnd::Reached);
    EXPECT_EQ(results[0].surface.vertices, results[1].surface.vertices);
    EXPECT_EQ(results[0].surface.pressure, results[1].surface.pressure);
}

TEST(CarryPoints, FollowTheWholeRim)
{
    const PlanarMesh mesh = discMeshes(0.2).front();
    const auto motion = [](Vec2 p) { return Vec2{0.3 + 1.1 * p.x - 0.4 * p.y, -0.2 + 0.4 * p.x + 1.1 * p.y}; };
    const std::vector<Vec2> points{{0.9, 0.3}, {1.1, 0.0}, mesh.vertices[3], {0.0, -1.0}};
    const std::vector<Vec2> carried = carryPoints(mesh, moved(mesh, motion), points);
    for (std::size_t k = 0; k < points.size(); ++k) {
        EXPECT_LT(length(carried[k] - motion(points[k])), 1e-12);
    }
}

}  // namespace
}  // namespace droplet
