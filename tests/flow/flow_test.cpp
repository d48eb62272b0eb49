// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/flow.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "flow/touching.h"
#include "support/flow_scenes.h"
#include "union_find.h"

namespace droplet {
namespace {

struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;

    /// A rectangle that slopes down to −y, cut into n × n cells; upward or downward.
    void addSlope(double size, double slope, std::uint32_t n, double z = 0.0, bool is_upward = true)
    {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        for (std::uint32_t j = 0; j <= n; ++j) {
            for (std::uint32_t i = 0; i <= n; ++i) {
                const double y = size * j / n;
                vertices.push_back({size * i / n, y, z + std::tan(slope) * y});
            }
        }
        for (std::uint32_t j = 0; j < n; ++j) {
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t a = first + j * (n + 1) + i;
                const std::uint32_t b = a + 1;
                const std::uint32_t c = a + n + 2;
                const std::uint32_t d = a + n + 1;
                if (is_upward) {
                    triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
                } else {
                    triangles.insert(triangles.end(), {{a, c, b}, {a, d, c}});
                }
            }
        }
    }
};

FlowTerrain sceneOf(const Mesh& mesh)
{
    return FlowTerrain(flowSurface(mesh.vertices, mesh.triangles));
}

FlowTerrain slope(double angle = 30.0 * kDegree, std::uint32_t n = 20, double size = 0.2)
{
    Mesh mesh;
    mesh.addSlope(size, angle, n);
    return sceneOf(mesh);
}

FlowParameters paper(double friction = 1e-4)
{
    FlowParameters parameters;
    parameters.model = FlowModel::Paper;
    parameters.friction = friction;
    return parameters;
}

std::vector<FlowStart> many(int n, double angle = 30.0 * kDegree)
{
    return testing::many(n, angle);
}

FlowRain rainOf(double rainfall)
{
    FlowRain rain;
    rain.rainfall = rainfall;
    return rain;
}

FlowParameters everything()
{
    FlowParameters parameters = testing::everything();
    parameters.wind = {1.0, 0.0, 0.0};
    return parameters;
}

TEST(Flow, BytesDependOnNeitherFramesNorThreads)
{
    const FlowTerrain scene = slope();
    const FlowParameters parameters = everything();
    const auto run = [&](int frames, std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        FlowState state = startFlow(scene, parameters, many(60));
        for (int k = 1; k <= frames; ++k) {
            state = advanceFlow(std::move(state), scene, parameters, 1.0 * k / frames);
            sampleFlow(state, scene, parameters);
        }
        return bytesOf(state);
    };
    const std::string once = run(1, 1);
    EXPECT_EQ(run(24, 2), once);
    EXPECT_EQ(run(37, 4), once);
}

TEST(Flow, AccountsForAllLiquid)
{
    const FlowTerrain scene = slope(60.0 * kDegree);
    const FlowParameters parameters = everything();
    FlowState state = startFlow(scene, parameters, many(100, 60.0 * kDegree));
    for (int second = 1; second <= 4; ++second) {
        state = advanceFlow(std::move(state), scene, parameters, second);
        EXPECT_LT(std::abs(balanceOf(state).residual()), 1e-12);
    }
    EXPECT_GT(state.counts.merged, 10U);
    EXPECT_GT(state.counts.beads, 10U);
    EXPECT_GT(state.counts.left, 5U);
    EXPECT_GT(state.counts.dried, 0U);
    EXPECT_GT(balanceOf(state).dried, 0.0);
}

/// Two droplets on a corner of a box, so far from its upper edge on two sides that meet there; or on the two sides of a
/// plate.
std::size_t leftOfTwo(double from_edge, double thickness, bool both_sides)
{
    constexpr double kSize = 0.05;
    Mesh box;
    for (std::uint32_t i = 0; i < 8; ++i) {
        box.vertices.push_back({(i & 1U) * kSize, (i >> 1U & 1U) * kSize, (i >> 2U) * thickness});
    }
    box.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    const FlowTerrain terrain = sceneOf(box);
    FlowParameters parameters;
    parameters.forces.wetting.contact_angle = 90.0 * kDegree;
    parameters.forces.wetting.hysteresis = 2.0;  // they stay
    const double y = 0.4 * kSize;
    const double volume = capVolume(2e-3, 90.0 * kDegree);
    const Vec3 other = both_sides ? Vec3{from_edge, y, 0.0} : Vec3{0.0, y, thickness - from_edge};
    FlowState state = startFlow(terrain, parameters, {{{from_edge, y, thickness}, volume, {}}, {other, volume, {}}});
    state = advanceFlow(std::move(state), terrain, parameters, 0.1);
    EXPECT_LT(std::abs(balanceOf(state).residual()), 1e-12);
    return state.droplets.size();
}

