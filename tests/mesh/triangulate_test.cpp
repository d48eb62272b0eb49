// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mesh/triangulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "support/angles.h"
#include "support/domains.h"
#include "support/masks.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::Animal;
using testing::domainOf;
using testing::ellipseLoop;
using testing::polygonLoop;
using testing::smoothMask;
using testing::zoo;

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::size_t triangleCount(const std::vector<PlanarMesh>& meshes)
{
    std::size_t count = 0;
    for (const PlanarMesh& mesh : meshes) {
        count += mesh.triangles.size();
    }
    return count;
}

TEST(Triangulate, MeshesAreValidAndCoverTheFootprint)
{
    for (const auto& [name, domain] : zoo()) {
        SCOPED_TRACE(name);
        for (const std::size_t wanted : {400U, 6000U}) {
            const std::vector<PlanarMesh> meshes = triangulate(domain, {.triangles = wanted, .edge = {}});
            ASSERT_EQ(meshes.size(), domain.droplets.size());
            for (std::size_t k = 0; k < meshes.size(); ++k) {
                EXPECT_NO_THROW(meshes[k].validate());
                EXPECT_EQ(meshes[k].loopCount(), 1 + domain.droplets[k].holes.size());
                // The area is restored except at corners: measured 1e-5 at 6000 triangles, 1e-4 at 400.
                EXPECT_NEAR(area(meshes[k]) / area(domain.droplets[k]), 1.0, wanted > 1000 ? 1e-3 : 5e-3);
                // Euler: V − E + F = 1 − holes, with 2E = 3F + rim edges.
                const auto f = static_cast<long>(meshes[k].triangles.size());
                const auto rim = static_cast<long>(meshes[k].rimVertexCount());
                const auto v = static_cast<long>(meshes[k].vertices.size());
                EXPECT_EQ(2 * v - (3 * f + rim) + 2 * f, 2 - 2 * static_cast<long>(domain.droplets[k].holes.size()));
            }
        }
    }
}

TEST(Triangulate, AnglesAreAtLeastTwentyDegrees)
{
    for (const auto& [name, domain] : zoo()) {
        SCOPED_TRACE(name);
        for (const std::size_t wanted : {400U, 6000U, 30000U}) {
            const std::vector<PlanarMesh> meshes = triangulate(domain, {.triangles = wanted, .edge = {}});
            for (std::size_t k = 0; k < meshes.size(); ++k) {
                EXPECT_THAT(testing::brokenPromises(meshes[k], domain.droplets[k]), ::testing::IsEmpty());
            }
        }
    }
}

TEST(Triangulate, SharpCornersAreMeshed)
{
    for (const double degrees : {5.0, 15.0, 25.0, 45.0, 60.0, 90.0, 170.0}) {
        const double angle = degrees / kDegrees;
        const Domain wedge = domainOf(polygonLoop({{0, 0}, {1, 0}, {std::cos(angle), std::sin(angle)}}));
        for (const std::size_t wanted : {200U, 3000U}) {
            const std::vector<PlanarMesh> meshes = triangulate(wedge, {.triangles = wanted, .edge = {}});
            EXPECT_NO_THROW(meshes[0].validate());
            EXPECT_THAT(testing::brokenPromises(meshes[0], wedge.droplets[0]), ::testing::IsEmpty());
            EXPECT_NEAR(area(meshes[0]) / area(wedge.droplets[0]), 1.0, 1e-9);
        }
    }
}

TEST(Triangulate, NumberOfTrianglesIsMetWithinTenPercent)
{
    const std::vector<Animal> animals = zoo();
    for (const std::size_t k : {0U, 1U, 2U, 7U, 8U, 9U}) {
        for (const std::size_t wanted : {500U, 1000U, 5000U, 20000U, 100000U}) {
            const auto count =
                static_cast<double>(triangleCount(triangulate(animals[k].domain, {.triangles = wanted, .edge = {}})));
            EXPECT_NEAR(count / static_cast<double>(wanted), 1.0, 0.1) << animals[k].name << " " << wanted;
        }
    }
}

