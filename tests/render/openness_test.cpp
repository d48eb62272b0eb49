// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/openness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/ball_mesh.h"

namespace droplet {
namespace {

/// A ball, and a small level square below its middle.
TexturedMesh ballOver(double radius, double height)
{
    TexturedMesh mesh;
    for (const Vec3 p : {Vec3{-0.001, -0.001, 0.0}, {0.001, -0.001, 0.0}, {0.001, 0.001, 0.0}, {-0.001, 0.001, 0.0}}) {
        mesh.vertices.push_back(p);
        mesh.normals.push_back({0.0, 0.0, 1.0});
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    testing::addBall(mesh, radius, {0.0, 0.0, height});
    return mesh;
}

// A ball of radius R whose middle is at a distance d along the normal hides R²/d² of even light (Lambert's law).
TEST(Openness, BelowABallIsTheRestOfItsSolidAngle)
{
    for (const double height : {1.1, 1.5, 3.0}) {
        const TexturedMesh mesh = ballOver(1.0, height);
        const StandOpenness openness = opennessOf(mesh);
        openness.validate(mesh.triangles.size());
        EXPECT_NEAR(openness.front[0], 1.0 - 1.0 / (height * height), 0.02) << height;
        // Its upper half sees everything; below, the square is nearly nothing.
        for (std::size_t k = openness.first[2]; k < openness.front.size(); ++k) {
            EXPECT_GT(openness.front[k], 0.98F);
        }
        EXPECT_TRUE(openness.back.empty());
        std::vector<bool> is_clear(mesh.triangles.size(), true);
        EXPECT_EQ(opennessOf(mesh, {is_clear}).front[0], 1.0F) << "light passes glass";
        is_clear.assign(mesh.triangles.size(), false);
        EXPECT_EQ(opennessOf(mesh, {is_clear}).front, openness.front);
    }
}

// As the objects of flow are, whose triangles have corners of their own.
TEST(Openness, IsThatOfTheSameMeshWithSharedVertices)
{
    const TexturedMesh mesh = ballOver(1.0, 1.5);
    const StandOpenness shared = opennessOf(mesh);
    TexturedMesh apart;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            apart.vertices.push_back(mesh.vertices[v]);
            apart.normals.push_back(mesh.normals[v]);
        }
        const auto count = static_cast<std::uint32_t>(apart.vertices.size());
        apart.triangles.push_back({count - 3, count - 2, count - 1});
    }
    EXPECT_EQ(opennessOf(apart).front, shared.front);
}

/// Two long squares of 1 m that meet along the y axis at a right angle, open above both.
TexturedMesh gutter(std::uint32_t cells)
{
    TexturedMesh mesh;
    for (const bool is_wall : {false, true}) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (std::uint32_t i = 0; i <= cells; ++i) {
            for (const double y : {-20.0, 20.0}) {
                const double way = static_cast<double>(i) / cells;
                mesh.vertices.push_back(is_wall ? Vec3{0.0, -y, way} : Vec3{way, y, 0.0});
                mesh.normals.push_back(is_wall ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 0.0, 1.0});
            }
        }
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = first + 2 * i;
            mesh.triangles.push_back({a, a + 2, a + 3});
            mesh.triangles.push_back({a, a + 3, a + 1});
        }
    }
    return mesh;
}

// At a distance x from a long wall of height h, (1 − x/√(x² + h²))/2 of even light is hidden (Lambert's law): half of
// it at the edge, of a floor of two triangles, too.
TEST(Openness, OfLargeTrianglesFadesFromTheEdge)
{
    const TexturedMesh mesh = gutter(1);
    const StandOpenness openness = opennessOf(mesh);
    std::size_t compared = 0;
    const std::size_t n = openness.divisions[0];
    ASSERT_GT(n, 4U);
    for (std::size_t j = 0, k = openness.first[0]; j <= n; ++j) {
        for (std::size_t i = 0; i + j <= n; ++i, ++k) {
            const double x = static_cast<double>(i + j) / static_cast<double>(n);
            const double y = -20.0 + 40.0 * static_cast<double>(j) / static_cast<double>(n);
            if (std::abs(y) <= 10.0) {
                EXPECT_NEAR(openness.front[k], 1.0 - 0.5 * (1.0 - x / std::hypot(x, 1.0)), 0.03) << x;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 10U);
}

TEST(Openness, BacksSeeTheOtherSide)
{
    const TexturedMesh mesh = gutter(1);
    const StandOpenness openness = opennessOf(mesh, {{}, true});
    openness.validate(mesh.triangles.size());
    for (const float value : openness.back) {
        EXPECT_EQ(value, 1.0F) << "outside of the gutter all is open";
    }
}

TEST(Openness, InsideIsDark)
{
    TexturedMesh mesh = ballOver(1.0, 0.0);
    for (Vec3& n : mesh.normals) {
        n = -1.0 * n;
    }
    for (const float value : opennessOf(mesh).front) {
        EXPECT_EQ(value, 0.0F);
    }
}

}  // namespace
}  // namespace droplet