// Contact circles have a radius of 2 mm.
TEST(Flow, DropletsMergeOverSharpEdges)
{
    EXPECT_EQ(leftOfTwo(1.9e-3, 0.05, false), 1U) << "they touch on the way over the edge";
    EXPECT_EQ(leftOfTwo(2.1e-3, 0.05, false), 2U) << "they are 3 mm apart, but 4.2 mm on the way over the edge";
    EXPECT_EQ(leftOfTwo(0.5e-3, 1e-3, true), 2U) << "two sides of a plate, 1 mm apart";
}

TEST(Flow, ResumesFromItsBytes)
{
    const FlowTerrain scene = slope();
    const FlowParameters parameters = everything();
    const FlowState half = advanceFlow(startFlow(scene, parameters, many(60)), scene, parameters, 0.5);
    const std::string bytes = bytesOf(half);
    FlowState again = flowStateFromBytes(bytes, scene.surface().faces.size(), "state");
    EXPECT_EQ(bytesOf(again), bytes);
    EXPECT_EQ(bytesOf(advanceFlow(std::move(again), scene, parameters, 1.0)),
              bytesOf(advanceFlow(half, scene, parameters, 1.0)));
    for (const std::size_t length : {std::size_t{0}, std::size_t{10}, bytes.size() / 2, bytes.size() - 1}) {
        EXPECT_THROW(flowStateFromBytes(bytes.substr(0, length), scene.surface().faces.size(), "state"), Error);
    }
    EXPECT_THROW(flowStateFromBytes(bytes, 1, "state"), Error);
}

TEST(Flow, MergingKeepsMassAndMomentum)
{
    const FlowTerrain scene = slope(0.0, 7);
    FlowParameters parameters = paper(0.0);
    const std::vector<FlowStart> starts{{{0.05, 0.1, 0.0}, 30e-9, {0.2, 0.008, 0.0}}, {{0.08, 0.1, 0.0}, 10e-9, {}}};
    const FlowState state = advanceFlow(startFlow(scene, parameters, starts), scene, parameters, 0.25);
    ASSERT_EQ(state.droplets.size(), 1U);
    EXPECT_EQ(state.droplets[0].id, 1U);
    EXPECT_NEAR(state.droplets[0].volume, 40e-9, 1e-22);
    const FlowSample sample = sampleFlow(state, scene, parameters)[0];
    EXPECT_NEAR(sample.velocity.x, 0.75 * 0.2, 1e-12);
    EXPECT_NEAR(sample.velocity.y, 0.75 * 0.008, 1e-12);
    // The centre of mass goes on as before: 0.75 · 0.05 + 0.25 · 0.08 at the start.
    EXPECT_NEAR(sample.place.x, 0.0575 + 0.15 * 0.25, 1e-12);
    EXPECT_NEAR(sample.place.y, 0.1 + 0.006 * 0.25, 1e-12);
}

TEST(Flow, DoesNotMergeThroughAThinSheet)
{
    Mesh mesh;
    mesh.addSlope(0.2, 0.0, 10);
    mesh.addSlope(0.2, 0.0, 10, -2e-4, false);
    mesh.addSlope(0.2, 0.0, 10, -3e-4, true);
    const FlowTerrain scene = sceneOf(mesh);
    FlowParameters parameters;
    parameters.adhesion = 1e6;
    const std::vector<FlowStart> starts{
        {{0.1, 0.1, 0.0}, 20e-9, {}}, {{0.101, 0.1, -2e-4}, 20e-9, {}}, {{0.102, 0.1, -3e-4}, 20e-9, {}}};
    const FlowState state = advanceFlow(startFlow(scene, parameters, starts), scene, parameters, 0.1);
    EXPECT_EQ(state.droplets.size(), 3U);
}

