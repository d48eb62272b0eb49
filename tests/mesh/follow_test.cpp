// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mesh/follow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/solve.h"
#include "droplet/units.h"
#include "support/domains.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::polygonLoop;
using testing::reversed;

constexpr double kPi = std::numbers::pi;

Loop mapped(Loop loop, const std::function<Vec2(Vec2)>& map)
{
    for (Vec2& p : loop.points) {
        p = map(p);
    }
    return loop;
}

Footprint mapped(Footprint footprint, const std::function<Vec2(Vec2)>& map)
{
    footprint.rim = mapped(std::move(footprint.rim), map);
    for (Loop& hole : footprint.holes) {
        hole = mapped(std::move(hole), map);
    }
    return footprint;
}

/// The same loop with another first point.
Loop withOtherStart(Loop loop, std::size_t by)
{
    const auto n = static_cast<std::ptrdiff_t>(by);
    std::rotate(loop.points.begin(), loop.points.begin() + n, loop.points.end());
    std::rotate(loop.corner.begin(), loop.corner.begin() + n, loop.corner.end());
    return loop;
}

PlanarMesh meshOf(const Footprint& footprint, std::size_t triangles = 1500)
{
    return triangulate(domainOf(footprint.rim, footprint.holes), {.triangles = triangles, .edge = {}}).at(0);
}

double largestMove(const PlanarMesh& a, const PlanarMesh& b, Vec2 by)
{
    double max = 0.0;
    for (std::size_t v = 0; v < a.vertices.size(); ++v) {
        max = std::max(max, length(b.vertices[v] - a.vertices[v] - by));
    }
    return max;
}

std::vector<Footprint> simpleFootprints()
{
    return {domainOf(ellipseLoop(1, 1)).droplets[0], domainOf(ellipseLoop(1, 0.5)).droplets[0],
            domainOf(ellipseLoop(1, 1), {reversed(ellipseLoop(0.3, 0.6))}).droplets[0],
            domainOf(polygonLoop({{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}})).droplets[0]};
}

TEST(Follow, StaysWhereTheFootprintStays)
{
    for (const Footprint& footprint : simpleFootprints()) {
        const PlanarMesh mesh = meshOf(footprint);
        const auto moved = follow(mesh, mesh, footprint);
        ASSERT_TRUE(moved);
        EXPECT_NO_THROW(moved->validate());
        EXPECT_LT(largestMove(mesh, *moved, {}), 2e-3);
    }
}

TEST(Follow, TranslatesWithTheFootprintWhereverItsLoopBegins)
{
    for (const Footprint& footprint : simpleFootprints()) {
        const PlanarMesh mesh = meshOf(footprint);
        const Vec2 by{0.7, -1.3};
        Footprint there = mapped(footprint, [&](Vec2 p) { return p + by; });
        there.rim = withOtherStart(there.rim, there.rim.points.size() / 3);
        const auto moved = follow(mesh, mesh, there);
        ASSERT_TRUE(moved);
        EXPECT_EQ(moved->triangles, mesh.triangles);
        EXPECT_LT(largestMove(mesh, *moved, by), 2e-3);
        EXPECT_NEAR(area(*moved), area(there), 1e-9);
    }
}

TEST(Follow, CornersGetAVertex)
{
    const Footprint l = simpleFootprints()[3];
    const PlanarMesh mesh = meshOf(l);
    const Footprint there = mapped(l, [](Vec2 p) { return Vec2{1.1 * p.x + 0.1 * p.y, 0.95 * p.y}; });
    const auto moved = follow(mesh, mesh, there);
    ASSERT_TRUE(moved);
    for (std::size_t i = 0; i < there.rim.points.size(); ++i) {
        if (there.rim.corner[i] != 0) {
            const bool found = std::any_of(moved->vertices.begin(), moved->vertices.begin() + moved->rimVertexCount(),
                                           [&](Vec2 p) { return length(p - there.rim.points[i]) < 1e-12; });
            EXPECT_TRUE(found);
        }
    }
    EXPECT_NEAR(area(*moved), area(there), 1e-6);
}

/// Square of side 2 whose corners are arcs.
Footprint roundedSquare(double radius)
{
    std::vector<Vec2> points;
    for (int corner = 0; corner < 4; ++corner) {
        const double begin = 0.5 * kPi * corner;
        const Vec2 away{std::cos(begin + 0.25 * kPi), std::sin(begin + 0.25 * kPi)};
        const Vec2 middle = (std::sqrt(2.0) * (1.0 - radius)) * away;
        constexpr int kPieces = 32;
        for (int k = 0; k <= kPieces; ++k) {
            const double angle = begin + 0.5 * kPi * k / kPieces;
            points.push_back(middle + radius * Vec2{std::cos(angle), std::sin(angle)});
        }
    }
    return domainOf(testing::smoothLoop(std::move(points))).droplets[0];
}

