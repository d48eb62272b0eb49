// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/glass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "droplet/error.h"
#include "support/objects.h"

namespace droplet {
namespace {

using testing::meshOf;
using testing::Sheet;
using testing::together;

constexpr double kGravity = 9.81;

/// Vector of the vehicle's frame, y ahead, in the object's frame, which drives towards −y.
Vec3 turnedRound(Vec3 a)
{
    return {-a.x, -a.y, a.z};
}

/// Mesh of a cylinder, with its texture seen from outside or from inside.
TexturedMesh objectOf(const Glass::Cylinder& form, std::uint32_t columns, bool from_outside)
{
    const Glass glass(form);
    const auto place = [form, from_outside, glass](Vec2 uv) {
        const double x = form.width * std::clamp(from_outside ? 1.0 - uv.x : uv.x, 0.0, 1.0);
        return glass.place({x, std::clamp(form.height - form.width * uv.y, 0.0, form.height)}).value();
    };
    Sheet sheet;
    sheet.columns = columns;
    sheet.rows = 3;
    sheet.uv_end = {1.0, form.height / form.width};
    sheet.place = [place](Vec2 uv) { return turnedRound(place(uv).point); };
    sheet.normal = [place](Vec2 uv) { return turnedRound(place(uv).normal); };
    sheet.turned = !from_outside;
    return meshOf(sheet);
}

TEST(CurvedGlass, IsUnrolledWithoutStretching)
{
    const Glass glass(Glass::Cylinder{});
    EXPECT_EQ(glass.width(), 1.4);
    EXPECT_EQ(glass.height(), 0.8);
    constexpr double kStep = 1e-6;
    for (double x = 0.05; x < 1.4; x += 0.13) {
        for (double y = 0.05; y < 0.8; y += 0.2) {
            const GlassPlace here = glass.place({x, y}).value();
            EXPECT_NEAR(length(here.normal), 1.0, 1e-15);
            EXPECT_NEAR(length(here.across), 1.0, 1e-15);
            EXPECT_NEAR(length(here.up), 1.0, 1e-15);
            // Seen from inside: across, up and inward are right-handed.
            EXPECT_NEAR(length(cross(here.across, here.up) + here.normal), 0.0, 1e-15);
            const auto slope = [&](Vec2 d) {
                return 0.5 / kStep *
                       (glass.place(Vec2{x, y} + kStep * d)->point - glass.place(Vec2{x, y} - kStep * d)->point);
            };
            EXPECT_NEAR(length(slope({1.0, 0.0}) - here.across), 0.0, 1e-9);
            EXPECT_NEAR(length(slope({0.0, 1.0}) - here.up), 0.0, 1e-9);
        }
    }
}

TEST(CurvedGlass, LiesInTheVehiclesFrame)
{
    const Glass glass(Glass::Cylinder{.slope = 30.0 * kDegree});
    const GlassPlace foot = glass.place({0.7, 0.0}).value();
    EXPECT_NEAR(length(foot.point), 0.0, 1e-15);
    EXPECT_NEAR(foot.normal.y, 0.5, 1e-15);  // ahead
    EXPECT_NEAR(foot.normal.z, std::cos(30.0 * kDegree), 1e-15);
    const GlassPlace top = glass.place({0.7, 0.8}).value();
    EXPECT_NEAR(top.point.z, 0.4, 1e-15);
    EXPECT_LT(top.point.y, 0.0);  // it leans back
    EXPECT_GT(glass.place({1.4, 0.4})->point.x, 0.69);
    // Every point is 5 m from the cylinder's axis.
    const Vec3 centre = -5.0 * foot.normal;
    for (const double x : {0.0, 0.2, 1.4}) {
        const Vec3 out = glass.place({x, 0.0})->point - centre;
        EXPECT_NEAR(length(out), 5.0, 1e-14);
    }
}

TEST(CurvedGlass, GravityAndWindPushSidewaysOnTheCurve)
{
    const Glass glass(Glass::Cylinder{});
    const double u = 12.0;
    const GlassPlace middle = glass.place({0.7, 0.3}).value();
    EXPECT_NEAR(gravityAlong(middle, kGravity).x, 0.0, 1e-15);
    EXPECT_NEAR(gravityAlong(middle, kGravity).y, -kGravity * std::sqrt(0.5), 1e-14);
    EXPECT_NEAR(windAlong(middle, u, WindAlongGlass::Projected).y, u * std::sqrt(0.5), 1e-14);
    EXPECT_NEAR(windAlong(middle, u, WindAlongGlass::Turned).y, u, 1e-14);
    const GlassPlace right = glass.place({1.2, 0.3}).value();
    const GlassPlace left = glass.place({0.2, 0.3}).value();
    using Push = Vec2 (*)(const GlassPlace&);
    for (const Push push : {Push{[](const GlassPlace& p) { return gravityAlong(p, kGravity); }},
                            Push{[](const GlassPlace& p) { return windAlong(p, 12.0, WindAlongGlass::Turned); }},
                            Push{[](const GlassPlace& p) { return windAlong(p, 12.0, WindAlongGlass::Projected); }}}) {
        EXPECT_GT(push(right).x, 0.0);
        EXPECT_NEAR(push(left).x, -push(right).x, 1e-12);
        EXPECT_NEAR(push(left).y, push(right).y, 1e-12);
    }
    // The tangential and the normal component add up to the vector.
    EXPECT_NEAR(std::hypot(length(gravityAlong(right, kGravity)), kGravity * right.normal.z), kGravity, 1e-13);
    EXPECT_NEAR(std::hypot(length(windAlong(right, u, WindAlongGlass::Projected)), u * right.normal.y), u, 1e-13);
    EXPECT_NEAR(length(windAlong(right, u, WindAlongGlass::Turned)), u, 1e-13);
}

TEST(CurvedGlass, PerpendicularWindVanishes)
{
    const Glass wall(Glass::Cylinder{.slope = 0.5 * std::numbers::pi});
    const GlassPlace place = wall.place({0.7, 0.4}).value();
    for (const WindAlongGlass how : {WindAlongGlass::Turned, WindAlongGlass::Projected}) {
        EXPECT_NEAR(length(windAlong(place, 20.0, how)), 0.0, 1e-13);
    }
    EXPECT_EQ(windAlong(Glass().place({0.1, 0.1}).value(), 0.0, WindAlongGlass::Turned), Vec2{});
}

TEST(CurvedGlass, CanBeFlat)
{
    const Glass flat(Glass::Cylinder{.radius = std::numeric_limits<double>::infinity()});
    const Glass nearly(Glass::Cylinder{.radius = 1e8});
    for (const Vec2 p : {Vec2{0.0, 0.0}, Vec2{1.3, 0.7}}) {
        EXPECT_NEAR(length(flat.place(p)->point - nearly.place(p)->point), 0.0, 1e-8);
        EXPECT_NEAR(length(flat.place(p)->normal - nearly.place(p)->normal), 0.0, 1e-8);
    }
}

TEST(CurvedGlass, EndsAtItsEdges)
{
    const Glass glass;
    EXPECT_TRUE(glass.holds({0.0, 0.8}));
    for (const Vec2 p : {Vec2{-1e-9, 0.4}, Vec2{1.41, 0.4}, Vec2{0.7, -1e-9}, Vec2{0.7, 0.81},
                         Vec2{std::numeric_limits<double>::quiet_NaN(), 0.4}}) {
        EXPECT_FALSE(glass.holds(p));
        EXPECT_FALSE(glass.place(p));
    }
}

TEST(CurvedGlass, RejectsInvalidCylinders)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(Glass(Glass::Cylinder{.width = 0.0}), Error);
    EXPECT_THROW(Glass(Glass::Cylinder{.width = 16.0}), Error);  // more than half way round
    EXPECT_THROW(Glass(Glass::Cylinder{.height = -1.0}), Error);
    EXPECT_THROW(Glass(Glass::Cylinder{.radius = 0.0}), Error);
    EXPECT_THROW(Glass(Glass::Cylinder{.radius = nan}), Error);
    EXPECT_THROW(Glass(Glass::Cylinder{.slope = 1.6}), Error);
    EXPECT_THROW(Glass(Glass::Cylinder{.slope = nan}), Error);
}

/// Largest distances between places of a mesh and of its cylinder.
struct Misses {
    double point = 0.0;
    double normal = 0.0;
    double across = 0.0;
    double up = 0.0;
};

Misses missesOf(const Glass& mesh, const Glass& cylinder)
{
    Misses max;
    for (double x = 0.011; x < cylinder.width(); x += 0.017) {
        for (double y = 0.013; y < cylinder.height(); y += 0.041) {
            const GlassPlace a = mesh.place({x, y}).value();
            const GlassPlace b = cylinder.place({x, y}).value();
            max.point = std::max(max.point, length(a.point - b.point));
            max.normal = std::max(max.normal, length(a.normal - b.normal));
            max.across = std::max(max.across, length(a.across - b.across));
            max.up = std::max(max.up, length(a.up - b.up));
        }
    }
    return max;
}

class MeshedGlass : public ::testing::TestWithParam<bool> {};

// The error of chords is of second order in their length. That of interpolated unit normals is of third order: they are
// exact at the middle of a chord.
TEST_P(MeshedGlass, ConvergesToItsCylinder)
{
    const Glass::Cylinder form{.width = 1.4, .height = 0.8, .radius = 2.0, .slope = 35.0 * kDegree};
    const Glass cylinder(form);
    const Glass coarse(objectOf(form, 16, GetParam()), {.scale = form.width});
    const Glass fine(objectOf(form, 32, GetParam()), {.scale = form.width});
    EXPECT_NEAR(fine.width(), 1.4, 1e-12);
    EXPECT_NEAR(fine.height(), 0.8, 1e-12);
    const Misses a = missesOf(coarse, cylinder);
    const Misses b = missesOf(fine, cylinder);
    EXPECT_NEAR(a.point / b.point, 4.0, 0.4);
    EXPECT_NEAR(a.normal / b.normal, 8.0, 0.5);
    EXPECT_LT(b.point, 2e-4);
    EXPECT_LT(b.normal, 1e-4);
    EXPECT_LT(b.across, 1e-3);
    EXPECT_LT(b.up, 1e-3);
    EXPECT_NEAR(fine.maxStretch(), 1.0, 1e-3);
    EXPECT_NEAR(fine.minStretch(), 1.0, 1e-3);
}

TEST_P(MeshedGlass, HasItsOwnSizeWithoutAScale)
{
    const Glass::Cylinder form{.width = 1.2, .height = 0.6};
    const Glass glass(objectOf(form, 16, GetParam()), {});
    EXPECT_NEAR(glass.width(), 1.2, 1e-3);
    EXPECT_NEAR(glass.height(), 0.6, 1e-3);
    EXPECT_FALSE(glass.cylinder());
}

/// Triangles cover the unrolled glass once, counter-clockwise, and have the places of the glass.
void expectTriangles(const Glass& glass, std::size_t count)
{
    const std::vector<GlassTriangle> triangles = glass.triangles();
    EXPECT_EQ(triangles.size(), count);
    double area = 0.0;
    for (const auto& [p, places] : triangles) {
        const double own = 0.5 * cross(p[1] - p[0], p[2] - p[0]);
        EXPECT_GT(own, 0.0);
        area += own;
        for (std::size_t k = 0; k < 3; ++k) {
            // A little inside, since neighbours may have other tangents.
            const Vec2 inside = p[k] + 1e-6 * (p[0] + p[1] + p[2] - 3.0 * p[k]);
            const GlassPlace here = glass.place(inside).value();
            EXPECT_NEAR(length(here.point - places[k].point), 0.0, 1e-5);
            EXPECT_NEAR(length(here.normal - places[k].normal), 0.0, 1e-5);
            EXPECT_NEAR(length(here.across - places[k].across), 0.0, 1e-5);
            EXPECT_NEAR(length(here.up - places[k].up), 0.0, 1e-5);
        }
    }
    EXPECT_NEAR(area, glass.width() * glass.height(), 1e-9);
}

TEST_P(MeshedGlass, GivesItsTriangles)
{
    const Glass::Cylinder form{.width = 1.2, .height = 0.6, .radius = 1.0};
    const TexturedMesh object = objectOf(form, 16, GetParam());
    expectTriangles(Glass(object, {}), object.triangles.size());
}

TEST(CurvedGlass, GivesTrianglesNearTheArc)
{
    const Glass glass;
    expectTriangles(glass, glass.triangles().size());
    for (const auto& [p, places] : glass.triangles()) {
        const GlassPlace middle = glass.place(0.5 * (p[0] + p[1])).value();
        EXPECT_NEAR(length(0.5 * (places[0].point + places[1].point) - middle.point), 0.0, 2e-5);
    }
}

INSTANTIATE_TEST_SUITE_P(SeenFrom, MeshedGlass, ::testing::Bool());

/// Flat sheet of 1 m by 1 m at 45° with a stretched texture; it faces ahead (−y) and up.
Sheet leaning(Vec2 drawn_out = {1.0, 1.0})
{
    Sheet sheet;
    sheet.place = [drawn_out](Vec2 uv) {
        const double up = (1.0 - uv.y) * drawn_out.y * std::sqrt(0.5);
        return Vec3{uv.x * drawn_out.x, up, up};
    };
    sheet.normal = [](Vec2) { return Vec3{0.0, -std::sqrt(0.5), std::sqrt(0.5)}; };
    return sheet;
}

TEST(MeshedGlass, ReportsItsStretch)
{
    const Glass glass(meshOf(leaning({1.0, 0.5})), {.scale = 1.0});
    EXPECT_NEAR(glass.maxStretch(), 1.0, 1e-12);
    EXPECT_NEAR(glass.minStretch(), 0.5, 1e-12);
    // Directions follow the nearest isometry, here the axes.
    const GlassPlace place = glass.place({0.3, 0.6}).value();
    EXPECT_NEAR(gravityAlong(place, kGravity).y, -kGravity * std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(gravityAlong(place, kGravity).x, 0.0, 1e-12);
}

TEST(MeshedGlass, FacesTheDrivingDirection)
{
    const TexturedMesh object = meshOf(leaning());
    const GlassPlace ahead = Glass(object, {}).place({0.5, 0.5}).value();
    EXPECT_NEAR(windAlong(ahead, 10.0, WindAlongGlass::Projected).y, 10.0 * std::sqrt(0.5), 1e-12);
    const GlassPlace back = Glass(object, {.ahead = {0.0, 1.0}}).place({0.5, 0.5}).value();
    EXPECT_NEAR(windAlong(back, 10.0, WindAlongGlass::Projected).y, -10.0 * std::sqrt(0.5), 1e-12);
    const GlassPlace aside = Glass(object, {.ahead = {2.0, 0.0}}).place({0.5, 0.5}).value();
    EXPECT_NEAR(std::abs(windAlong(aside, 10.0, WindAlongGlass::Projected).x), 10.0, 1e-12);
    EXPECT_NEAR(gravityAlong(aside, kGravity).y, -kGravity * std::sqrt(0.5), 1e-12);
}

TEST(MeshedGlass, HasNoGlassBesideItsTriangles)
{
    Sheet left = leaning();
    left.uv_end = {0.3, 1.0};
    Sheet right = leaning();
    right.uv_begin = {0.6, 0.5};
    const Glass glass(meshOf(left), {.scale = 1.0});
    EXPECT_NEAR(glass.width(), 0.3, 1e-12);
    const Glass two(together(meshOf(left), meshOf(right)), {.scale = 1.0});
    EXPECT_NEAR(two.width(), 1.0, 1e-12);
    // Seen from outside, u runs to the driver's left.
    EXPECT_TRUE(two.holds({0.8, 0.9}));
    EXPECT_TRUE(two.holds({0.2, 0.3}));
    EXPECT_FALSE(two.holds({0.55, 0.3}));
    EXPECT_FALSE(two.holds({0.2, 0.7}));
    EXPECT_FALSE(two.place({0.2, 0.7}));
}

TEST(MeshedGlass, HasNoGapsAtSeams)
{
    Sheet sheet = leaning();
    sheet.columns = 7;
    sheet.rows = 5;
    const Glass glass(meshOf(sheet), {.scale = 1.0});
    for (int i = 0; i <= 70; ++i) {
        for (int j = 0; j <= 50; ++j) {
            EXPECT_TRUE(glass.holds({i * glass.width() / 70.0, j * glass.height() / 50.0})) << i << ", " << j;
        }
    }
}

TEST(MeshedGlass, RejectsMeshesThatCannotBeUnrolled)
{
    Sheet flat = leaning();
    flat.uv_end = {0.0, 1.0};
    EXPECT_THROW(Glass(meshOf(flat), {.scale = 1.0}), Error);
    EXPECT_THROW(Glass(meshOf(leaning()), {.ahead = {0.0, 0.0}}), Error);
    EXPECT_THROW(Glass(meshOf(leaning()), {.scale = -1.0}), Error);
    EXPECT_THROW(Glass(TexturedMesh{}, {}), Error);
}

}  // namespace
}  // namespace droplet
