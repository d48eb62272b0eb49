// SPDX-License-Identifier: GPL-3.0-or-later
//
// Figures of given heights are compared with integrals in closed form and by brute force.
#include "droplet/shape/figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "droplet/shape/solve.h"
#include "droplet/units.h"
#include "support/domains.h"
#include "support/equilibrium.h"
#include "support/heights.h"

namespace droplet {
namespace {

using testing::discMeshes;
using testing::domainOf;
using testing::ellipseLoop;
using testing::heightsOf;
using testing::integrate;
using testing::integrateRim;
using testing::polygonLoop;
using testing::reversed;
using testing::unitOptions;

constexpr double kPi = std::numbers::pi;

/// Field from a function of the place.
CapillarySurface fieldOf(const PlanarMesh& mesh, const std::function<double(Vec2)>& height)
{
    std::vector<double> heights;
    for (const Vec2 p : mesh.vertices) {
        heights.push_back(height(p));
    }
    return testing::fieldOn(mesh, heights);
}

/// Ground of a given height, whose slope does not count.
BaseSurface groundOf(const std::function<double(Vec2)>& height)
{
    return BaseSurface([height](Vec2 p) { return GroundPoint{height(p), {}}; });
}

std::vector<PlanarMesh> square(double side, double edge)
{
    return triangulate(domainOf(polygonLoop({{0, 0}, {side, 0}, {side, side}, {0, side}})), {.edge = edge});
}

TEST(Figures, OfAnInclinedPlaneAreExact)
{
    const std::vector<PlanarMesh> meshes = square(2.0, 0.1);
    const CapillarySurface field = fieldOf(meshes[0], [](Vec2 p) { return 0.5 + 0.75 * p.x; });
    SolveOptions options = unitOptions(Model::Linear, 3.0, 1.0);
    options.liquid = {"other", 0.5, 2.0};
    options.tilt = 0.4;
    options.tilt_direction = 0.3;
    const ShapeFigures figures = measure(field, options);
    EXPECT_NEAR(figures.footprint_area, 4.0, 1e-12);
    EXPECT_NEAR(figures.rim_length, 8.0, 1e-12);
    EXPECT_NEAR(figures.volume, 5.0, 1e-12);
    EXPECT_NEAR(figures.height_max, 2.0, 1e-12);
    EXPECT_EQ(figures.depth_max, 0.0);
    EXPECT_EQ(figures.dry_area, 0.0);
    EXPECT_NEAR(figures.liquid_area, 5.0, 1e-12);
    EXPECT_NEAR(figures.linear_area, 4.0 * (1.0 + 0.5 * 0.5625), 1e-12);
    EXPECT_NEAR(figures.surface_energy, 2.5, 1e-12);
    EXPECT_NEAR(figures.slope_max, std::atan(0.75), 1e-12);
    EXPECT_EQ(figures.steep_area, 0.0);
    // ∫u² = 2∫(0.5 + 0.75x)² = 2 · (2³ − 0.5³)/(3 · 0.75) = 7; ∫xu = 2(0.5·2 + 0.75·8/3) = 6; ∫yu = 2 · ∫(0.5 + 0.75x)
    // = 5.
    const double normal = 3.0 * std::cos(0.4);
    const double along = 3.0 * std::sin(0.4);
    EXPECT_NEAR(figures.gravity_energy,
                0.5 * 2.0 * normal * 7.0 - 2.0 * along * (6.0 * std::cos(0.3) + 5.0 * std::sin(0.3)), 1e-11);
    EXPECT_NEAR(figures.bond_number, 2.0 * 3.0 * 4.0 / (kPi * 0.5), 1e-11);
    EXPECT_NEAR(figures.projected_width, 2.0 * (std::cos(0.3) + std::sin(0.3)), 1e-12);
}

TEST(Figures, OnGroundAreExact)
{
    const std::vector<PlanarMesh> meshes = square(2.0, 0.1);
    const CapillarySurface field = fieldOf(meshes[0], [](Vec2 p) { return 0.5 + 0.75 * p.x; });
    SolveOptions options = unitOptions(Model::Exact, -2.0, 1.0);
    options.ground = groundOf([](Vec2 p) { return 1.0 + 0.2 * p.y; });
    const ShapeFigures figures = measure(field, options);
    // ∫h = 4 · 1.2
    EXPECT_NEAR(figures.volume, 5.0 - 4.8, 1e-12);
    EXPECT_NEAR(figures.height_max, 2.0 - 1.0, 1e-12);
    EXPECT_NEAR(figures.depth_max, 1.4 - 0.5, 1e-12);
    // ∫h² = 2(1.4³ − 1)/(3 · 0.2)
    EXPECT_NEAR(figures.gravity_energy, -0.5 * 2.0 * (7.0 - 2.0 * (1.4 * 1.4 * 1.4 - 1.0) / 0.6), 1e-11);
    // Only the magnitude counts.
    EXPECT_NEAR(figures.bond_number, 2.0 * 4.0 / kPi, 1e-11);
    EXPECT_EQ(figures.projected_width, 0.0);
}

TEST(Figures, AgreeWithBruteForce)
{
    const std::vector<PlanarMesh> meshes =
        triangulate(domainOf(ellipseLoop(1, 0.8), {reversed(ellipseLoop(0.3, 0.2))}), {.edge = 0.07});
    const auto height = [](Vec2 p) { return 0.4 * std::sin(2 * p.x + 1) + 0.9 * p.y * p.y; };
    const auto ground = [](Vec2 p) { return 0.2 * std::cos(3 * p.x * p.y); };
    const CapillarySurface field = fieldOf(meshes[0], height);
    SolveOptions options = unitOptions(Model::Exact, 1.7, 1.0);
    options.ground = groundOf(ground);
    options.tilt = 2.0;
    options.tilt_direction = -0.6;
    const ShapeFigures figures = measure(field, options);
    std::vector<double> below;
    std::vector<double> thickness;
    for (std::uint32_t v = 0; v < field.vertices.size(); ++v) {
        below.push_back(testing::groundAt(field, v, options.ground));
        thickness.push_back(field.vertices[v].z - below.back());
    }
    const auto square_of = [](Vec2, double u) { return u * u; };
    const Vec2 down{std::cos(-0.6), std::sin(-0.6)};
    const double head = integrate(meshes[0], thickness, [&](Vec2 p, double u) { return dot(p, down) * u; });
    EXPECT_NEAR(figures.volume, integrate(meshes[0], thickness, [](Vec2, double u) { return u; }), 1e-12);
    EXPECT_NEAR(figures.gravity_energy,
                0.5 * 1.7 * std::cos(2.0) *
                        (integrate(meshes[0], heightsOf(field), square_of) - integrate(meshes[0], below, square_of)) -
                    1.7 * std::sin(2.0) * head,
                1e-12);
    double liquid_area = 0.0;
    double linear_area = 0.0;
    double steep_area = 0.0;
    double steepest = 0.0;
    for (const Triangle& t : meshes[0].triangles) {
        const double area = 0.5 * doubleArea(meshes[0], t);
        const Vec2 g = testing::gradientOn(meshes[0], t, heightsOf(field));
        liquid_area += area * std::hypot(1.0, g.x, g.y);
        linear_area += area * (1.0 + 0.5 * dot(g, g));
        steep_area += std::atan(length(g)) > 50 * kDegree ? area : 0.0;
        steepest = std::max(steepest, std::atan(length(g)));
    }
    EXPECT_NEAR(figures.liquid_area, liquid_area, 1e-12);
    EXPECT_NEAR(figures.linear_area, linear_area, 1e-12);
    EXPECT_GT(steep_area, 0.0);
    EXPECT_NEAR(figures.steep_area, steep_area, 1e-12);
    EXPECT_NEAR(figures.slope_max, steepest, 1e-12);
    EXPECT_NEAR(figures.surface_energy, liquid_area, 1e-12);
    EXPECT_NEAR(figures.projected_width,
                0.5 * integrateRim(meshes[0], [&](std::uint32_t, Vec2 n) { return std::abs(dot(n, down)); }), 1e-12);
}

// A cone of 60° for r < 0.5 and of 30° beyond.
TEST(Figures, SteepAreaIsSteeperThanFiftyDegrees)
{
    const std::vector<PlanarMesh> meshes = discMeshes(0.02);
    const double steep = std::tan(60 * kDegree);
    const double gentle = std::tan(30 * kDegree);
    const CapillarySurface field = fieldOf(meshes[0], [=](Vec2 p) {
        const double r = length(p);
        return gentle * (1.0 - std::max(r, 0.5)) + steep * std::max(0.5 - r, 0.0);
    });
    const ShapeFigures figures = measure(field, unitOptions(Model::Linear, 0.0, 1.0));
    // Error of less than an edge around its border.
    EXPECT_NEAR(figures.steep_area, 0.25 * kPi, kPi * 0.02);
    // Near the tip the interpolant is up to 2/√3 times as steep.
    EXPECT_GE(figures.slope_max, 60 * kDegree - 1e-3);
    EXPECT_LE(figures.slope_max, std::atan(2.0) + 1e-9);
}

TEST(Figures, ContactAngleHasPlacesAndAMeanByLength)
{
    // Edges have different lengths, so that means over vertices would differ.
    const std::vector<PlanarMesh> meshes =
        triangulate(domainOf(ellipseLoop(1, 1), {reversed(ellipseLoop(0.3, 0.3))}), {.edge = 0.05, .grading = 4});
    const PlanarMesh& mesh = meshes[0];
    CapillarySurface field = fieldOf(mesh, [](Vec2) { return 0.0; });
    for (std::uint32_t v = 0; v < mesh.rimVertexCount(); ++v) {
        field.contact_angle[v] = 0.7 + 0.2 * mesh.vertices[v].x + (v < mesh.loop_starts[1] ? 0.0 : 0.05);
    }
    const ContactAngle angle = measure(field, unitOptions(Model::Linear, 0.0, 1.0)).contact_angle;
    EXPECT_NEAR(angle.mean,
                integrateRim(mesh, [&](std::uint32_t v, Vec2) { return field.contact_angle[v]; }) / rimLength(mesh),
                1e-12);
    const auto [min, max] = std::minmax_element(field.contact_angle.begin(), field.contact_angle.end());
    EXPECT_EQ(angle.min, *min);
    EXPECT_EQ(angle.max, *max);
    EXPECT_EQ(angle.min_at, mesh.vertices[static_cast<std::size_t>(min - field.contact_angle.begin())]);
    EXPECT_EQ(angle.max_at, mesh.vertices[static_cast<std::size_t>(max - field.contact_angle.begin())]);
    EXPECT_NEAR(angle.min_at.x, -1.0, 0.01);
    EXPECT_NEAR(angle.max_at.x, 1.0, 0.01);
}

// The liquid's area does not include dry ground; volume and footprint do not depend on it.
TEST(Figures, DryGroundIsNotLiquid)
{
    const std::vector<PlanarMesh> meshes = square(2.0, 0.1);
    const PlanarMesh& mesh = meshes[0];
    const auto ramp = [](Vec2 p) { return std::max(0.0, p.x - 1.0) * (2.0 - p.x) * p.y * (2.0 - p.y); };
    CapillarySurface field = fieldOf(mesh, ramp);
    field.dry.assign(mesh.vertices.size(), 0);
    double dry_area = 0.0;
    for (std::uint32_t v = mesh.rimVertexCount(); v < mesh.vertices.size(); ++v) {
        field.dry[v] = field.vertices[v].z == 0.0 ? 1 : 0;
    }
    double liquid_area = 0.0;
    for (const Triangle& t : mesh.triangles) {
        const double area = 0.5 * doubleArea(mesh, t);
        const Vec2 g = testing::gradientOn(mesh, t, heightsOf(field));
        const bool dry =
            field.vertices[t[0]].z == 0.0 && field.vertices[t[1]].z == 0.0 && field.vertices[t[2]].z == 0.0;
        (dry ? dry_area : liquid_area) += dry ? area : area * std::hypot(1.0, g.x, g.y);
    }
    const ShapeFigures figures = measure(field, unitOptions(Model::Linear, 0.0, 1.0));
    EXPECT_NEAR(figures.dry_area, dry_area, 1e-12);
    EXPECT_NEAR(figures.dry_area, 2.0, 0.2);
    EXPECT_NEAR(figures.liquid_area, liquid_area, 1e-12);
    EXPECT_NEAR(figures.footprint_area, 4.0, 1e-12);
    EXPECT_NEAR(figures.surface_energy, liquid_area, 1e-12);
}

TEST(Figures, CombinedAreSumsExtremesAndMeans)
{
    ShapeFigures a;
    a.footprint_area = 1.0;
    a.rim_length = 1.0;
    a.dry_area = 0.25;
    a.volume = 2.0;
    a.height_max = 3.0;
    a.depth_max = 0.1;
    a.liquid_area = 4.0;
    a.linear_area = 4.5;
    a.surface_energy = 5.0;
    a.gravity_energy = -6.0;
    a.slope_max = 0.7;
    a.steep_area = 0.125;
    a.bond_number = 0.5;
    a.projected_width = 1.5;
    a.contact_angle = {0.1, 0.2, 0.3, {1, 2}, {3, 4}};
    ShapeFigures b;
    b.footprint_area = 2.0;
    b.rim_length = 3.0;
    b.dry_area = 0.5;
    b.volume = 20.0;
    b.height_max = 1.0;
    b.depth_max = 0.4;
    b.liquid_area = 40.0;
    b.linear_area = 45.0;
    b.surface_energy = 50.0;
    b.gravity_energy = 60.0;
    b.slope_max = 0.8;
    b.steep_area = 0.25;
    b.bond_number = 1.0;
    b.projected_width = 2.0;
    b.contact_angle = {0.05, 0.6, 0.25, {5, 6}, {7, 8}};
    const ShapeFigures both = combine({a, b});
    EXPECT_EQ(both.footprint_area, 3.0);
    EXPECT_EQ(both.rim_length, 4.0);
    EXPECT_EQ(both.dry_area, 0.75);
    EXPECT_EQ(both.volume, 22.0);
    EXPECT_EQ(both.height_max, 3.0);
    EXPECT_EQ(both.depth_max, 0.4);
    EXPECT_EQ(both.liquid_area, 44.0);
    EXPECT_EQ(both.linear_area, 49.5);
    EXPECT_EQ(both.surface_energy, 55.0);
    EXPECT_EQ(both.gravity_energy, 54.0);
    EXPECT_EQ(both.slope_max, 0.8);
    EXPECT_EQ(both.steep_area, 0.375);
    EXPECT_EQ(both.projected_width, 3.5);
    EXPECT_EQ(both.contact_angle.min, 0.05);
    EXPECT_EQ(both.contact_angle.max, 0.3);
    EXPECT_NEAR(both.contact_angle.mean, (0.2 + 3 * 0.6) / 4.0, 1e-15);
    EXPECT_EQ(both.contact_angle.min_at, (Vec2{5, 6}));
    EXPECT_EQ(both.contact_angle.max_at, (Vec2{3, 4}));
    const ShapeFigures alone = combine({a});
    EXPECT_EQ(alone.bond_number, a.bond_number);
    EXPECT_EQ(alone.contact_angle.mean, a.contact_angle.mean);
}

}  // namespace
}  // namespace droplet
