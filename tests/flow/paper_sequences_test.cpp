// SPDX-License-Identifier: GPL-3.0-or-later
// What the paper says of its animated sequences (Fournier, Habibi and Poulin 1998, section 5).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/units.h"

namespace droplet {
namespace {

struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;

    /// A grid of n × m cells over the unit square, mapped into space.
    template <typename Place>
    void addGrid(std::uint32_t n, std::uint32_t m, const Place& place)
    {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        for (std::uint32_t j = 0; j <= m; ++j) {
            for (std::uint32_t i = 0; i <= n; ++i) {
                vertices.push_back(place(static_cast<double>(i) / n, static_cast<double>(j) / m));
            }
        }
        for (std::uint32_t j = 0; j < m; ++j) {
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t a = first + j * (n + 1) + i;
                triangles.push_back({a, a + 1, a + n + 2});
                triangles.push_back({a, a + n + 2, a + n + 1});
            }
        }
    }
};

constexpr double kSlope = 30.0 * kDegree;

Vec3 onSlope(double x, double y)
{
    return {x, y, std::tan(kSlope) * y};
}

FlowTerrain slope(std::uint32_t n)
{
    Mesh mesh;
    mesh.addGrid(n, n, [](double u, double v) { return onSlope(0.3 * u, 0.3 * v); });
    return FlowTerrain(flowSurface(mesh.vertices, mesh.triangles));
}

FlowParameters paper(double friction)
{
    FlowParameters parameters;
    parameters.model = FlowModel::Paper;
    parameters.friction = friction;
    parameters.adhesion = 1e6;
    return parameters;
}

double speedOf(const FlowSample& sample)
{
    return length(sample.velocity);
}

TEST(PaperSequences, HeavyDropletsAreFasterAndMergeWithLightOnes)
{
    const FlowTerrain scene = slope(16);
    const FlowParameters parameters = paper(2e-4);
    // Masses 1 to 4 side by side; in the last column a heavy droplet behind a light one.
    std::vector<FlowStart> starts;
    for (int k = 1; k <= 4; ++k) {
        starts.push_back({onSlope(0.05 * k, 0.28), k * 10e-9, {}});
    }
    starts.push_back({onSlope(0.25, 0.29), 40e-9, {}});
    starts.push_back({onSlope(0.25, 0.27), 10e-9, {}});
    FlowState state = advanceFlow(startFlow(scene, parameters, starts), scene, parameters, 0.05);
    std::vector<FlowSample> samples = sampleFlow(state, scene, parameters);
    for (std::size_t k = 1; k < 4; ++k) {
        EXPECT_GT(speedOf(samples[k]), speedOf(samples[k - 1]));
        EXPECT_LT(samples[k].place.y, samples[k - 1].place.y);
    }
    double before = 0.0;
    while (state.counts.merged == 0) {
        before = speedOf(sampleFlow(state, scene, parameters)[4]);
        state = advanceFlow(std::move(state), scene, parameters, state.time + parameters.step);
        ASSERT_LT(state.time, 1.0);
    }
    samples = sampleFlow(state, scene, parameters);
    ASSERT_EQ(samples.size(), 5U);
    EXPECT_NEAR(samples[4].volume, 50e-9, 1e-20);
    EXPECT_LT(speedOf(samples[4]), 0.97 * before);
}

TEST(PaperSequences, SpeedFallsWithTheViscosityOfTheGround)
{
    const FlowTerrain scene = slope(3);
    FlowParameters parameters = paper(1e-3);
    for (const FlowSurface::Face& face : scene.surface().faces) {
        const double x = (face.corners[0].x + face.corners[1].x + face.corners[2].x) / 3.0;
        parameters.ground.friction.push_back(x < 0.1 ? 1.0 : x < 0.2 ? 10.0 : 100.0);
    }
    std::vector<FlowStart> starts;
    for (const double x : {0.05, 0.15, 0.25}) {
        starts.push_back({onSlope(x, 0.25), 20e-9, {}});
    }
    const FlowState state = advanceFlow(startFlow(scene, parameters, starts), scene, parameters, 0.5);
    const std::vector<FlowSample> samples = sampleFlow(state, scene, parameters);
    const double terminal = 998.2 * 20e-9 * 9.81 * std::sin(kSlope) / 1e-3;
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(speedOf(samples[k]), terminal * std::pow(10.0, -static_cast<double>(k)), 1e-6 * terminal);
    }
}

