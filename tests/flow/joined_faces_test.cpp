// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/joined_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/flow/flow_terrain.h"
#include "rays/nearest.h"

namespace droplet {
namespace {

/// A bowl with a wall across it, which does not reach the rim, cut into n × n cells.
FlowSurface bowl(std::uint32_t n)
{
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) {
            const double x = 0.2 * i / n - 0.1;
            const double y = 0.2 * j / n - 0.1;
            const double wall = std::abs(x) < 0.01 && y < 0.06 ? 0.05 * (1.0 - std::abs(x) / 0.01) : 0.0;
            vertices.push_back({x, y, 4.0 * (x * x + y * y) + wall});
        }
    }
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            triangles.insert(triangles.end(), {{a, a + 1, a + n + 2}, {a, a + n + 2, a + n + 1}});
        }
    }
    return flowSurface(vertices, triangles);
}

/// The same by a search for each question.
bool isJoined(const FlowSurface& surface, const FlowTerrain::Point& from, std::uint32_t to, double reach)
{
    std::vector<std::uint32_t> open{from.face};
    std::set<std::uint32_t> seen{from.face};
    for (std::size_t i = 0; i < open.size(); ++i) {
        for (const std::uint32_t next : surface.faces[open[i]].neighbour) {
            if (next != FlowSurface::kNone && !seen.contains(next) &&
                distance(from.place, surface.faces[next].corners) <= reach) {
                seen.insert(next);
                open.push_back(next);
            }
        }
    }
    return seen.contains(to);
}

TEST(JoinedFaces, AreThoseOfASearchForEachQuestion)
{
    const FlowTerrain terrain(bowl(40));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::size_t joined = 0;
    std::size_t apart = 0;
    for (int droplet = 0; droplet < 12; ++droplet) {
        const FlowTerrain::Point from = terrain.pointAt(uniform(random), uniform(random));
        JoinedFaces faces(terrain.surface(), from.face, from.place);
        for (int question = 0; question < 60; ++question) {
            const FlowTerrain::Point to = terrain.pointAt(uniform(random), uniform(random));
            // Often too short to go around the wall.
            const double reach = (question % 3 == 0 ? uniform(random) : 1.0 + 1e-9) * length(to.place - from.place);
            const bool expected = isJoined(terrain.surface(), from, to.face, reach);
            EXPECT_EQ(faces.has(to.face, reach), expected);
            (expected ? joined : apart) += 1;
        }
    }
    EXPECT_GT(joined, 100U);
    EXPECT_GT(apart, 100U);
}

// A plate of 96 800 triangles under one puddle: what falls into it far from its middle becomes part of it.
TEST(JoinedFaces, APuddleTakesUpWhatFallsIntoItAnywhere)
{
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    constexpr std::uint32_t kCells = 220;
    for (std::uint32_t j = 0; j <= kCells; ++j) {
        for (std::uint32_t i = 0; i <= kCells; ++i) {
            vertices.push_back({0.2 * i / kCells, 0.2 * j / kCells, 0.0});
        }
    }
    for (std::uint32_t j = 0; j < kCells; ++j) {
        for (std::uint32_t i = 0; i < kCells; ++i) {
            const std::uint32_t a = j * (kCells + 1) + i;
            triangles.insert(triangles.end(), {{a, a + 1, a + kCells + 2}, {a, a + kCells + 2, a + kCells + 1}});
        }
    }
    const FlowTerrain plate(flowSurface(vertices, triangles));
    FlowParameters parameters;
    std::vector<FlowStart> starts{{{0.1, 0.1, 0.0}, 1e-4, {}}};
    const double radius = capOf(1e-4, parameters.forces.wetting.contact_angle).contact_radius;
    ASSERT_GT(radius, 0.03);
    for (int k = 0; k < 16; ++k) {
        const double turn = 0.4 * k;
        const double out = 0.95 * radius;
        starts.push_back({{0.1 + out * std::cos(turn), 0.1 + out * std::sin(turn), 0.0}, 2e-9, {}});
    }
    FlowState state = startFlow(plate, parameters, starts);
    state = advanceFlow(std::move(state), plate, parameters, 2.0 * parameters.step);
    EXPECT_EQ(state.droplets.size(), 1U);
    EXPECT_EQ(state.counts.merged, 16U);
}

}  // namespace
}  // namespace droplet
