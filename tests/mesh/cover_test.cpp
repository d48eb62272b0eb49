// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "droplet/mesh/follow.h"
#include "droplet/mesh/triangulate.h"
#include "support/domains.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;

/// Checks the guarantees of a cover.
void expectCovers(const PlanarMesh& ground, const PlanarMesh& mesh)
{
    ASSERT_EQ(ground.loop_starts, mesh.loop_starts);
    const std::uint32_t rim = mesh.rimVertexCount();
    ASSERT_GE(ground.vertices.size(), rim);
    EXPECT_TRUE(std::equal(mesh.vertices.begin(), mesh.vertices.begin() + rim, ground.vertices.begin()))
        << "rim vertices must be equal";

    // Triangles are counter-clockwise, every inner edge occurs once in each direction, every rim edge once in its own.
    // Together with the area, this proves that the polygon is covered once.
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::set<std::uint32_t> used;
    for (const Triangle& t : ground.triangles) {
        ASSERT_GT(doubleArea(ground, t), 0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_LT(t[k], ground.vertices.size());
            used.insert(t[k]);
            ASSERT_TRUE(edges.emplace(t[k], t[(k + 1) % 3]).second) << "edge occurs twice in one direction";
        }
    }
    EXPECT_EQ(used.size(), ground.vertices.size()) << "some vertices belong to no triangle";
    std::size_t single = 0;
    for (const auto& [a, b] : edges) {
        single += edges.contains({b, a}) ? 0 : 1;
    }
    EXPECT_EQ(single, rim);
    for (std::size_t k = 0; k < mesh.loopCount(); ++k) {
        for (std::uint32_t v = mesh.loop_starts[k]; v < mesh.loop_starts[k + 1]; ++v) {
            const std::uint32_t next = nextOnRim(mesh, k, v);
            EXPECT_TRUE(edges.contains({v, next})) << v;
            EXPECT_FALSE(edges.contains({next, v})) << v;
        }
    }
    EXPECT_NEAR(area(ground) / area(mesh), 1.0, 1e-12);
    // Euler's formula
    const std::size_t holes = mesh.loopCount() - 1;
    EXPECT_EQ(ground.triangles.size(), 2 * (ground.vertices.size() - rim) + rim + 2 * holes - 2);
}

TEST(Cover, CoversTheSamePolygonOnce)
{
    for (const auto& [name, domain] : testing::zoo()) {
        for (const int grading : {1, 8}) {
            for (const std::size_t triangles : {300U, 5000U}) {
                for (const PlanarMesh& mesh :
                     triangulate(domain, {.triangles = triangles, .edge = {}, .grading = grading})) {
                    SCOPED_TRACE(name + " of " + std::to_string(triangles) + ", grading " + std::to_string(grading));
                    expectCovers(cover(mesh), mesh);
                }
            }
        }
    }
}

TEST(MovableCover, CoversWithoutEdgesFromRimToRim)
{
    for (const auto& [name, domain] : testing::zoo()) {
        SCOPED_TRACE(name);
        for (const PlanarMesh& mesh : triangulate(domain, {.triangles = 3000, .edge = {}})) {
            const PlanarMesh ground = movableCover(mesh);
            expectCovers(ground, mesh);
            EXPECT_LE(ground.triangles.size(), 7 * mesh.rimVertexCount());
            for (const Triangle& t : ground.triangles) {
                EXPECT_FALSE(mesh.onRim(t[0]) && mesh.onRim(t[1]) && mesh.onRim(t[2]));
            }
        }
    }
}

TEST(Cover, NoOtherVertexIsOnTheRim)
{
    for (const auto& [name, domain] : testing::zoo()) {
        SCOPED_TRACE(name);
        for (const PlanarMesh& mesh : triangulate(domain, {.triangles = 3000, .edge = {}})) {
            const PlanarMesh ground = cover(mesh);
            const double edge = rimLength(mesh) / static_cast<double>(mesh.rimVertexCount());
            for (std::size_t v = mesh.rimVertexCount(); v < ground.vertices.size(); ++v) {
                for (std::size_t k = 0; k < mesh.loopCount(); ++k) {
                    for (std::uint32_t a = mesh.loop_starts[k]; a < mesh.loop_starts[k + 1]; ++a) {
                        const Vec2 from = mesh.vertices[a];
                        const Vec2 along = mesh.vertices[nextOnRim(mesh, k, a)] - from;
                        const Vec2 p = ground.vertices[v] - from;
                        const double at = std::clamp(dot(p, along) / dot(along, along), 0.0, 1.0);
                        ASSERT_GT(length(p - at * along), edge);
                    }
                }
            }
        }
    }
}

// The number of triangles is proportional to the rim, not to the area. Per rim vertex there are 1½ triangles in the
// strip along the rim. Every level, with ½, ¼, ⅛ … points, has 2 between its layers and 1½ to the next level. That
// gives 5 in all, and up to 2/√3 times as many where layers cut across the rows. Measured: at most 5.0 here, 5.3 at
// four million triangles.
TEST(Cover, TakesAtMostSixTrianglesPerRimVertex)
{
    for (const auto& [name, domain] : testing::zoo()) {
        for (const std::size_t triangles : {300U, 5000U, 40000U, 160'000U}) {
            SCOPED_TRACE(name + " of " + std::to_string(triangles));
            for (const PlanarMesh& mesh : triangulate(domain, {.triangles = triangles, .edge = {}})) {
                EXPECT_LE(cover(mesh).triangles.size(), 6 * mesh.rimVertexCount());
            }
        }
    }
}

// Points beside a rim of shorter edges would have up to 19 triangles here.
TEST(Cover, NoVertexHasMoreThanThirteenTriangles)
{
    for (const auto& [name, domain] : testing::zoo()) {
        for (const std::size_t triangles : {3000U, 40000U}) {
            SCOPED_TRACE(name + " of " + std::to_string(triangles));
            for (const PlanarMesh& mesh : triangulate(domain, {.triangles = triangles, .edge = {}})) {
                const PlanarMesh ground = cover(mesh);
                std::vector<std::size_t> counts(ground.vertices.size());
                for (const Triangle& t : ground.triangles) {
                    for (const std::uint32_t v : t) {
                        ++counts[v];
                    }
                }
                EXPECT_LE(*std::max_element(counts.begin(), counts.end()), 13U);
            }
        }
    }
}

TEST(Cover, DependsOnTheRimAlone)
{
    // The lattice and the order of triangles do not matter.
    PlanarMesh mesh = triangulate(domainOf(ellipseLoop(1, 0.8)), {.triangles = 2000, .edge = {}})[0];
    const PlanarMesh ground = cover(mesh);
    mesh.lattice = {};
    std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    const PlanarMesh again = cover(mesh);
    EXPECT_EQ(again.vertices, ground.vertices);
    EXPECT_EQ(again.triangles, ground.triangles);
}

}  // namespace
}  // namespace droplet