TEST(PaperSequences, DropletsLeaveASphereLaterTheStrongerTheyAdhere)
{
    Mesh mesh;
    constexpr double kRadius = 0.1;
    mesh.addGrid(192, 96, [](double u, double v) {
        const double turn = 2.0 * std::numbers::pi * u;
        const double polar = std::numbers::pi * (1.0 - v);
        const double around = u == 1.0 ? 0.0 : turn;
        const double s = v == 0.0 || v == 1.0 ? 0.0 : std::sin(polar);
        return Vec3{kRadius * s * std::cos(around), kRadius * s * std::sin(around), kRadius * std::cos(polar)};
    });
    const FlowTerrain scene(flowSurface(mesh.vertices, mesh.triangles));
    double angle = 0.0;
    for (const double adhesion : {0.0, 2.5, 5.0, 10.0}) {
        FlowParameters parameters = paper(1e-5);
        parameters.adhesion = adhesion;
        // At rest near the top.
        const std::vector<FlowStart> starts{{{kRadius * std::sin(0.2), 0.0, kRadius * std::cos(0.2)}, 20e-9, {}}};
        FlowState state = startFlow(scene, parameters, starts);
        Vec3 place;
        while (state.counts.launches == 0 && state.time < 3.0) {
            place = sampleFlow(state, scene, parameters)[0].place;
            state = advanceFlow(std::move(state), scene, parameters, state.time + parameters.step);
        }
        const double left_at = std::acos(std::clamp(place.z / kRadius, -1.0, 1.0));
        EXPECT_GT(left_at, angle + 2.0 * kDegree) << adhesion;
        angle = left_at;
    }
    // Without adhesion and friction it is 48.2°, from the height 2/3.
    EXPECT_GT(angle, 58.0 * kDegree);
}

TEST(PaperSequences, RoughGroundHoldsSmallDroplets)
{
    const FlowTerrain scene = slope(16);
    FlowParameters parameters = paper(2e-4);
    const double small = capOf(1e-9, parameters.forces.wetting.contact_angle).height;
    parameters.roughness = 0.98 * small;
    const std::vector<FlowStart> starts{{onSlope(0.1, 0.25), 1e-9, {}}, {onSlope(0.2, 0.25), 64e-9, {}}};
    const FlowState state = advanceFlow(startFlow(scene, parameters, starts), scene, parameters, 0.2);
    const std::vector<FlowSample> samples = sampleFlow(state, scene, parameters);
    EXPECT_LT(0.25 - samples[0].place.y, 1e-3);
    EXPECT_GT(0.25 - samples[1].place.y, 2e-2);
}

TEST(PaperSequences, ADropletSpeedsUpOnAStreakAndMergesWithItsMaker)
{
    const FlowTerrain scene = slope(240);
    FlowParameters parameters = paper(4e-4);
    parameters.roughness = 1.5e-3;
    // The large droplet begins above the small one, which leaves a streak.
    const std::vector<FlowStart> starts{{onSlope(0.15, 0.27), 40e-9, {}}, {onSlope(0.15, 0.18), 20e-9, {}}};
    FlowState state = startFlow(scene, parameters, starts);
    double dry = 0.0;
    double wet = 0.0;
    double merged = 0.0;
    while (merged == 0.0 && state.time < 10.0) {
        state = advanceFlow(std::move(state), scene, parameters, state.time + parameters.step);
        const std::vector<FlowSample> samples = sampleFlow(state, scene, parameters);
        const double y = samples[0].place.y;
        dry = y > 0.19 ? speedOf(samples[0]) : dry;
        if (samples.size() == 1) {
            merged = speedOf(samples[0]);
        } else if (y < 0.17) {
            wet = std::max(wet, speedOf(samples[0]));
            EXPECT_LT(speedOf(samples[1]), speedOf(samples[0]));
        }
    }
    EXPECT_GT(wet, 1.2 * dry);
    EXPECT_GT(merged, 0.0) << "it catches up";
    EXPECT_LT(merged, 0.9 * wet) << "the slower one holds it up";
}

TEST(PaperSequences, ATearLeavesTheMaskAtTheChin)
{
    // The front of a head of about 2000 triangles: an ellipsoid with a nose and a chin, open behind. It looks to −y.
    Mesh mesh;
    mesh.addGrid(32, 32, [](double u, double v) {
        const double x = 2.0 * u - 1.0;
        const double z = 2.0 * v - 1.0;
        const double nose = 0.25 * std::exp(-40.0 * x * x - 25.0 * (z + 0.05) * (z + 0.05));
        const double chin = 0.15 * std::exp(-8.0 * x * x - 30.0 * (z + 0.75) * (z + 0.75));
        const double front = std::sqrt(std::max(1.0 - 0.8 * x * x - 0.95 * z * z, 0.0));
        return Vec3{0.075 * x, -0.09 * (front + nose + chin), 0.11 * z};
    });
    const FlowTerrain scene(flowSurface(mesh.vertices, mesh.triangles));
    FlowParameters parameters = paper(5e-4);
    parameters.adhesion = 60.0;
    FlowState state = startFlow(scene, parameters, {});
    const FlowTerrain::Point eye = scene.nearest({0.03, -0.2, 0.03});
    state = startFlow(scene, parameters, {{eye.place, 20e-9, {}}});
    Vec3 place;
    while (state.counts.launches == 0 && state.time < 10.0) {
        place = sampleFlow(state, scene, parameters)[0].place;
        state = advanceFlow(std::move(state), scene, parameters, state.time + parameters.step);
    }
    EXPECT_EQ(state.counts.launches, 1U);
    EXPECT_LT(place.z, -0.08) << "it runs down the whole cheek";
    state = advanceFlow(std::move(state), scene, parameters, state.time + 3.0);
    EXPECT_EQ(state.counts.left, 1U);
    // The streak shows its path.
    std::size_t wet = 0;
    for (const FlowState::Wetness& w : state.wetness) {
        wet += w.id != 0 ? 1 : 0;
    }
    EXPECT_GT(wet, 15U);
}

}  // namespace
}  // namespace droplet
