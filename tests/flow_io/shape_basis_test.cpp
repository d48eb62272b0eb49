// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_io/shape_basis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "droplet/vector.h"

namespace droplet {
namespace {

Vec3 turned(Vec3 p, double angle)
{
    return {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
}

/// A grid on a ball's cap, whose part beyond x = 0 turns about the z axis, in 40 shapes.
std::vector<MeshShape> bending()
{
    std::vector<MeshShape> shapes(40);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        const double angle = std::sin(0.3 * static_cast<double>(k));
        for (int i = 0; i < 400; ++i) {
            const double x = i % 20 / 10.0 - 0.95;
            const double y = i / 20 / 10.0 - 0.95;
            const Vec3 p{x, y, std::sqrt(4.0 - x * x - y * y)};
            shapes[k].vertices.push_back(x > 0.0 ? turned(p, angle) : p);
            shapes[k].normals.push_back(0.5 * shapes[k].vertices.back());
        }
    }
    return shapes;
}

TEST(ShapeBasis, ABoneNeedsTwoChangesAndOneBackwards)
{
    const std::vector<MeshShape> shapes = bending();
    const ShapeTolerance tolerance{1e-4, 1e-2};
    const ShapeBasis basis = shapeBasis(shapes, tolerance);
    EXPECT_EQ(basis.changes.size(), 3U) << "a sine, a cosine, and both backwards";
    ASSERT_EQ(basis.weights.size(), shapes.size());
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        ASSERT_EQ(basis.weights[k].size(), basis.changes.size());
        for (const double weight : basis.weights[k]) {
            EXPECT_GE(weight, 0.0);
            EXPECT_LE(weight, 1.0);
        }
        for (std::size_t v = 0; v < shapes[k].vertices.size(); ++v) {
            Vec3 place = shapes[0].vertices[v];
            Vec3 normal = shapes[0].normals[v];
            for (std::size_t c = 0; c < basis.changes.size(); ++c) {
                place = place + basis.weights[k][c] * basis.changes[c].vertices[v];
                normal = normal + basis.weights[k][c] * basis.changes[c].normals[v];
            }
            EXPECT_LE(length(place - shapes[k].vertices[v]), tolerance.vertices * 1.001);
            EXPECT_LE(length(normal - shapes[k].normals[v]), tolerance.normals * 1.001);
        }
    }
    EXPECT_LT(*std::max_element(basis.weights[0].begin(), basis.weights[0].end()), 1e-9);
    const ShapeBasis still = shapeBasis({shapes[0], shapes[0]}, tolerance);
    EXPECT_TRUE(still.changes.empty());
    EXPECT_EQ(still.weights.size(), 2U);
}

}  // namespace
}  // namespace droplet