TEST(TriangulateQuads, MeshesKeepWhatTrianglesPromise)
{
    for (const auto& [name, domain] : zoo()) {
        SCOPED_TRACE(name);
        for (const std::size_t wanted : {400U, 6000U, 30000U}) {
            const std::vector<PlanarMesh> meshes =
                triangulate(domain, {.triangles = wanted, .edge = {}, .quads = true});
            ASSERT_EQ(meshes.size(), domain.droplets.size());
            for (std::size_t k = 0; k < meshes.size(); ++k) {
                EXPECT_NO_THROW(meshes[k].validate());
                EXPECT_EQ(meshes[k].loopCount(), 1 + domain.droplets[k].holes.size());
                EXPECT_NEAR(area(meshes[k]) / area(domain.droplets[k]), 1.0, wanted > 1000 ? 1e-3 : 5e-3);
                EXPECT_THAT(testing::brokenPromises(meshes[k], domain.droplets[k]), ::testing::IsEmpty());
            }
        }
    }
}

TEST(TriangulateQuads, NumberOfTrianglesIsMetWithinTenPercent)
{
    const std::vector<Animal> animals = zoo();
    for (const std::size_t k : {0U, 1U, 2U, 7U, 8U, 9U}) {
        for (const std::size_t wanted : {1000U, 5000U, 20000U, 100000U}) {
            const auto count = static_cast<double>(
                triangleCount(triangulate(animals[k].domain, {.triangles = wanted, .edge = {}, .quads = true})));
            EXPECT_NEAR(count / static_cast<double>(wanted), 1.0, 0.1) << animals[k].name << " " << wanted;
        }
    }
}

// A disc's rings go round it, so that sides are along radii or across them wherever the field is unique.
TEST(TriangulateQuads, SidesFollowTheRim)
{
    for (const double radius : {1.0, 3.0}) {
        const std::vector<PlanarMesh> meshes =
            triangulate(domainOf(ellipseLoop(radius, radius)), {.edge = 0.05, .quads = true});
        std::size_t count = 0;
        std::size_t aligned = 0;
        for (const Triangle& t : meshes[0].triangles) {
            // Both shorter edges are sides; the longest one is a diagonal.
            std::array<std::pair<double, Vec2>, 3> edges;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec2 step = meshes[0].vertices[t[(k + 1) % 3]] - meshes[0].vertices[t[k]];
                edges[k] = {length(step), step};
            }
            std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
            const Vec2 middle =
                (1.0 / 3.0) * (meshes[0].vertices[t[0]] + meshes[0].vertices[t[1]] + meshes[0].vertices[t[2]]);
            if (length(middle) < 0.8 * radius) {
                continue;
            }
            for (const auto& [side, step] : {edges[0], edges[1]}) {
                const double turn = std::atan2(std::abs(cross(step, middle)), std::abs(dot(step, middle)));
                ++count;
                aligned += std::min(turn, 0.5 * std::numbers::pi - turn) < 15.0 / kDegrees ? 1U : 0U;
            }
        }
        EXPECT_GT(static_cast<double>(aligned), 0.95 * static_cast<double>(count)) << radius;
    }
}

TEST(TriangulateQuads, HaveNoGrading)
{
    const Domain disc = domainOf(ellipseLoop(1, 1));
    EXPECT_EQ(gradingOf(disc, {.edge = {}, .layer = 1e-3, .quads = true}), 1);
    EXPECT_NO_THROW(triangulate(disc, {.triangles = 500, .edge = {}, .grading = 1, .quads = true}));
    EXPECT_THROW(triangulate(disc, {.edge = {}, .grading = 8, .quads = true}), Error);
}

TEST(Triangulate, EdgeLengthIsMetAwayFromTheRim)
{
    const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 1)), {.edge = 0.05});
    double sum = 0.0;
    std::size_t count = 0;
    for (const Triangle& t : meshes[0].triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 a = meshes[0].vertices[t[k]];
            const Vec2 b = meshes[0].vertices[t[(k + 1) % 3]];
            if (length(a) < 0.8 && length(b) < 0.8) {
                sum += length(b - a);
                ++count;
            }
        }
    }
    EXPECT_NEAR(sum / static_cast<double>(count), 0.05, 1e-3);
}

TEST(Triangulate, RimVerticesStayOnTheLoop)
{
    const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 1)), {.edge = 0.1});
    const double sagitta = 1.0 - std::cos(0.05);
    for (std::uint32_t v = 0; v < meshes[0].rimVertexCount(); ++v) {
        // Vertices lie outside by two thirds of the sagitta, so that the polygon has the circle's area.
        EXPECT_NEAR(length(meshes[0].vertices[v]), 1.0, 0.8 * sagitta);
    }
    EXPECT_NEAR(area(meshes[0]), std::numbers::pi, 1e-5);
}