TEST(Follow, FollowsCornersThatBecomeRoundAndSharp)
{
    // The footprint of letters that begin to flow: arcs much smaller than an edge, which are no corners any more.
    const Footprint square = domainOf(polygonLoop({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})).droplets[0];
    const PlanarMesh first = meshOf(square);
    PlanarMesh last = first;
    const auto follow_to = [&](const Footprint& there) {
        const auto moved = follow(first, last, there);
        ASSERT_TRUE(moved);
        EXPECT_NO_THROW(moved->validate());
        EXPECT_GE(minAngle(*moved), std::min(15 * kDegree, 0.75 * minAngle(first)));
        EXPECT_NEAR(area(*moved), area(there), 1e-4);
        last = *moved;
    };
    for (const double radius : {0.01, 0.02, 0.04, 0.08, 0.15, 0.08, 0.04, 0.02, 0.01}) {
        SCOPED_TRACE(radius);
        follow_to(roundedSquare(radius));
    }
    follow_to(square);
}

// The only corner becomes round, and one appears on the other side of the disc, or a quarter away.
TEST(Follow, DoesNotTurnWhereACornerAppearsElsewhere)
{
    constexpr std::size_t kPoints = 400;
    const auto drop = [](double tip) {
        Loop loop;
        for (std::size_t k = 0; k < kPoints; ++k) {
            const double angle = 2.0 * kPi * static_cast<double>(k) / kPoints;
            const double away = std::abs(std::remainder(angle - tip, 2.0 * kPi));
            const double radius = 1.0 + std::max(0.02 - 0.2 * away, 0.0);
            loop.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
            loop.corner.push_back(away < 1e-9 ? 1 : 0);
        }
        return loop;
    };
    const PlanarMesh first = meshOf(domainOf(drop(0.0)).droplets[0]);
    for (const double tip : {0.5 * kPi, kPi, 1.5 * kPi}) {
        SCOPED_TRACE(tip);
        const auto moved = follow(first, first, domainOf(drop(tip)).droplets[0]);
        ASSERT_TRUE(moved);
        EXPECT_LT(largestMove(first, *moved, {}), 0.1);
    }
}

TEST(Follow, FollowsAShrinkingHoleWithoutDrift)
{
    const auto ring = [](double hole) {
        return domainOf(ellipseLoop(1, 1), {mapped(reversed(ellipseLoop(hole, hole)),
                                                   [](Vec2 p) {
                                                       return p + Vec2{0.1, 0.05};
                                                   })})
            .droplets[0];
    };
    const PlanarMesh first = meshOf(ring(0.5));
    PlanarMesh last = first;
    for (const double hole : {0.47, 0.44, 0.41, 0.38, 0.35}) {
        const auto moved = follow(first, last, ring(hole));
        ASSERT_TRUE(moved) << hole;
        EXPECT_NO_THROW(moved->validate());
        EXPECT_NEAR(area(*moved), kPi * (1 - hole * hole), 1e-6);
        last = *moved;
    }
    for (const double hole : {0.38, 0.41, 0.44, 0.47, 0.5}) {
        const auto moved = follow(first, last, ring(hole));
        ASSERT_TRUE(moved) << hole;
        last = *moved;
    }
    EXPECT_LT(largestMove(first, last, {}), 0.01);
}

TEST(Follow, HeightsMatchThoseOfANewMesh)
{
    const Footprint disc = domainOf(ellipseLoop(1, 1)).droplets[0];
    const Footprint ellipse = domainOf(ellipseLoop(1.15, 0.9)).droplets[0];
    // −σΔu = λ on an ellipse: u = λ/(2σ)·(1 − x²/a² − y²/b²)·a²b²/(a² + b²), of volume πab/2 of its height.
    SolveOptions options;
    options.gravity = 0.0;
    options.fill = {FillBy::Volume, 0.1};
    const double height = 2.0 * 0.1 / (kPi * 1.15 * 0.9);
    double before = 0.0;
    for (const std::size_t triangles : {800U, 3200U}) {
        const PlanarMesh mesh = meshOf(disc, triangles);
        const auto moved = follow(mesh, mesh, ellipse);
        ASSERT_TRUE(moved);
        const auto error = [&](const PlanarMesh& on) {
            const ShapeFigures figures = measure(solve({on}, options).droplets.at(0), options);
            return std::abs(figures.height_max / height - 1.0);
        };
        const double fresh = error(meshOf(ellipse, triangles));
        const double followed = error(*moved);
        EXPECT_LT(followed, 3.0 * fresh + 1e-4);
        EXPECT_LT(followed, 16.0 / static_cast<double>(triangles));
        if (before > 0.0) {
            EXPECT_LT(followed, 0.5 * before);
        }
        before = followed;
    }
}

