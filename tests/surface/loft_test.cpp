// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/surface/loft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/shape/figures.h"
#include "droplet/units.h"
#include "support/domains.h"
#include "support/grounded.h"
#include "support/heights.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::heightsOf;
using testing::reversed;

/// Solved disc of radius 1 m with σ = ρ = 1, no gravity and volume 1: u = (2/π)(1 − r²).
struct SolvedDisc {
    std::vector<PlanarMesh> meshes;
    std::vector<CapillarySurface> fields;
};

SolvedDisc solvedDisc(double edge)
{
    SolvedDisc result;
    result.meshes = triangulate(domainOf(ellipseLoop(1, 1)), {.edge = edge});
    SolveOptions options;
    options.liquid = {"unit", 1.0, 1.0};
    options.gravity = 0.0;
    options.fill = {FillBy::Volume, 1.0, FillSharing::Each};
    result.fields = solve(result.meshes, options).droplets;
    return result;
}

TEST(Loft, IsClosedAndHasItsVolume)
{
    for (const std::size_t holes : {0U, 1U, 2U}) {
        std::vector<Loop> inner;
        for (std::size_t k = 0; k < holes; ++k) {
            Loop hole = reversed(ellipseLoop(0.2, 0.3));
            for (Vec2& p : hole.points) {
                p.x += 0.5 - static_cast<double>(k);
            }
            inner.push_back(hole);
        }
        const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 1), inner), {.edge = 0.05});
        SolveOptions options;
        options.fill = {FillBy::Volume, 0.5, FillSharing::Each};
        const Solution solution = solve(meshes, options);
        const Surface closed = loft(solution.droplets, {.open = false, .extent = {2, 2}});
        EXPECT_NO_THROW(closed.validate());
        const Topology t = topology(closed);
        EXPECT_TRUE(t.closed);
        EXPECT_EQ(t.components, 1U);
        // A droplet with holes is a sphere with as many handles as holes: V − E + F = 2 − 2·holes.
        EXPECT_EQ(t.euler, 2 - 2 * static_cast<long>(holes));
        EXPECT_NEAR(enclosedVolume(closed), 0.5, 1e-12);
        EXPECT_NEAR(closed.mean_height, 0.5 / area(meshes[0]), 1e-12);

        const Topology open = topology(loft(solution.droplets, {.open = true, .extent = {2, 2}}));
        EXPECT_TRUE(open.manifold);
        EXPECT_FALSE(open.closed);
        EXPECT_EQ(open.boundary_loops, 1 + holes);
        EXPECT_EQ(open.euler, 1 - static_cast<long>(holes));
    }
}

// The base has triangles of its own, which share only the rim with the liquid's.
TEST(Loft, BaseOnFlatGroundClosesEveryFootprint)
{
    for (const auto& [name, domain] : testing::zoo()) {
        for (const int grading : {1, 16}) {
            SCOPED_TRACE(name + ", grading " + std::to_string(grading));
            const std::vector<PlanarMesh> meshes =
                triangulate(domain, {.triangles = 2500, .edge = {}, .grading = grading});
            SolveOptions options;
            options.fill = {FillBy::Height, 1e-3, FillSharing::Each};
            const Solution solution = solve(meshes, options);
            ASSERT_TRUE(solution.report.usable());
            const LoftOptions closed_options{.open = false, .extent = domain.extent};
            const Surface closed = loft(solution.droplets, closed_options);
            ASSERT_NO_THROW(closed.validate());
            const Topology t = topology(closed);
            EXPECT_TRUE(t.closed);
            EXPECT_EQ(t.components, meshes.size());
            long euler = 0;
            double volume = 0.0;
            std::size_t triangles = 0;
            for (std::size_t k = 0; k < meshes.size(); ++k) {
                euler += 4 - 2 * static_cast<long>(meshes[k].loopCount());
                volume += measure(solution.droplets[k], options).volume;
                triangles += meshes[k].triangles.size() + cover(meshes[k]).triangles.size();
            }
            EXPECT_EQ(t.euler, euler);
            EXPECT_NEAR(enclosedVolume(closed) / volume, 1.0, 1e-9);
            EXPECT_EQ(closed.triangles.size(), triangles);

            // Without the base the liquid is the same.
            const Surface open = loft(solution.droplets, {.open = true, .extent = domain.extent});
            EXPECT_EQ(open.mean_height, closed.mean_height);
            std::size_t flat = 0;
            for (const Triangle& triangle : closed.triangles) {
                const bool ground = std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
                    return closed.vertices[v].z == 0.0 && closed.normals[v] == Vec3{0, 0, -1};
                });
                flat += ground ? 1 : 0;
            }
            EXPECT_EQ(flat + open.triangles.size(), closed.triangles.size());
        }
    }
}