TEST(Triangulate, CornersStayInPlace)
{
    const std::vector<Vec2> corners{{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
    const std::vector<PlanarMesh> meshes = triangulate(domainOf(polygonLoop(corners)), {.edge = 0.13});
    for (const Vec2 corner : corners) {
        const auto end = meshes[0].vertices.begin() + meshes[0].rimVertexCount();
        EXPECT_NE(std::find(meshes[0].vertices.begin(), end, corner), end);
    }
}

TEST(Triangulate, SameBitsAtAnyNumberOfThreads)
{
    const Domain domain = split(trace(smoothMask(300, 100, [](Vec2 p) {
        return length(p - Vec2{50, 50}) < 40 || length(p - Vec2{150, 50}) < 30 || length(p - Vec2{250, 50}) < 45;
    })));
    std::vector<std::vector<PlanarMesh>> runs;
    for (const std::size_t threads : {1U, 2U, 2U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        runs.push_back(triangulate(domain, {.triangles = 5000, .edge = {}}));
    }
    for (std::size_t k = 0; k < runs[0].size(); ++k) {
        for (std::size_t r = 1; r < runs.size(); ++r) {
            EXPECT_EQ(runs[0][k].vertices, runs[r][k].vertices);
            EXPECT_EQ(runs[0][k].triangles, runs[r][k].triangles);
        }
    }
}

TEST(Triangulate, RejectsCrossingLoops)
{
    const Domain bowtie = domainOf(polygonLoop({{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
    try {
        (void)triangulate(bowtie);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
    }
}

/// Stars side by side, with a corner at every tip.
Domain stars(int count, int tips)
{
    Domain domain;
    for (int k = 0; k < count; ++k) {
        Footprint& star = domain.droplets.emplace_back();
        for (int i = 0; i < 2 * tips; ++i) {
            const double angle = std::numbers::pi * i / tips;
            const double radius = (i % 2 == 0 ? 1.0 : 0.99) + 0.1 * std::sin(7.0 * angle);
            star.rim.points.push_back({2.5 * k + radius * std::cos(angle), radius * std::sin(angle)});
            star.rim.corner.push_back(1);
        }
    }
    return domain;
}

TEST(Triangulate, RejectsTooFineDetail)
{
    try {
        (void)triangulate(stars(550, 1000), {.triangles = 100, .edge = 1.0});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("takes 1099450 triangles or more"),
                                                   ::testing::HasSubstr("over the limit of 1048576")));
    }
}

TEST(Triangulate, RejectsOptionsOutOfRange)
{
    const Domain domain = domainOf(ellipseLoop(1, 1));
    EXPECT_THROW((void)triangulate(domain, {.triangles = 0, .edge = {}}), Error);
    EXPECT_THROW((void)triangulate(domain, {.edge = 0.0}), Error);
    EXPECT_THROW((void)triangulate(domain, {.edge = std::nan("")}), Error);
}

TEST(PlanarMesh, ValidateRejectsBrokenInvariants)
{
    // Square with a vertex in the middle.
    PlanarMesh mesh;
    mesh.vertices = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}};
    mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    mesh.loop_starts = {0, 4};
    EXPECT_NO_THROW(mesh.validate());
    EXPECT_DOUBLE_EQ(area(mesh), 1.0);
    EXPECT_DOUBLE_EQ(rimLength(mesh), 4.0);
    EXPECT_NEAR(minAngle(mesh), std::numbers::pi / 4, 1e-15);

    PlanarMesh broken = mesh;
    broken.triangles[0] = {1, 0, 4};
    EXPECT_THROW(broken.validate(), Error);
    broken = mesh;
    broken.triangles[0] = {0, 1, 5};
    EXPECT_THROW(broken.validate(), Error);
    broken = mesh;
    broken.triangles = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_THROW(broken.validate(), Error);
    broken = mesh;
    broken.loop_starts = {0};
    EXPECT_THROW(broken.validate(), Error);
    broken = mesh;
    broken.vertices[4].x = std::nan("");
    EXPECT_THROW(broken.validate(), Error);
}

}  // namespace
}  // namespace droplet