TEST(Flow, HysteresisHoldsSmallDropletsUntilTheyGrow)
{
    const FlowTerrain scene = slope();
    FlowParameters parameters;
    parameters.forces.wetting.hysteresis = 0.3;
    parameters.pinning.spread = 0.0;
    parameters.emitters = {{{0.1, 0.15, std::tan(30.0 * kDegree) * 0.15}, 20e-9, {5e-9, 0.0}}};
    FlowState state = startFlow(scene, parameters, {});
    double held = 0.0;
    while (state.time < 20.0) {
        state = advanceFlow(std::move(state), scene, parameters, state.time + 0.05);
        if (!state.droplets.empty() && state.droplets[0].contact != FlowContact::Still) {
            break;
        }
        held = state.droplets.empty() ? 0.0 : state.droplets[0].volume;
    }
    // It runs once ρ V g sin α exceeds its retention (eq. 3.2).
    const double pull = 998.2 * 9.81 * 0.5;
    EXPECT_LT(pull * held, forcesOn(parameters.forces, held).retention);
    EXPECT_GT(pull * state.droplets[0].volume, forcesOn(parameters.forces, state.droplets[0].volume).retention);
    const FlowParameters loose = paper();
    const FlowState moved = advanceFlow(startFlow(scene, loose, many(1)), scene, loose, 0.1);
    EXPECT_NE(moved.droplets[0].contact, FlowContact::Still);
}

TEST(Flow, UnevenHysteresisMakesDropletsStickAndWander)
{
    const FlowTerrain scene = slope(45.0 * kDegree, 60);
    FlowParameters parameters;
    parameters.forces.wetting.hysteresis = 0.3;
    parameters.merges = false;
    parameters.wets = false;
    std::vector<FlowStart> starts;
    for (int k = 0; k < 60; ++k) {
        const double x = 0.02 + 0.16 * k / 60;
        starts.push_back({{x, 0.19, std::tan(45.0 * kDegree) * 0.19}, 14e-9, {}});
    }
    struct Outcome {
        int still = 0;
        double aside = 0.0;  // mean [m]
    };
    const auto run = [&](double spread) {
        parameters.pinning.spread = spread;
        FlowState state = startFlow(scene, parameters, starts);
        Outcome outcome;
        state = advanceFlow(std::move(state), scene, parameters, 1.0);
        for (const FlowSample& sample : sampleFlow(state, scene, parameters)) {
            outcome.still += sample.contact == FlowContact::Still ? 1 : 0;
            outcome.aside += std::abs(sample.place.x - starts[sample.id - 1].place.x) / 60;
        }
        return outcome;
    };
    const Outcome even = run(0.0);
    EXPECT_TRUE(even.still == 0 || even.still == 60) << "all are equal";
    EXPECT_LT(even.aside, 1e-12);
    const Outcome uneven = run(0.5);
    EXPECT_GT(uneven.still, 5);
    EXPECT_LT(uneven.still, 55);
    EXPECT_GT(uneven.aside, 0.2e-3);
}

TEST(Flow, BeadsHaveManySizesAndPlaces)
{
    const FlowTerrain scene = slope(45.0 * kDegree, 60);
    FlowParameters parameters;
    parameters.forces.wetting.hysteresis = 0.1;
    parameters.streaks.film = 20e-6;
    FlowState state = startFlow(scene, parameters, {{{0.1, 0.19, std::tan(45.0 * kDegree) * 0.19}, 60e-9, {}}});
    state = advanceFlow(std::move(state), scene, parameters, 3.0);
    ASSERT_GT(state.counts.beads, 10U);
    EXPECT_LT(std::abs(balanceOf(state).residual()), 1e-12);
    double least = 1.0;
    double most = 0.0;
    double aside = 0.0;
    for (const FlowDroplet& d : state.droplets) {
        if (d.id > 1 && d.contact == FlowContact::Still) {
            least = std::min(least, d.volume);
            most = std::max(most, d.volume);
            aside = std::max(aside, std::abs(d.leg.place.x - 0.1));
        }
    }
    EXPECT_GT(most, 3.0 * least);
    EXPECT_GT(aside, 0.1e-3);
}