TEST(Loft, TrianglesWindOutward)
{
    const SolvedDisc disc = solvedDisc(0.1);
    const Surface surface = loft(disc.fields, {.open = false, .extent = {2, 2}});
    for (const Triangle& t : surface.triangles) {
        const Vec3 a = surface.vertices[t[0]];
        const Vec3 normal = cross(surface.vertices[t[1]] - a, surface.vertices[t[2]] - a);
        for (const std::uint32_t v : t) {
            EXPECT_GT(dot(normal, surface.normals[v]), 0.0);
        }
    }
}

// Normals of a paraboloid. Means over triangles of different sizes are of first order: the largest error inside,
// divided by the edge length, tends to 10°. Measured: 4.9, 6.1, 8.3, 9.3; on the rim 0.9, 0.6, 1.7, 1.7.
TEST(Loft, NormalsAreThoseOfTheParaboloid)
{
    for (const double edge : {0.1, 0.05, 0.025, 0.0125}) {
        const SolvedDisc disc = solvedDisc(edge);
        const Surface surface = loft(disc.fields, {.open = true, .extent = {2, 2}});
        double inside = 0.0;
        double on_rim = 0.0;
        for (std::uint32_t v = 0; v < surface.vertices.size(); ++v) {
            const Vec3 p = surface.vertices[v];
            const double g = 4.0 / std::numbers::pi;
            const Vec3 exact = (1.0 / std::sqrt(1.0 + g * g * (p.x * p.x + p.y * p.y))) * Vec3{g * p.x, g * p.y, 1.0};
            double& worst = disc.meshes[0].onRim(v) ? on_rim : inside;
            worst = std::max(worst, length(exact - surface.normals[v]) * 180.0 / std::numbers::pi);
        }
        EXPECT_LT(inside, 11.0 * edge) << edge;
        EXPECT_LT(on_rim, 2.0 * edge) << edge;
    }
}

TEST(Loft, RimHasTwoNormals)
{
    const SolvedDisc disc = solvedDisc(0.1);
    const Surface surface = loft(disc.fields, {.open = false, .extent = {2, 2}});
    std::size_t split = 0;
    for (std::uint32_t v = 0; v < surface.vertices.size(); ++v) {
        if (surface.weld[v] != v) {
            ++split;
            EXPECT_EQ(surface.vertices[v], surface.vertices[surface.weld[v]]);
            EXPECT_EQ(surface.vertices[v].z, 0.0);
            EXPECT_EQ(surface.normals[v], (Vec3{0, 0, -1}));
            EXPECT_GT(surface.normals[surface.weld[v]].z, 0.1);
        }
    }
    EXPECT_EQ(split, disc.meshes[0].rimVertexCount());
}

/// Grounds for footprints with the size of the unit disc.
std::vector<BaseSurface> grounds()
{
    HeightMap map{5, 4, {}, false};
    for (int i = 0; i < 20; ++i) {
        map.levels.push_back(static_cast<float>(i * i % 7) / 7.0F);
    }
    return {BaseSurface::sphere(1.5), BaseSurface::sphere(-2.0), BaseSurface::cylinder(1.3, 0.4),
            BaseSurface::heightMap(map, {2.2, 2.1}, 0.3)};
}

