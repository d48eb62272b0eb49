// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/surface/surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "support/surfaces.h"
#include "surface/half_edges.h"

namespace droplet {
namespace {

using testing::polygonArea;
using testing::roundDroplet;
using testing::soup;
using testing::together;

struct Expected {
    long euler;
    std::size_t components;
    std::size_t loops;
};

void expectManifold(const Surface& surface, const Expected& expected)
{
    for (const Topology& found : {topology(surface), topology(halfEdges(surface))}) {
        EXPECT_TRUE(found.manifold);
        EXPECT_EQ(found.closed, expected.loops == 0);
        EXPECT_EQ(found.euler, expected.euler);
        EXPECT_EQ(found.components, expected.components);
        EXPECT_EQ(found.boundary_loops, expected.loops);
    }
    EXPECT_EQ(isClosed(surface), expected.loops == 0);
}

void expectSame(const Topology& a, const Topology& b)
{
    EXPECT_EQ(a.manifold, b.manifold);
    EXPECT_EQ(a.closed, b.closed);
    EXPECT_EQ(a.euler, b.euler);
    EXPECT_EQ(a.components, b.components);
    EXPECT_EQ(a.boundary_loops, b.boundary_loops);
}

void expectNoManifold(const Surface& surface)
{
    for (const Topology& found : {topology(surface), topology(halfEdges(surface))}) {
        EXPECT_FALSE(found.manifold);
        EXPECT_FALSE(found.closed);
        EXPECT_EQ(found.euler, 0);
        EXPECT_EQ(found.components, 0U);
        EXPECT_EQ(found.boundary_loops, 0U);
    }
    EXPECT_FALSE(isClosed(surface));
}

TEST(Topology, AClosedDropletIsASphere)
{
    expectManifold(roundDroplet(), {2, 1, 0});
}

TEST(Topology, AHoleMakesATorus)
{
    expectManifold(roundDroplet({.inner = 1e-3}), {0, 1, 0});
}

TEST(Topology, AnOpenDropletIsADisc)
{
    expectManifold(roundDroplet({.open = true}), {1, 1, 1});
}

TEST(Topology, AnOpenDropletWithAHoleIsARing)
{
    expectManifold(roundDroplet({.inner = 1e-3, .open = true}), {0, 1, 2});
}

TEST(Topology, DropletsAddUp)
{
    const Surface ring = roundDroplet({.inner = 1e-3, .centre = {-5e-3, 0.0}});
    const Surface disc = roundDroplet({.centre = {5e-3, 0.0}});
    const Surface dome = roundDroplet({.open = true, .centre = {5e-3, 9e-3}});
    expectManifold(together(disc, roundDroplet({.centre = {-5e-3, 0.0}})), {4, 2, 0});
    expectManifold(together(ring, disc), {2, 2, 0});
    expectManifold(together(together(ring, disc), dome), {3, 3, 1});
}

TEST(Topology, DomeAndBaseAreTwoDiscsWithoutWelding)
{
    Surface surface = roundDroplet();
    for (std::uint32_t i = 0; i < surface.weld.size(); ++i) {
        surface.weld[i] = i;
    }
    expectManifold(surface, {2, 2, 2});
}

TEST(Topology, VerticesWithoutTrianglesDoNotCount)
{
    Surface surface = roundDroplet();
    surface.vertices.push_back({9.0, 9.0, 9.0});
    surface.normals.push_back({1.0, 0.0, 0.0});
    surface.uvs.emplace_back();
    surface.weld.push_back(static_cast<std::uint32_t>(surface.weld.size()));
    expectManifold(surface, {2, 1, 0});
}

TEST(Topology, TheSmallestSurfacesAreManifolds)
{
    expectManifold(soup({{0, 1, 2}}, 3), {1, 1, 1});
    expectManifold(soup({{0, 1, 2}, {0, 2, 1}}, 3), {2, 1, 0});
    expectManifold(soup({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 4), {2, 1, 0});
}

TEST(Topology, NonManifoldsAreReportedWithoutMessages)
{
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    {
        SCOPED_TRACE("three triangles at an edge");
        expectNoManifold(soup({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5));
    }
    {
        SCOPED_TRACE("one triangle wound the other way");
        Surface surface = roundDroplet();
        std::swap(surface.triangles[3][0], surface.triangles[3][1]);
        expectNoManifold(surface);
    }
    {
        SCOPED_TRACE("the same triangle twice");
        expectNoManifold(soup({{0, 1, 2}, {0, 1, 2}}, 3));
    }
    {
        SCOPED_TRACE("a triangle with a vertex twice");
        expectNoManifold(soup({{0, 1, 1}}, 2));
    }
    {
        SCOPED_TRACE("a triangle with a vertex twice only after welding");
        Surface surface = soup({{0, 1, 2}}, 3);
        surface.vertices[2] = surface.vertices[1];
        surface.weld[2] = 1;
        expectNoManifold(surface);
    }
    {
        SCOPED_TRACE("two triangles touching at a vertex");
        expectNoManifold(soup({{0, 1, 2}, {0, 3, 4}}, 5));
    }
    {
        SCOPED_TRACE("two tetrahedra touching at a vertex");
        expectNoManifold(
            soup({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 5, 4}, {0, 4, 6}, {4, 5, 6}, {5, 0, 6}}, 7));
    }
    {
        SCOPED_TRACE("a triangle touching a tetrahedron at a vertex");
        expectNoManifold(soup({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 4, 5}}, 6));
    }
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Topology, TheOrderOfTrianglesDoesNotMatter)
{
    const Surface tidy =
        together(roundDroplet({.rings = 12, .segments = 40}), roundDroplet({.inner = 1e-3, .centre = {9e-3, 0.0}}));
    std::mt19937 random(1);
    ::testing::internal::CaptureStderr();
    for (int run = 0; run < 20; ++run) {
        Surface shuffled = tidy;
        for (std::size_t i = shuffled.triangles.size(); i > 1; --i) {
            std::swap(shuffled.triangles[i - 1], shuffled.triangles[random() % i]);
        }
        expectManifold(shuffled, {2, 2, 0});
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

// Definition of a manifold: every directed edge occurs once; around every vertex all triangles are joined through edges
// at the vertex.
bool manifoldByDefinition(const std::vector<Triangle>& triangles)
{
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::map<std::uint32_t, std::vector<std::set<std::uint32_t>>> fans;  // groups of neighbours, one per fan
    for (const auto& [a, b, c] : triangles) {
        if (a == b || b == c || c == a) {
            return false;
        }
        for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
            if (!edges.insert(edge).second) {
                return false;
            }
        }
        for (const auto& [at, left, right] : {Triangle{a, b, c}, Triangle{b, c, a}, Triangle{c, a, b}}) {
            std::set<std::uint32_t> fan = {left, right};
            std::vector<std::set<std::uint32_t>> others;
            for (const std::set<std::uint32_t>& other : fans[at]) {
                if (other.count(left) + other.count(right) > 0) {
                    fan.insert(other.begin(), other.end());
                } else {
                    others.push_back(other);
                }
            }
            others.push_back(fan);
            fans[at] = others;
        }
    }
    return std::all_of(fans.begin(), fans.end(), [](const auto& entry) { return entry.second.size() == 1; });
}

TEST(Topology, AgreesWithTheDefinitionOnEverySmallSoup)
{
    constexpr std::size_t kVertices = 5;
    std::mt19937 random(2);
    int manifolds = 0;
    ::testing::internal::CaptureStderr();
    for (int run = 0; run < 20'000; ++run) {
        std::vector<Triangle> triangles(1 + random() % 6);
        for (Triangle& triangle : triangles) {
            for (std::uint32_t& vertex : triangle) {
                vertex = static_cast<std::uint32_t>(random() % kVertices);
            }
        }
        const Topology found = topology(soup(triangles, kVertices));
        ASSERT_EQ(isClosed(soup(triangles, kVertices)), found.closed);
        ASSERT_EQ(found.manifold, manifoldByDefinition(triangles)) << "run " << run;
        if (found.manifold) {
            ++manifolds;
            std::set<std::uint32_t> vertices;
            std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
            for (const auto& [a, b, c] : triangles) {
                vertices.insert({a, b, c});
                edges.insert({std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)});
            }
            ASSERT_EQ(found.euler,
                      static_cast<long>(vertices.size() + triangles.size()) - static_cast<long>(edges.size()));
            ASSERT_EQ(found.closed, 2 * edges.size() == 3 * triangles.size());
        }
        expectSame(found, topology(halfEdges(soup(triangles, kVertices))));
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_GT(manifolds, 500);
}

// Vertices with few triangles are examined in another way than those with many.
TEST(Topology, AgreesWithTheDefinitionAroundVerticesOfAnyValence)
{
    std::mt19937 random(3);
    std::map<bool, int> runs;
    for (std::uint32_t valence = 2; valence <= 30; ++valence) {
        for (int run = 0; run < 200; ++run) {
            // A wheel around vertex 0, damaged in up to two places.
            std::vector<Triangle> triangles;
            for (std::uint32_t k = 0; k < valence; ++k) {
                triangles.push_back({0, 1 + k, 1 + (k + 1) % valence});
            }
            for (auto spoils = random() % 3; spoils > 0 && !triangles.empty(); --spoils) {
                const auto at = static_cast<std::ptrdiff_t>(random() % triangles.size());
                const auto other = 1 + static_cast<std::uint32_t>(random() % valence);
                switch (random() % 4) {
                    case 0:  // a gap
                        triangles.erase(triangles.begin() + at);
                        break;
                    case 1:
                        triangles.push_back(triangles[static_cast<std::size_t>(at)]);
                        break;
                    case 2:
                        triangles[static_cast<std::size_t>(at)][1 + random() % 2] = other;
                        break;
                    default:
                        triangles.push_back({0, other, 1 + static_cast<std::uint32_t>(random() % valence)});
                }
            }
            if (triangles.empty()) {
                continue;
            }
            std::shuffle(triangles.begin(), triangles.end(), random);
            const Surface surface = soup(triangles, valence + 1);
            const Topology found = topology(surface);
            ASSERT_EQ(found.manifold, manifoldByDefinition(triangles)) << "valence " << valence << ", run " << run;
            ASSERT_EQ(isClosed(surface), found.closed);
            expectSame(found, topology(halfEdges(surface)));
            ++runs[found.manifold];
        }
    }
    EXPECT_GT(runs[true], 1000);
    EXPECT_GT(runs[false], 1000);
}

TEST(Topology, IsTheSameAtAnyNumberOfThreads)
{
    // Every ring of triangles is a component with two boundary loops.
    Surface surface = roundDroplet({.inner = 1e-3, .open = true});
    for (int k = 0; k < 8; ++k) {
        surface = together(surface, surface);
    }
    ASSERT_GT(surface.vertices.size(), 12'000U);
    for (const std::size_t threads : {1U, 4U}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        const Topology found = topology(surface);
        EXPECT_TRUE(found.manifold);
        EXPECT_EQ(found.euler, 0);
        EXPECT_EQ(found.components, 256U);
        EXPECT_EQ(found.boundary_loops, 512U);
        // A fault in the last part.
        Surface spoilt = surface;
        std::swap(spoilt.triangles.back()[0], spoilt.triangles.back()[1]);
        EXPECT_FALSE(topology(spoilt).manifold);
    }
}

TEST(EnclosedVolume, OfAPyramidIsAThirdOfBaseTimesHeight)
{
    const Surface pyramid = roundDroplet({.outer = 3e-3, .height = 2e-3, .rings = 1, .segments = 7});
    const double exact = polygonArea(3e-3, 7) * 2e-3 / 3.0;
    EXPECT_NEAR(enclosedVolume(pyramid) / exact, 1.0, 1e-14);
}

TEST(EnclosedVolume, OfAClosedSurfaceDoesNotDependOnItsPlace)
{
    Surface surface = roundDroplet({.inner = 1e-3});
    const double volume = enclosedVolume(surface);
    for (Vec3& position : surface.vertices) {
        position = position + Vec3{0.01, -0.02, 0.03};
    }
    EXPECT_NEAR(enclosedVolume(surface) / volume, 1.0, 1e-12);
}

TEST(EnclosedVolume, IsNegativeInsideOut)
{
    Surface surface = roundDroplet();
    const double volume = enclosedVolume(surface);
    EXPECT_GT(volume, 0.0);
    for (Triangle& triangle : surface.triangles) {
        std::swap(triangle[0], triangle[1]);
    }
    EXPECT_DOUBLE_EQ(enclosedVolume(surface), -volume);
}

TEST(EnclosedVolume, ABaseAtZeroAddsNothing)
{
    EXPECT_EQ(enclosedVolume(roundDroplet({.open = true})), enclosedVolume(roundDroplet()));
}

TEST(Surface, RefusesBrokenInvariants)
{
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    struct Case {
        std::function<void(Surface&)> spoil;
        const char* named;
    };
    const std::vector<Case> cases = {
        {[](Surface& s) { s.triangles.clear(); }, "surface.triangles is empty"},
        {[](Surface& s) { s.normals.pop_back(); }, "normals"},
        {[](Surface& s) { s.uvs.emplace_back(); }, "uvs"},
        {[](Surface& s) { s.weld.pop_back(); }, "weld"},
        {[](Surface& s) { s.vertices.pop_back(); }, "vertices"},
        {[](Surface& s) { s.mean_height = kNan; }, "surface.mean_height"},
        {[](Surface& s) { s.mean_height = -1e-9; }, "surface.mean_height"},
        {[](Surface& s) { s.vertices[5].y = kNan; }, "surface.vertices[5]"},
        {[](Surface& s) { s.vertices[6].z = -kInfinity; }, "surface.vertices[6]"},
        {[](Surface& s) { s.normals[7].x = kNan; }, "surface.normals[7]"},
        {[](Surface& s) { s.normals[8] = 1.001 * s.normals[8]; }, "surface.normals[8]"},
        {[](Surface& s) { s.normals[8] = {}; }, "surface.normals[8]"},
        {[](Surface& s) { s.uvs[9].x = kInfinity; }, "surface.uvs[9]"},
        {[](Surface& s) { s.contact_angle.pop_back(); }, "contact angles"},
        {[](Surface& s) { s.contact_angle.resize(1); }, "contact angles"},
        {[](Surface& s) { s.contact_angle[4] = std::numeric_limits<float>::infinity(); }, "surface.contact_angle[4]"},
        {[](Surface& s) { s.weld[3] = 4; }, "surface.weld[3]"},
        {[](Surface& s) { s.weld[3] = 2; }, "surface.weld[3]"},
        {[](Surface& s) { s.weld.back() = static_cast<std::uint32_t>(s.weld.size()); }, "surface.weld["},
        {[](Surface& s) { s.triangles[1][2] = static_cast<std::uint32_t>(s.weld.size()); }, "surface.triangles[1]"},
    };
    EXPECT_NO_THROW(roundDroplet().validate());
    EXPECT_NO_THROW(testing::withContactAngles(roundDroplet()).validate());
    for (const Case& spoilt : cases) {
        Surface surface = testing::withContactAngles(roundDroplet());
        spoilt.spoil(surface);
        try {
            surface.validate();
            ADD_FAILURE() << "accepted: " << spoilt.named;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_THAT(error.what(), ::testing::HasSubstr(spoilt.named));
        }
        EXPECT_THROW(topology(surface), Error);
        EXPECT_THROW(isClosed(surface), Error);
    }
}

TEST(Surface, NamesTheFirstFaultAtAnyNumberOfThreads)
{
    Surface surface = roundDroplet({.rings = 100, .segments = 300});
    const std::size_t count = surface.vertices.size();
    ASSERT_GT(count, 60'000U);
    const auto complaint = [&] {
        try {
            surface.validate();
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    surface.triangles[50'001][1] = surface.triangles[100'001][2] = static_cast<std::uint32_t>(count);
    for (const std::size_t threads : {1U, 4U}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_THAT(complaint(), ::testing::HasSubstr("surface.triangles[50001]"));
    }
    surface.uvs[41'234].y = surface.uvs[59'999].x = surface.normals[50'000].z = std::numeric_limits<double>::infinity();
    for (const std::size_t threads : {1U, 4U}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_THAT(complaint(), ::testing::HasSubstr("surface.uvs[41234]"));
    }
}

TEST(Surface, RefusesChainsOfWelds)
{
    Surface surface = soup({{0, 1, 2}}, 3);
    surface.vertices = {{}, {}, {}};
    surface.weld = {0, 0, 1};
    EXPECT_THROW(surface.validate(), Error);
    surface.weld = {0, 0, 0};
    EXPECT_NO_THROW(surface.validate());
}

}  // namespace
}  // namespace droplet