TEST(Follow, RealOutlinesAreFollowedInSmallSteps)
{
    const auto at = [](double turn) {
        return split(trace(testing::smoothMask(240, 240,
                                               [=](Vec2 p) {
                                                   const Vec2 d = p - Vec2{120.3, 119.6};
                                                   const double a = std::atan2(d.y, d.x) + turn;
                                                   return length(d) < 80 + 10 * std::cos(3 * a);
                                               })))
            .droplets[0];
    };
    const PlanarMesh first = meshOf(at(0.0), 3000);
    PlanarMesh last = first;
    for (const double turn : {0.05, 0.1, 0.15, 0.2}) {
        const auto moved = follow(first, last, at(turn));
        ASSERT_TRUE(moved) << turn;
        EXPECT_NO_THROW(moved->validate());
        EXPECT_GT(minAngle(*moved), 15 * kDegree);
        EXPECT_NEAR(area(*moved) / area(at(turn)), 1.0, 1e-6);
        last = *moved;
    }
}

TEST(Follow, ReturnsNoMeshIfItWouldBeBad)
{
    const Footprint disc = domainOf(ellipseLoop(1, 1)).droplets[0];
    const PlanarMesh mesh = meshOf(disc);
    EXPECT_FALSE(follow(mesh, mesh, domainOf(ellipseLoop(2, 2)).droplets[0])) << "too large";
    EXPECT_FALSE(follow(mesh, mesh, domainOf(ellipseLoop(4, 0.25)).droplets[0])) << "too thin";
    EXPECT_FALSE(follow(mesh, mesh, simpleFootprints()[2])) << "another topology";
    const auto toothed = testing::smoothLoop([] {
        std::vector<Vec2> points;
        for (int k = 0; k < 4000; ++k) {
            const double a = 2 * kPi * k / 4000;
            const double r = 1 + 0.05 * std::cos(100 * a);
            points.push_back({r * std::cos(a), r * std::sin(a)});
        }
        return points;
    }());
    EXPECT_FALSE(follow(mesh, mesh, domainOf(toothed).droplets[0])) << "more detail than the rim can follow";
    EXPECT_THROW(follow(mesh, meshOf(disc, 500), disc), Error);
}

TEST(WithRim, MovesAffinelyIfTheRimDoes)
{
    for (const Footprint& footprint : simpleFootprints()) {
        const PlanarMesh mesh = meshOf(footprint);
        const auto map = [](Vec2 p) { return Vec2{1.2 * p.x - 0.4 * p.y + 3, 0.3 * p.x + 0.7 * p.y}; };
        std::vector<Vec2> rim;
        for (std::uint32_t v = 0; v < mesh.rimVertexCount(); ++v) {
            rim.push_back(map(mesh.vertices[v]));
        }
        const PlanarMesh moved = moveRim(mesh, rim).value();
        const PlanarMesh base = moveRim(cover(mesh), rim).value();
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            EXPECT_LT(length(moved.vertices[v] - map(mesh.vertices[v])), 1e-12);
        }
        EXPECT_NEAR(area(base), area(moved), 1e-12);
        EXPECT_THROW((void)moveRim(mesh, {}), Error);
    }
}

/// A star whose tips and bays become one another.
std::vector<Vec2> star(std::size_t count, double depth)
{
    std::vector<Vec2> points;
    points.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double angle = 2.0 * kPi * static_cast<double>(k) / static_cast<double>(count);
        const double radius = 1.0 + depth * std::cos(0.5 * static_cast<double>(count) * angle);
        points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return points;
}

TEST(MovableCover, FollowsARimWhoseCornersBendTheOtherWay)
{
    constexpr std::size_t kCorners = 24;
    PlanarMesh rim;
    rim.vertices = star(kCorners, 0.1);
    rim.loop_starts = {0, kCorners};
    EXPECT_FALSE(moveRim(cover(rim), star(kCorners, -0.1)));
    const PlanarMesh ground = movableCover(rim);
    const auto moved = moveRim(ground, star(kCorners, -0.1));
    ASSERT_TRUE(moved);
    EXPECT_EQ(moved->triangles, ground.triangles);
    for (const Triangle& t : moved->triangles) {
        EXPECT_GT(doubleArea(*moved, t), 0.0);
    }
}

}  // namespace
}  // namespace droplet