TEST(Loft, TheBaseFollowsTheGround)
{
    Loop hole = reversed(ellipseLoop(0.2, 0.3));
    for (Vec2& p : hole.points) {
        p.x += 0.3;
    }
    const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 1), {hole}), {.edge = 0.07});
    for (const BaseSurface& ground : grounds()) {
        const CapillarySurface field = testing::liquidOn(meshes[0], ground, [](Vec2 p) { return 0.4 + 0.2 * p.y; });
        const Surface closed = loft({field}, {.extent = {2, 2}, .ground = ground});
        ASSERT_NO_THROW(closed.validate());
        const Topology found = topology(closed);
        EXPECT_TRUE(found.closed);
        EXPECT_EQ(found.components, 1U);
        EXPECT_EQ(found.euler, 0);
        const double volume = testing::volumeOf(field, ground);
        EXPECT_NEAR(enclosedVolume(closed) / volume, 1.0, 1e-12);
        EXPECT_NEAR(closed.mean_height * area(meshes[0]) / volume, 1.0, 1e-12);

        // The base comes after the liquid, with the same places and with reversed triangles.
        const std::size_t count = meshes[0].vertices.size();
        ASSERT_EQ(closed.vertices.size(), 2 * count);
        for (std::size_t v = 0; v < count; ++v) {
            const Vec3 below = closed.vertices[count + v];
            const GroundPoint exact = ground.at({below.x, below.y});
            EXPECT_EQ(below.z, exact.height);
            EXPECT_EQ(Vec2({below.x, below.y}), meshes[0].vertices[v]);
            const Vec3 down{exact.gradient.x, exact.gradient.y, -1.0};
            EXPECT_LT(length(closed.normals[count + v] - (1.0 / length(down)) * down), 1e-15);
            EXPECT_EQ(closed.weld[count + v], meshes[0].onRim(static_cast<std::uint32_t>(v)) ? v : count + v);
            EXPECT_EQ(closed.uvs[count + v], closed.uvs[v]);
        }
        const Surface open = loft({field}, {.open = true, .extent = {2, 2}, .ground = ground});
        EXPECT_EQ(open.vertices.size(), count);
        EXPECT_EQ(open.mean_height, closed.mean_height);
    }
}

// Normals at the rim are exact, also on ground that slopes along the rim.
TEST(Loft, NormalsOnCurvedGroundAreExactOnTheRim)
{
    const BaseSurface ground([](Vec2 p) {
        return GroundPoint{0.4 * p.x + 0.3 * p.x * p.y, {0.4 + 0.3 * p.y, 0.3 * p.x}};
    });
    const auto thickness = [](Vec2 p) { return 0.5 * (1.0 - dot(p, p)); };
    double before = 10.0;
    for (const double edge : {0.1, 0.05, 0.025}) {
        const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 1)), {.edge = edge});
        CapillarySurface field = testing::liquidOn(meshes[0], ground, thickness);
        const auto slope = [&](Vec2 p) { return ground.at(p).gradient - p; };
        const std::uint32_t rim = meshes[0].rimVertexCount();
        for (std::uint32_t v = 0; v < rim; ++v) {
            const Vec2 p = meshes[0].vertices[v];
            // Seen along the rim, slopes across it are shortened by that of the ground along it.
            const Vec2 inward = (-1.0 / length(p)) * p;
            const Vec2 g = ground.at(p).gradient;
            const double stretch = std::hypot(1.0, dot(g, Vec2{-inward.y, inward.x}));
            field.contact_angle[v] = std::atan(dot(slope(p), inward) / stretch) - std::atan(dot(g, inward) / stretch);
        }
        const Surface surface = loft({field}, {.open = true, .extent = {2, 2}, .ground = ground});
        double worst = 0.0;
        double worst_on_rim = 0.0;
        for (std::uint32_t v = 0; v < surface.vertices.size(); ++v) {
            const Vec2 g = slope(meshes[0].vertices[v]);
            const Vec3 exact = (1.0 / std::sqrt(1.0 + dot(g, g))) * Vec3{-g.x, -g.y, 1.0};
            double& error = meshes[0].onRim(v) ? worst_on_rim : worst;
            error = std::max(error, length(exact - surface.normals[v]) * 180.0 / std::numbers::pi);
        }
        EXPECT_LT(worst, 0.65 * before) << edge;
        EXPECT_LT(worst_on_rim, 2e-2 * edge * 180.0 / std::numbers::pi) << edge;
        before = worst;
    }
}

TEST(Loft, ContactAnglesAreAtTheLiquidsRim)
{
    const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 1)), {.edge = 0.2});
    for (const BaseSurface& ground : {BaseSurface(), BaseSurface::sphere(2.0)}) {
        CapillarySurface field = testing::liquidOn(meshes[0], ground, [](Vec2) { return 0.4; });
        const std::uint32_t rim = meshes[0].rimVertexCount();
        for (std::uint32_t v = 0; v < rim; ++v) {
            field.contact_angle[v] = 0.1 + 0.01 * v;
        }
        const Surface surface = loft({field}, {.extent = {2, 2}, .ground = ground});
        ASSERT_EQ(surface.contact_angle.size(), surface.vertices.size());
        for (std::uint32_t v = 0; v < surface.vertices.size(); ++v) {
            EXPECT_EQ(surface.contact_angle[v], v < rim ? static_cast<float>(0.1 + 0.01 * v) : 0.0F);
        }
    }
}

