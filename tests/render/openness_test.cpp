// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/openness.h"

#include <gtest/gtest.h>

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
        const std::vector<float> openness = opennessOf(mesh);
        EXPECT_NEAR(openness[0], 1.0 - 1.0 / (height * height), 0.02) << height;
        // Its upper half sees everything; below, the square is nearly nothing.
        for (std::size_t v = 4; v < openness.size(); ++v) {
            EXPECT_GT(openness[v], 0.98F);
        }
        std::vector<bool> is_clear(mesh.triangles.size(), true);
        EXPECT_EQ(opennessOf(mesh, is_clear)[0], 1.0F) << "light passes glass";
        is_clear.assign(mesh.triangles.size(), false);
        EXPECT_EQ(opennessOf(mesh, is_clear), openness);
    }
}

// As the objects of flow are, whose triangles have corners of their own.
TEST(Openness, IsThatOfTheSameMeshWithSharedVertices)
{
    const TexturedMesh mesh = ballOver(1.0, 1.5);
    const std::vector<float> shared = opennessOf(mesh);
    TexturedMesh apart;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            apart.vertices.push_back(mesh.vertices[v]);
            apart.normals.push_back(mesh.normals[v]);
        }
        const auto count = static_cast<std::uint32_t>(apart.vertices.size());
        apart.triangles.push_back({count - 3, count - 2, count - 1});
    }
    const std::vector<float> openness = opennessOf(apart);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(openness[3 * t + k], shared[mesh.triangles[t][k]]);
        }
    }
}

TEST(Openness, InsideIsDark)
{
    TexturedMesh mesh = ballOver(1.0, 0.0);
    for (Vec3& n : mesh.normals) {
        n = -1.0 * n;
    }
    for (const float value : opennessOf(mesh)) {
        EXPECT_EQ(value, 0.0F);
    }
}

}  // namespace
}  // namespace droplet