TEST(Flow, FollowersCatchUpOnAStreak)
{
    const FlowTerrain scene = slope(30.0 * kDegree, 200);
    FlowParameters parameters = paper(2e-4);
    parameters.merges = false;
    parameters.roughness = 1e-3;
    const double start = 0.18;
    const std::vector<FlowStart> starts{{{0.1, start, std::tan(30.0 * kDegree) * start}, 30e-9, {}}};
    const auto timeDown = [&](FlowState state, std::uint64_t id) {
        const double begun = state.time;
        for (;;) {
            state = advanceFlow(std::move(state), scene, parameters, state.time + 1.0 / 120.0);
            for (const FlowSample& s : sampleFlow(state, scene, parameters)) {
                if (s.id == id && s.place.y < 0.02) {
                    return std::pair(state.time - begun, std::move(state));
                }
            }
        }
    };
    auto [first, state] = timeDown(startFlow(scene, parameters, starts), 1);
    parameters.emitters = {{starts[0].place, 30e-9 / parameters.step, {30e-9, 0.0}}};
    state.emissions.resize(1);
    state = advanceFlow(std::move(state), scene, parameters, state.time + parameters.step);
    parameters.emitters[0].rate = 0.0;
    const double second = timeDown(std::move(state), 2).first;
    EXPECT_LT(second, 0.8 * first);
    parameters.emitters.clear();
    parameters.roughness = 0.0;
    EXPECT_NEAR(second, timeDown(startFlow(scene, parameters, starts), 1).first, 0.1 * second);
}

TEST(Flow, RainIsWhatFallsOnTheObject)
{
    const FlowTerrain scene = slope(0.0, 4);
    FlowParameters parameters;
    parameters.rain = rainOf(20.0 * kMillimetrePerHour);
    const FlowState state = advanceFlow(startFlow(scene, parameters, {}), scene, parameters, 20.0);
    const RainImpacts impacts{raindropSizes(parameters.rain->rainfall), {parameters.rain->small_diameter, 8e-3}, 0.0};
    const double expected = impacts.bound() * 0.2 * 0.2 * 20.0;
    EXPECT_NEAR(static_cast<double>(state.counts.released), expected, 3.0 * std::sqrt(expected));
    EXPECT_EQ(state.counts.raindrops, state.counts.released);
    EXPECT_EQ(state.counts.behind, 0U);
}

TEST(Flow, CountsRainOnTheBackOfASheet)
{
    const FlowTerrain scene = slope(0.0, 4);
    FlowParameters parameters;
    parameters.rain = rainOf(20.0 * kMillimetrePerHour);
    parameters.rain->from = {0.0, 0.0, -1.0};
    const FlowState state = advanceFlow(startFlow(scene, parameters, {}), scene, parameters, 2.0);
    EXPECT_EQ(state.counts.released, 0U);
    EXPECT_GT(state.counts.behind, 10U);
    EXPECT_GT(state.counts.behind_volume, 0.0);
    EXPECT_EQ(balanceOf(state).released, 0.0) << "the balance is of the liquid that is released";
    EXPECT_EQ(flowStateFromBytes(bytesOf(state), scene.surface().faces.size(), "").counts, state.counts);
}

// A droplet of 179° stands on a point; its first volume follows from what it covers, not from that point.
TEST(Flow, DewHasTheWaterThatCondensesAtEveryContactAngle)
{
    const FlowTerrain scene = slope(0.0, 20, 0.05);
    for (const double angle : {30.0, 120.0, 179.0}) {
        FlowParameters parameters;
        parameters.forces.wetting.contact_angle = angle * kDegree;
        parameters.condensation = FlowCondensation{1e-5, 3e-3};
        FlowState state = startFlow(scene, parameters, {});
        state = advanceFlow(std::move(state), scene, parameters, 2.0);
        // All of it once the surface is covered, which takes about a second.
        const double all = 2.0 * 1e-5 * scene.area();
        EXPECT_GT(balanceOf(state).released, 0.3 * all) << angle;
        EXPECT_LT(balanceOf(state).released, 1.1 * all) << angle;
    }
}

TEST(Flow, DewGrowsAndRunsAndWipes)
{
    const FlowTerrain scene = slope(80.0 * kDegree, 10, 0.08);
    FlowParameters parameters;
    parameters.forces.wetting.hysteresis = 0.1;
    parameters.condensation = FlowCondensation{2e-6, 6e-3};
    parameters.pinning.spread = 0.0;  // dew grows on droplets at rest, and on even ground the first ones all are
    // After three seconds droplets stand all over.
    FlowState state = advanceFlow(startFlow(scene, parameters, {}), scene, parameters, 3.0);
    EXPECT_EQ(state.counts.left, 0U);
    const double early = state.released.value();
    state = advanceFlow(std::move(state), scene, parameters, 5.0);
    EXPECT_NEAR(state.released.value() - early, 2.0 * 2e-6 * scene.area(), 0.1 * 2.0 * 2e-6 * scene.area());
    state = advanceFlow(std::move(state), scene, parameters, 40.0);
    EXPECT_GT(state.counts.left, 3U);
    EXPECT_GT(state.counts.merged, 100U);
}