TEST(Loft, TextureCoordinatesAreThoseOfTheImage)
{
    const SolvedDisc disc = solvedDisc(0.2);
    const Surface surface = loft(disc.fields, {.open = false, .extent = {4, 8}});
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
        EXPECT_NEAR(surface.uvs[v].x, (surface.vertices[v].x + 2) / 4, 1e-15);
        EXPECT_NEAR(surface.uvs[v].y, (4 - surface.vertices[v].y) / 8, 1e-15);
    }
}

TEST(Loft, RefusesArgumentsThatDoNotFitTogether)
{
    SolvedDisc disc = solvedDisc(0.2);
    EXPECT_THROW((void)loft({}, {.open = false, .extent = {2, 2}}), Error);
    EXPECT_THROW((void)loft(disc.fields, {.open = false, .extent = {0, 2}}), Error);
    const auto refuses = [&](const CapillarySurface& field, const BaseSurface& ground) {
        EXPECT_THROW((void)loft({field}, {.open = false, .extent = {2, 2}, .ground = ground}), Error);
    };
    const BaseSurface bowl = BaseSurface::sphere(-2.0);
    const CapillarySurface good = testing::liquidOn(disc.meshes[0], bowl, [](Vec2) { return 0.1; });
    EXPECT_NO_THROW((void)loft({good}, {.open = false, .extent = {2, 2}, .ground = bowl}));
    const auto spoilt = [&](const auto& spoil) {
        CapillarySurface field = good;
        spoil(field);
        refuses(field, bowl);
    };
    spoilt([](CapillarySurface& field) { field.vertices.pop_back(); });
    spoilt([](CapillarySurface& field) { field.dry.push_back(1); });
    spoilt([](CapillarySurface& field) { field.loop_starts.clear(); });
    spoilt([](CapillarySurface& field) { field.footprint.emplace(); });
    spoilt([](CapillarySurface& field) { field.contact_angle.clear(); });
}

// Parts of several droplets, of which one is a sheet, cover the surface; a part is the droplet alone.
TEST(SurfaceParts, AreTheDroplets)
{
    Domain domain;
    domain.extent = {40e-3, 40e-3};
    for (const double x : {-12e-3, 0.0, 12e-3}) {
        Loop loop = testing::ellipseLoop(3e-3, 3e-3);
        for (Vec2& p : loop.points) {
            p.x += x;
        }
        domain.droplets.push_back({loop, {}});
    }
    DropletOptions options;
    options.mesh.triangles = 1500;
    options.solve.fill = {FillBy::ContactAngle, 100.0 * kDegree, FillSharing::Each};
    const Droplet sheets = makeDroplet(domain, options);
    options.solve.fill.amount = 30.0 * kDegree;
    const Droplet fields = makeDroplet(domain, options);
    for (const Droplet* droplet : {&sheets, &fields}) {
        const Surface& surface = droplet->surface;
        surface.validate();
        ASSERT_EQ(surface.parts.size(), 3U);
        for (std::size_t k = 0; k < 3; ++k) {
            const SurfacePart& part = surface.parts[k];
            EXPECT_EQ(part.droplet, k);
            EXPECT_NEAR(part.volume, droplet->figures[k].volume, 1e-9 * part.volume);
            const Surface alone = extract(surface, {k});
            alone.validate();
            EXPECT_TRUE(isClosed(alone));
            EXPECT_NEAR(enclosedVolume(alone), part.volume, 1e-3 * part.volume);
            EXPECT_NEAR(alone.mean_height, part.volume / part.area, 1e-12);
        }
        const Surface two = extract(surface, {2, 0});
        EXPECT_EQ(two.parts[0].droplet, 2U);
        EXPECT_EQ(topology(two).components, 2U);
    }
    EXPECT_THROW(extract(fields.surface, {}), Error);
    EXPECT_THROW(extract(fields.surface, {3}), Error);
}

TEST(SurfaceParts, MustCoverTheSurface)
{
    DropletOptions options;
    options.mesh.triangles = 200;
    const Domain domain = testing::domainOf(testing::ellipseLoop(3e-3, 2e-3));
    Surface surface = makeDroplet(domain, options).surface;
    const auto refused = [&](const SurfacePart& part) {
        surface.parts = {part};
        EXPECT_THROW(surface.validate(), Error);
    };
    const SurfacePart whole = surface.parts.front();
    SurfacePart part = whole;
    --part.vertices;
    refused(part);
    part = whole;
    --part.triangles;
    refused(part);
    part = whole;
    part.first_vertex = 1;
    refused(part);
    part = whole;
    part.area = 0.0;
    refused(part);
    surface.parts = {whole};
    surface.validate();
}

}  // namespace
}  // namespace droplet
