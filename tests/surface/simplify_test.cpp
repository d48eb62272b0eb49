// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/surface/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/shape/solve.h"
#include "droplet/surface/loft.h"
#include "support/domains.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;

Surface lofted(const Domain& domain, std::size_t triangles, bool open = false)
{
    SolveOptions options;
    options.fill = {FillBy::Height, 0.05, FillSharing::Each};
    const Solution solution = solve(triangulate(domain, {.triangles = triangles, .edge = {}}), options);
    return loft(solution.droplets, {.open = open, .extent = domain.extent});
}

auto dataOf(const Surface& surface, std::size_t v)
{
    const Vec3 p = surface.vertices[v];
    const Vec3 n = surface.normals[v];
    return std::tuple(p.x, p.y, p.z, n.x, n.y, n.z, surface.uvs[v].x, surface.uvs[v].y, surface.contact_angle[v]);
}

TEST(Simplify, KeepsTopologyAndVertices)
{
    for (const auto& [name, domain] : testing::zoo()) {
        SCOPED_TRACE(name);
        const Surface whole = lofted(domain, 5000);
        const Topology before = topology(whole);
        std::map<decltype(dataOf(whole, 0)), int> known;
        for (std::size_t v = 0; v < whole.vertices.size(); ++v) {
            ++known[dataOf(whole, v)];
        }
        for (const std::size_t wanted : {3000U, 1000U}) {
            const auto [level, error] = simplify(whole, wanted);
            ASSERT_NO_THROW(level.validate());
            EXPECT_LE(level.triangles.size(), std::max<std::size_t>(wanted, 1000));
            const Topology after = topology(level);
            EXPECT_EQ(after.closed, before.closed);
            EXPECT_EQ(after.euler, before.euler);
            EXPECT_EQ(after.components, before.components);
            ASSERT_EQ(level.parts.size(), whole.parts.size());
            EXPECT_EQ(level.mean_height, whole.mean_height);
            for (std::size_t v = 0; v < level.vertices.size(); ++v) {
                ASSERT_TRUE(known.contains(dataOf(level, v)));
            }
        }
    }
}

// A cap's volume differs by the second order of its edges: a quarter of the triangles, four times the error.
TEST(Simplify, VolumeAndErrorConverge)
{
    const Surface whole = lofted(domainOf(ellipseLoop(1, 1)), 12'000);
    const double volume = enclosedVolume(whole);
    double last = std::numeric_limits<double>::infinity();
    for (const std::size_t triangles : {200U, 800U, 3200U}) {
        const auto [level, error] = simplify(whole, triangles);
        EXPECT_LE(level.triangles.size(), triangles);
        EXPECT_LT(std::abs(enclosedVolume(level) / volume - 1.0), 20.0 / static_cast<double>(triangles));
        EXPECT_LT(error, 0.4 * last);
        last = error;
    }
    EXPECT_GT(last, 0.0);
}

TEST(Simplify, ChangesNothingThatIsSmallEnough)
{
    const Surface whole = lofted(domainOf(ellipseLoop(1, 0.5)), 1000, true);
    const auto [level, error] = simplify(whole, whole.triangles.size());
    EXPECT_EQ(level.triangles, whole.triangles);
    EXPECT_EQ(error, 0.0);
    EXPECT_THROW(simplify(whole, 0), Error);
    const SimplifiedSurface open = simplify(whole, 300);
    EXPECT_LE(open.surface.triangles.size(), 300U);
    EXPECT_EQ(topology(open.surface).boundary_loops, 1U);
}

TEST(Welded, HasOneVertexForEachPlace)
{
    for (const auto& [name, domain] : testing::zoo()) {
        SCOPED_TRACE(name);
        const Surface whole = lofted(domain, 2000);
        const Surface one = welded(whole);
        ASSERT_NO_THROW(one.validate());
        std::size_t places = 0;
        for (std::uint32_t v = 0; v < whole.weld.size(); ++v) {
            places += whole.weld[v] == v ? 1 : 0;
        }
        EXPECT_LT(places, whole.vertices.size());
        EXPECT_EQ(one.vertices.size(), places);
        EXPECT_EQ(one.triangles.size(), whole.triangles.size());
        EXPECT_EQ(topology(one).euler, topology(whole).euler);
        EXPECT_TRUE(topology(one).closed);
        for (std::uint32_t v = 0; v < one.weld.size(); ++v) {
            ASSERT_EQ(one.weld[v], v);
        }
    }
}

// Changes by a refill go with their vertices.
TEST(Simplify, KeepsTheRefill)
{
    Surface whole = lofted(domainOf(ellipseLoop(1, 1)), 2000);
    RefillState state{2.0, whole.vertices, whole.normals};
    whole.refill = Refill{0.0, 2.0, {state}};
    const Surface level = simplify(whole, 500).surface;
    ASSERT_NO_THROW(level.validate());
    EXPECT_EQ(level.refill->states.front().vertices, level.vertices);
    EXPECT_EQ(level.refill->states.front().normals, level.normals);
}

}  // namespace
}  // namespace droplet