TEST(Flow, RejectsDropletsLargerThanTheObject)
{
    const FlowTerrain scene = slope();
    EXPECT_THROW(startFlow(scene, {}, {{{0.1, 0.1, 0.05}, 1.0, {}}}), Error);
    EXPECT_THROW(startFlow(scene, {}, {{{0.1, 0.1, 0.05}, -1e-9, {}}}), Error);
    FlowParameters parameters;
    parameters.rain = rainOf(-1.0);
    EXPECT_THROW(startFlow(scene, parameters, {}), Error);
}

TEST(Touching, ConnectsAllThatSamplesFind)
{
    std::vector<MovingBall> balls;
    for (int k = 0; k < 300; ++k) {
        const auto part = [&](double by) { return std::fmod(by * (k + 1), 1.0); };
        const Vec3 from{part(0.8191725), part(0.6710436), 0.3 * part(0.5497005)};
        const Vec3 way{0.1 * (part(0.318) - 0.5), 0.1 * (part(0.217) - 0.5), 0.0};
        balls.push_back({from, from + way, k % 10 == 0 ? 0.05 : 0.02 * part(0.137), k % 3 != 0});
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
        for (std::uint32_t j = i + 1; j < balls.size(); ++j) {
            double nearest = 1.0;
            for (int s = 0; s <= 200; ++s) {
                const double share = s / 200.0;
                nearest =
                    std::min(nearest, length(balls[j].from - balls[i].from +
                                             share * ((balls[j].to - balls[j].from) - (balls[i].to - balls[i].from))));
            }
            if (nearest < balls[i].reach + balls[j].reach && (balls[i].changed || balls[j].changed)) {
                expected.emplace_back(i, j);
            }
        }
    }
    // Pairs connect the same balls.
    const auto sets_of = [&](const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
        UnionFind sets(balls.size());
        for (const auto& [i, j] : pairs) {
            sets.join(i, j);
        }
        std::vector<std::uint32_t> names;
        for (std::uint32_t k = 0; k < balls.size(); ++k) {
            names.push_back(sets.find(k));
        }
        return names;
    };
    const auto check = [&](const std::vector<std::pair<std::uint32_t, std::uint32_t>>& found) {
        const std::vector<std::uint32_t> names = sets_of(found);
        for (const auto& [i, j] : expected) {
            EXPECT_EQ(names[i], names[j]);
        }
        // Samples miss grazes of less than a step.
        const auto count = [](std::vector<std::uint32_t> of) { return std::set(of.begin(), of.end()).size(); };
        EXPECT_GE(count(names) + 2, count(sets_of(expected)));
        EXPECT_LE(found.size(), expected.size() + 2);
    };
    EXPECT_GT(expected.size(), 10U);
    check(connectingPairs(balls, [](std::uint32_t, std::uint32_t) { return true; }));
    EXPECT_TRUE(connectingPairs(balls, [](std::uint32_t, std::uint32_t) { return false; }).empty());
    // Some may not join: the others are connected as if these were not there.
    const auto odd = [](std::uint32_t i, std::uint32_t j) { return i % 2 == 1 && j % 2 == 1; };
    std::erase_if(expected, [&](const auto& pair) { return !odd(pair.first, pair.second); });
    check(connectingPairs(balls, odd));
}

TEST(Touching, ConnectsBallsThatLieOnOneAnotherInLinearWork)
{
    std::vector<MovingBall> balls;
    for (int k = 0; k < 20000; ++k) {
        const Vec3 place{1e-3 * std::fmod(0.618 * k, 1.0), 1e-3 * std::fmod(0.755 * k, 1.0), 0.0};
        balls.push_back({place, place, 2e-3, true});
    }
    std::atomic<std::size_t> asked = 0;
    const auto pairs = connectingPairs(balls, [&](std::uint32_t, std::uint32_t) {
        ++asked;
        return true;
    });
    EXPECT_LT(asked, 9 * balls.size()) << "all pairs are 2e8";
    UnionFind sets(balls.size());
    std::size_t joined = 0;
    for (const auto& [i, j] : pairs) {
        joined += sets.join(i, j) ? 1 : 0;
    }
    EXPECT_EQ(joined, balls.size() - 1);
}

}  // namespace
}  // namespace droplet
