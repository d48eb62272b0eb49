// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/half_edges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace droplet {
namespace {

std::vector<Vec3> places(std::size_t count)
{
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < count; ++i) {
        result.push_back({static_cast<double>(i), 0.0, 0.0});
    }
    return result;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> edgesOf(const Triangle& t)
{
    return {std::minmax(t[0], t[1]), std::minmax(t[1], t[2]), std::minmax(t[2], t[0])};
}

TEST(HalfEdges, StoreEveryTriangleOfAnySoup)
{
    constexpr std::uint32_t kPlaces = 7;
    std::mt19937 random(5);
    ::testing::internal::CaptureStderr();
    for (int run = 0; run < 2000; ++run) {
        std::vector<Triangle> triangles(1 + random() % 9);
        for (Triangle& triangle : triangles) {
            for (std::uint32_t& place : triangle) {
                place = static_cast<std::uint32_t>(random() % kPlaces);
            }
        }
        const HalfEdges found = halfEdges(places(kPlaces), triangles);
        ASSERT_EQ(found.mesh.n_faces(), triangles.size());
        for (const auto face : found.mesh.faces()) {
            const Triangle& triangle = triangles[found.triangles[static_cast<std::size_t>(face.idx())]];
            std::vector<double> corners;
            for (const auto vertex : face.vertices()) {
                corners.push_back(found.mesh.point(vertex)[0]);  // NOLINT(cppcoreguidelines-slicing)
            }
            std::rotate(corners.begin(), std::find(corners.begin(), corners.end(), triangle[0]), corners.end());
            EXPECT_THAT(corners, ::testing::Contains(triangle[2]));
        }
        UnionFind joined = joinedAcrossEdges(found, triangles);
        UnionFind expected(triangles.size());
        for (std::uint32_t a = 0; a < triangles.size(); ++a) {
            for (std::uint32_t b = 0; b < a; ++b) {
                const auto edges = edgesOf(triangles[a]);
                const auto others = edgesOf(triangles[b]);
                if (std::any_of(edges.begin(), edges.end(), [&](const auto& e) { return others.count(e) > 0; })) {
                    expected.join(a, b);
                }
            }
        }
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            ASSERT_EQ(joined.find(t), expected.find(t)) << "run " << run;
        }
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(HalfEdges, StoreTrianglesThatDoNotFitSeparately)
{
    const auto separate = [](const std::vector<Triangle>& triangles) {
        return halfEdges(places(8), triangles).separate;
    };
    EXPECT_THAT(separate({{0, 1, 2}, {1, 0, 3}}), ::testing::IsEmpty());
    EXPECT_THAT(separate({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), ::testing::ElementsAre(2));
    EXPECT_THAT(separate({{0, 1, 1}, {0, 1, 2}, {0, 1, 2}}), ::testing::ElementsAre(0, 2));
    // A closed vertex takes no more triangles.
    EXPECT_THAT(separate({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}}), ::testing::ElementsAre(3));
}

TEST(HalfEdges, LeaveOpenMeshsMessagesAsTheyWere)
{
    ASSERT_TRUE(omerr().is_enabled());
    (void)halfEdges(places(3), {{0, 1, 2}, {0, 1, 2}});
    EXPECT_TRUE(omerr().is_enabled());
    omerr().disable();
    (void)halfEdges(places(3), {{0, 1, 2}, {0, 1, 2}});
    EXPECT_FALSE(omerr().is_enabled());
    omerr().enable();
}

}  // namespace
}  // namespace droplet
