// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/scatter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "droplet/error.h"

namespace droplet {
namespace {

/// The unit square at z = 0 and, 0.5 above it, its half with x < 0.5; both look up.
FlowTerrain shelf()
{
    return FlowTerrain(flowSurface({{0.0, 0.0, 0.0},
                                    {1.0, 0.0, 0.0},
                                    {1.0, 1.0, 0.0},
                                    {0.0, 1.0, 0.0},
                                    {0.0, 0.0, 0.5},
                                    {0.5, 0.0, 0.5},
                                    {0.5, 1.0, 0.5},
                                    {0.0, 1.0, 0.5}},
                                   {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}));
}

bool areEqual(const std::vector<FlowStart>& a, const std::vector<FlowStart>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const FlowStart& s, const FlowStart& t) {
        return s.place == t.place && s.volume == t.volume && s.velocity == t.velocity;
    });
}

std::size_t countOf(const std::vector<FlowStart>& starts, const std::function<bool(Vec3)>& holds)
{
    return static_cast<std::size_t>(
        std::count_if(starts.begin(), starts.end(), [&](const FlowStart& start) { return holds(start.place); }));
}

TEST(Scatter, IsUniformByAreaAndReproducible)
{
    const FlowTerrain scene = shelf();
    const auto all = scatterDroplets(scene, {.count = 3000, .volumes = {.median = 5e-9, .spread = 0.5}});
    ASSERT_EQ(all.size(), 3000U);
    // Standard deviations: 26 and 27.
    EXPECT_NEAR(static_cast<double>(countOf(all, [](Vec3 p) { return p.z > 0.4; })), 1000.0, 110.0);
    EXPECT_NEAR(static_cast<double>(countOf(all, [](Vec3 p) { return p.y < 0.5; })), 1500.0, 110.0);
    std::vector<double> volumes;
    for (const FlowStart& start : all) {
        EXPECT_EQ(start.velocity, Vec3{});
        volumes.push_back(start.volume);
    }
    std::nth_element(volumes.begin(), volumes.begin() + 1500, volumes.end());
    EXPECT_NEAR(volumes[1500], 5e-9, 0.25e-9);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_TRUE(areEqual(all, scatterDroplets(scene, {.count = 3000, .volumes = {.median = 5e-9, .spread = 0.5}})));
    const auto few = scatterDroplets(scene, {.count = 10, .volumes = {.median = 5e-9, .spread = 0.5}});
    EXPECT_TRUE(areEqual(few, {all.begin(), all.begin() + 10}));
    EXPECT_FALSE(areEqual(few, scatterDroplets(scene, {.count = 10, .volumes = {5e-9, 0.5}, .seed = 2})));
    EXPECT_TRUE(scatterDroplets(scene, {.count = 0}).empty());
}

TEST(Scatter, RainMeetsWhatIsFirstAndFacesIt)
{
    const FlowTerrain scene = shelf();
    const auto wet = scatterDroplets(scene, {.count = 500, .from = Vec3{0.0, 0.0, 2.0}});
    EXPECT_EQ(countOf(wet, [](Vec3 p) { return p.z < 0.4 && p.x < 0.5 - 1e-5; }), 0U);
    EXPECT_GT(countOf(wet, [](Vec3 p) { return p.z < 0.4; }), 150U);
    EXPECT_GT(countOf(wet, [](Vec3 p) { return p.z > 0.4; }), 150U);
    EXPECT_THROW((void)scatterDroplets(scene, {.count = 1, .from = Vec3{0.0, 0.0, -1.0}}), Error);
    EXPECT_THROW((void)scatterDroplets(scene, {.count = 1, .from = Vec3{}}), Error);
}

TEST(Scatter, FollowsTheMask)
{
    const FlowTerrain scene = shelf();
    ScatterOptions options{.count = 1000};
    options.coverage = [](const FlowTerrain::Point& point) { return point.place.x < 0.1 ? 1.0 : 0.25; };
    const auto starts = scatterDroplets(scene, options);
    // On 0.2 m² with certainty, on 1.3 m² with a quarter.
    EXPECT_NEAR(static_cast<double>(countOf(starts, [](Vec3 p) { return p.x < 0.1; })), 1000.0 * 0.2 / 0.525, 65.0);
    EXPECT_NEAR(scatterArea(scene, options), 0.525, 0.05);
    EXPECT_NEAR(scatterArea(scene, {.from = Vec3{0.0, 0.0, 1.0}}), 1.0, 0.08);
    EXPECT_EQ(scatterArea(scene, {}), scene.area());
    options.coverage = [](const FlowTerrain::Point&) { return 0.0; };
    EXPECT_EQ(scatterArea(scene, options), 0.0);
    try {
        (void)scatterDroplets(scene, options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_THAT(error.what(), ::testing::HasSubstr("in the mask"));
    }
}

}  // namespace
}  // namespace droplet
