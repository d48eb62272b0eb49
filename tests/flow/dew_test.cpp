// SPDX-License-Identifier: GPL-3.0-or-later
// Droplets at rest that cover an object: how many, how large, none on another, none that its slope does not hold.
#include "droplet/flow/dew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "support/objects.h"

namespace droplet {
namespace {

/// Rectangle through the origin.
/// @param slope  from the horizontal, down to −x [rad]
FlowTerrain plane(double width, double height, double slope = 0.0)
{
    testing::Sheet sheet;
    sheet.place = [&](Vec2 uv) {
        const double along = height * (uv.y - 0.5);
        return Vec3{along * std::cos(slope), width * (uv.x - 0.5), along * std::sin(slope)};
    };
    const TexturedMesh mesh = testing::meshOf(sheet);
    return FlowTerrain(flowSurface(mesh.vertices, mesh.triangles));
}

double radiusOf(const FlowSample& sample, const DewOptions& options)
{
    return dewRadius(sample.volume, options.forces.wetting.contact_angle);
}

/// Balls of droplets, as far as they lean out, do not meet.
void expectApart(const DewDroplets& dew, const DewOptions& options)
{
    const double angle = options.forces.wetting.contact_angle;
    std::vector<Vec3> centres;
    std::vector<double> radii;
    for (const FlowSample& sample : dew.samples) {
        centres.push_back(sample.place +
                          std::max(0.0, -std::cos(angle)) * capOf(sample.volume, angle).radius * sample.normal);
        radii.push_back(radiusOf(sample, options));
    }
    for (std::size_t i = 0; i < centres.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            ASSERT_GE(length(centres[i] - centres[k]), radii[i] + radii[k] - 1e-12);
        }
    }
}

TEST(Dew, CoversTheShareThatIsAskedFor)
{
    const FlowTerrain terrain = plane(0.1, 0.1);
    for (const double coverage : {0.05, 0.4, 0.6}) {
        DewOptions options;
        options.coverage = coverage;
        const DewDroplets dew = dewDroplets(terrain, options);
        EXPECT_NEAR(dew.area, 0.01, 1e-12);
        // One droplet may exceed it; liquid of droplets that join covers less than before.
        EXPECT_NEAR(dew.covered / dew.area, coverage, 0.01) << dew.joined << " joined";
        double covered = 0.0;
        for (const FlowSample& sample : dew.samples) {
            covered += std::numbers::pi * std::pow(radiusOf(sample, options), 2);
        }
        EXPECT_NEAR(dew.covered / covered, 1.0, 1e-9);
        EXPECT_EQ(dew.run_off, 0U) << "the ground is level";
    }
}

TEST(Dew, DropletsDoNotTouch)
{
    const FlowTerrain terrain = plane(0.04, 0.04);
    for (const DewSizes sizes : {DewSizes::Condensation, DewSizes::LogNormal}) {
        DewOptions options;
        options.sizes = sizes;
        options.coverage = 0.6;
        options.smallest = 0.1e-3;
        const DewDroplets dew = dewDroplets(terrain, options);
        ASSERT_GT(dew.samples.size(), 500U);
        expectApart(dew, options);
    }
}

TEST(Dew, FullSurfacesMakeDropletsJoin)
{
    const FlowTerrain terrain = plane(0.03, 0.03);
    DewOptions options;
    options.coverage = 0.7;
    options.smallest = 0.9e-3;
    options.largest = 1e-3;
    const DewDroplets dew = dewDroplets(terrain, options);
    EXPECT_GT(dew.joined, 10U) << "discs of one size find no room beyond 0.55";
    double most = 0.0;
    for (const FlowSample& sample : dew.samples) {
        most = std::max(most, radiusOf(sample, options));
    }
    EXPECT_GT(most, 1.1e-3);
    expectApart(dew, options);
}

/// Largest difference of the cumulated distribution of radii from a law: Kolmogorov and Smirnov.
template <typename Law>
double differenceFrom(const DewDroplets& dew, const DewOptions& options, const Law& law)
{
    std::vector<double> radii;
    for (const FlowSample& sample : dew.samples) {
        radii.push_back(radiusOf(sample, options));
    }
    std::sort(radii.begin(), radii.end());
    double most = 0.0;
    for (std::size_t i = 0; i < radii.size(); ++i) {
        most = std::max(most,
                        std::abs(law(radii[i]) - (static_cast<double>(i) + 0.5) / static_cast<double>(radii.size())));
    }
    return most * std::sqrt(static_cast<double>(radii.size()));
}

constexpr double kOneInAThousand = 1.95;  // exceeded so often by chance

TEST(Dew, RadiiOfCondensationFollowRosesLaw)
{
    DewOptions options;
    options.coverage = 0.2;  // few join
    const DewDroplets dew = dewDroplets(plane(0.2, 0.2), options);
    ASSERT_GT(dew.samples.size(), 5000U);
    const double low = std::pow(options.smallest, -5.0 / 3.0);
    const double high = std::pow(options.largest, -5.0 / 3.0);
    EXPECT_LT(differenceFrom(dew, options, [&](double r) { return (low - std::pow(r, -5.0 / 3.0)) / (low - high); }),
              kOneInAThousand);
}

TEST(Dew, RadiiOfRainAreLogNormal)
{
    DewOptions options;
    options.sizes = DewSizes::LogNormal;
    options.coverage = 0.1;
    options.smallest = 1e-5;
    options.largest = 0.1;
    options.median = 0.5e-3;
    options.spread = 0.4;
    const DewDroplets dew = dewDroplets(plane(0.3, 0.3), options);
    ASSERT_GT(dew.samples.size(), 5000U);
    EXPECT_LT(differenceFrom(dew, options,
                             [&](double r) {
                                 return 0.5 *
                                        std::erfc(-std::log(r / options.median) / (options.spread * std::sqrt(2.0)));
                             }),
              kOneInAThousand);
}

TEST(Dew, SlopesHoldEveryDroplet)
{
    const FlowTerrain wall = plane(0.1, 0.1, 90.0 * kDegree);
    DewOptions options;
    options.sizes = DewSizes::LogNormal;
    options.smallest = 0.1e-3;
    options.median = 1e-3;
    options.largest = 6e-3;
    options.spread = 0.8;
    options.pinning.spread = 0.0;
    const DewDroplets dew = dewDroplets(wall, options);
    EXPECT_GT(dew.run_off, 0U);
    double most = 0.0;
    for (const FlowSample& sample : dew.samples) {
        const DropletForces forces = forcesOn(options.forces, sample.volume);
        most = std::max(most, forces.weight / forces.retention);
    }
    EXPECT_LE(most, 1.0);
    EXPECT_GT(most, 0.8) << "some are nearly as large as may be";
    options.forces.wetting.hysteresis = 2.0;
    EXPECT_LT(dewDroplets(wall, options).run_off, dew.run_off) << "more hysteresis holds more";
}

TEST(Dew, SteepDropletsKeepTheDistanceOfTheirEquators)
{
    DewOptions options;
    options.forces.wetting.contact_angle = 150.0 * kDegree;
    const DewDroplets dew = dewDroplets(plane(0.03, 0.03), options);
    EXPECT_NEAR(dew.covered / dew.area, options.coverage, 0.01);
    for (const FlowSample& sample : dew.samples) {
        const CapSize cap = capOf(sample.volume, options.forces.wetting.contact_angle);
        EXPECT_DOUBLE_EQ(radiusOf(sample, options), cap.radius);
        EXPECT_LE(cap.radius, 1.5 * options.largest) << "sizes are those seen from above";
    }
    expectApart(dew, options);
}

TEST(Dew, CeilingsHoldOnlySmallDroplets)
{
    DewOptions options;
    options.sizes = DewSizes::LogNormal;
    options.smallest = 0.3e-3;
    options.median = 3e-3;
    options.largest = 8e-3;
    options.gravity = {0.0, 0.0, kStandardGravity};
    const FlowTerrain ceiling = plane(0.1, 0.1);
    const DewDroplets dew = dewDroplets(ceiling, options);
    EXPECT_GT(dew.run_off, 0U);
    // As flow judges: none of them falls.
    FlowParameters parameters;
    parameters.gravity = options.gravity;
    parameters.merges = false;
    std::vector<FlowStart> starts;
    for (const FlowSample& sample : dew.samples) {
        starts.push_back({sample.place, sample.volume, {}});
    }
    FlowState state = startFlow(ceiling, parameters, starts);
    state = advanceFlow(std::move(state), ceiling, parameters, 0.2);
    EXPECT_EQ(sampleFlow(state, ceiling, parameters).size(), starts.size());
    EXPECT_EQ(balanceOf(state).left, 0.0);
}

// Flow finds the same hysteresis at the same places, where it varies, too.
TEST(Dew, FlowLeavesDropletsAtRest)
{
    const FlowTerrain wall = plane(0.06, 0.06, 70.0 * kDegree);
    for (const double pinned : {0.0, 0.5, 1.0}) {
        DewOptions options;
        options.sizes = DewSizes::LogNormal;
        options.smallest = 0.3e-3;
        options.median = 1.2e-3;
        options.largest = 4e-3;
        options.pinning.spread = pinned;
        options.seed = 7;
        const DewDroplets dew = dewDroplets(wall, options);
        ASSERT_GT(dew.run_off, 0U) << "sizes are up to what slopes hold";
        FlowParameters parameters;
        parameters.gravity = options.gravity;
        parameters.pinning = options.pinning;
        parameters.seed = options.seed;
        std::vector<FlowStart> starts;
        for (const FlowSample& sample : dew.samples) {
            starts.push_back({sample.place, sample.volume, {}});
        }
        FlowState state = startFlow(wall, parameters, starts);
        state = advanceFlow(std::move(state), wall, parameters, 0.5);
        ASSERT_EQ(state.droplets.size(), starts.size());
        for (const FlowDroplet& droplet : state.droplets) {
            EXPECT_EQ(droplet.contact, FlowContact::Still) << "spread " << pinned;
        }
    }
}

// Large droplets run off a wall, and small ones take their place.
TEST(Dew, CoversWallsWithSmallerDroplets)
{
    const FlowTerrain wall = plane(0.05, 0.05, 90.0 * kDegree);
    DewOptions options;
    options.sizes = DewSizes::LogNormal;
    options.smallest = 0.3e-3;
    options.median = 1.2e-3;
    options.largest = 4e-3;
    options.spread = 0.6;
    options.coverage = 0.35;
    const DewDroplets dew = dewDroplets(wall, options);
    EXPECT_GT(dew.run_off, 0U);
    EXPECT_NEAR(dew.covered / dew.area, options.coverage, 0.02);
    expectApart(dew, options);
}

TEST(Dew, KeepsOffTheEndOfTheSurface)
{
    const FlowTerrain triangle(flowSurface({{0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.0, 0.02, 0.0}}, {{0, 1, 2}}));
    DewOptions options;
    options.smallest = 0.5e-3;
    options.largest = 3e-3;
    options.coverage = 0.6;
    const DewDroplets dew = dewDroplets(triangle, options);
    ASSERT_GT(dew.samples.size(), 5U);
    for (const FlowSample& sample : dew.samples) {
        const double contact = capOf(sample.volume, options.forces.wetting.contact_angle).contact_radius;
        const Vec3 p = sample.place;
        // Rims are looked for at every sixteenth of a turn.
        EXPECT_GT(std::min({p.x, p.y, (0.02 - p.x - p.y) / std::sqrt(2.0)}), 0.9 * contact);
    }
    expectApart(dew, options);
}

TEST(Dew, SaysWhatIsInTheWay)
{
    DewOptions options;
    options.coverage = 0.05;
    EXPECT_EQ(dewDroplets(plane(0.05, 0.05), options).obstacle, DewObstacle::None);
    options.coverage = 0.7;
    options.smallest = 0.9e-3;
    options.largest = 1e-3;
    EXPECT_EQ(dewDroplets(plane(0.03, 0.03), options).obstacle, DewObstacle::Droplets);
    const DewDroplets strip = dewDroplets(plane(1.5e-3, 0.1), options);
    EXPECT_EQ(strip.obstacle, DewObstacle::Edges);
    EXPECT_TRUE(strip.samples.empty()) << "it is narrower than a droplet";
    EXPECT_GT(strip.between_edges, 10U);
    EXPECT_EQ(strip.run_off, 0U);
    options.smallest = 4e-3;
    options.largest = 5e-3;
    const DewDroplets wall = dewDroplets(plane(0.1, 0.1, 90.0 * kDegree), options);
    EXPECT_EQ(wall.obstacle, DewObstacle::Slopes);
    EXPECT_GT(wall.run_off, 10U);
    EXPECT_EQ(wall.between_edges, 0U);
}

// A level square, and a wall as large, neither of which has room for all.
TEST(Dew, WithoutHysteresisWallsAreDryAndLevelGroundIsNotFlooded)
{
    testing::Sheet level;
    level.place = [](Vec2 uv) { return Vec3{0.03 * uv.x, 0.03 * uv.y, 0.0}; };
    level.turned = true;
    testing::Sheet wall;
    wall.place = [](Vec2 uv) { return Vec3{0.03 * uv.x, 0.05, 0.03 * uv.y}; };
    const TexturedMesh mesh = testing::together(testing::meshOf(level), testing::meshOf(wall));
    const FlowTerrain terrain(flowSurface(mesh.vertices, mesh.triangles));
    DewOptions options;
    options.forces.wetting.hysteresis = 0.0;
    const DewDroplets dew = dewDroplets(terrain, options);
    EXPECT_TRUE(std::all_of(dew.samples.begin(), dew.samples.end(),
                            [](const FlowSample& sample) { return sample.place.z < 1e-9; }));
    EXPECT_NEAR(dew.covered / (0.5 * dew.area), options.coverage, 0.02) << "as if the level square were alone";
    EXPECT_EQ(dew.obstacle, DewObstacle::Slopes);
    EXPECT_GT(dew.run_off, dew.samples.size() / 3) << "as many as fall on the wall";
}

TEST(Dew, ExtentsKeepDropletsApart)
{
    // Twice as long as wide.
    DewOptions options;
    options.extent = [&](double volume, Vec3 normal) {
        const double radius = dewRadius(volume, options.forces.wetting.contact_angle);
        return DewExtent{{}, {Vec3{2.0 * radius, 0.0, 0.0}, Vec3{0.0, radius, 0.0}, radius * normal}};
    };
    options.coverage = 0.2;
    const DewDroplets dew = dewDroplets(plane(0.03, 0.03), options);
    EXPECT_NEAR(dew.covered / dew.area, options.coverage, 0.01) << "what they cover is not what they keep free";
    std::size_t beside = 0;
    for (std::size_t i = 0; i < dew.samples.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const Vec3 apart = dew.samples[i].place - dew.samples[k].place;
            const double sum = radiusOf(dew.samples[i], options) + radiusOf(dew.samples[k], options);
            EXPECT_GE(std::hypot(0.5 * apart.x, apart.y), 0.999 * sum);
            beside += length(apart) < 1.5 * sum ? 1 : 0;
        }
    }
    EXPECT_GT(beside, 10U) << "they come near across their length";
}

TEST(Dew, ReportsItsProgress)
{
    std::vector<double> shares;
    dewDroplets(plane(0.03, 0.03), {}, [&](Stage stage, double share) {
        EXPECT_EQ(stage, Stage::Solve);
        shares.push_back(share);
    });
    ASSERT_GT(shares.size(), 50U);
    EXPECT_EQ(shares.front(), 0.0);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GT(shares.back(), 0.98);
    EXPECT_LE(shares.back(), 1.0);
}

TEST(Dew, InnerSidesAreDryUnlessAskedFor)
{
    const TexturedMesh ball = testing::ball(40, [](Vec3) { return 0.02; });
    TexturedMesh cavity = testing::ball(40, [](Vec3) { return 0.015; });
    for (Triangle& t : cavity.triangles) {
        std::swap(t[1], t[2]);
    }
    const TexturedMesh both = testing::together(ball, cavity);
    const FlowTerrain hollow(flowSurface(both.vertices, both.triangles));
    DewOptions options;
    options.largest = 0.6e-3;
    const auto inner = [&](const DewDroplets& dew) {
        return std::count_if(dew.samples.begin(), dew.samples.end(),
                             [](const FlowSample& sample) { return length(sample.place) < 0.017; });
    };
    const DewDroplets outside = dewDroplets(hollow, options);
    EXPECT_EQ(inner(outside), 0);
    EXPECT_NEAR(outside.area / (4.0 * std::numbers::pi * 0.02 * 0.02), 1.0, 0.02);
    options.inside = true;
    EXPECT_GT(inner(dewDroplets(hollow, options)), 100);
}

TEST(Dew, RainWetsOnlyWhatItMeets)
{
    const TexturedMesh mesh = testing::ball(60, [](Vec3) { return 0.02; });
    const FlowTerrain ball(flowSurface(mesh.vertices, mesh.triangles));
    DewOptions options;
    options.largest = 0.6e-3;
    const DewDroplets all = dewDroplets(ball, options);
    EXPECT_TRUE(std::any_of(all.samples.begin(), all.samples.end(),
                            [](const FlowSample& sample) { return sample.place.z < -0.01; }));
    options.from = Vec3{0.0, 0.0, 1.0};
    const DewDroplets rain = dewDroplets(ball, options);
    ASSERT_GT(rain.samples.size(), 100U);
    EXPECT_NEAR(rain.area / (0.5 * ball.area()), 1.0, 0.05);
    for (const FlowSample& sample : rain.samples) {
        EXPECT_GT(sample.place.z, -1e-3);
        EXPECT_EQ(sample.contact, FlowContact::Still);
    }
}

TEST(Dew, TwoSidesOfAThinSheetDoNotTouch)
{
    // Two sheets of 4 cm, a tenth of a millimetre apart, which face away from each other.
    testing::Sheet sheet;
    sheet.place = [](Vec2 uv) { return Vec3{0.04 * uv.x, 0.04 * uv.y, 5e-5}; };
    sheet.turned = true;
    testing::Sheet below = sheet;
    below.place = [](Vec2 uv) { return Vec3{0.04 * uv.x, 0.04 * uv.y, -5e-5}; };
    below.turned = false;
    const TexturedMesh mesh = testing::together(testing::meshOf(sheet), testing::meshOf(below));
    DewOptions options;
    options.coverage = 0.6;
    const DewDroplets dew = dewDroplets(FlowTerrain(flowSurface(mesh.vertices, mesh.triangles)), options);
    EXPECT_NEAR(dew.covered / dew.area, 0.6, 0.01) << "each side as if it were alone";
}

TEST(Dew, DependsOnTheSeedAlone)
{
    const FlowTerrain terrain = plane(0.03, 0.03);
    DewOptions options;
    const auto places = [&] {
        std::vector<Vec3> all;
        for (const FlowSample& sample : dewDroplets(terrain, options).samples) {
            all.push_back(sample.place);
        }
        return all;
    };
    const std::vector<Vec3> first = places();
    EXPECT_EQ(places(), first);
    options.seed = 2;
    EXPECT_NE(places(), first);
}

TEST(Dew, RefusesWhatCannotBe)
{
    const FlowTerrain terrain = plane(0.1, 0.1);
    const auto refused = [&](const auto& change) {
        DewOptions options;
        change(options);
        try {
            dewDroplets(terrain, options);
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::NoSuchDroplet;  // it was not refused
    };
    EXPECT_EQ(refused([](DewOptions& o) { o.coverage = 0.71; }), ErrorCode::InvalidArgument);
    EXPECT_EQ(refused([](DewOptions& o) { o.coverage = 0.0; }), ErrorCode::InvalidArgument);
    EXPECT_EQ(refused([](DewOptions& o) { o.largest = 0.1e-3; }), ErrorCode::InvalidArgument);
    EXPECT_EQ(refused([](DewOptions& o) { o.spread = -1.0; }), ErrorCode::InvalidArgument);
    EXPECT_EQ(refused([](DewOptions& o) { o.from = Vec3{}; }), ErrorCode::InvalidArgument);
    EXPECT_EQ(refused([](DewOptions& o) { o.smallest = o.largest = 1e-6; }), ErrorCode::InvalidArgument) << "too many";
    EXPECT_EQ(refused([](DewOptions& o) { o.from = Vec3{0.0, 0.0, -1.0}; }), ErrorCode::InvalidInput);
    EXPECT_EQ(refused([](DewOptions& o) { o.weight = [](const FlowTerrain::Point&) { return 0.0; }; }),
              ErrorCode::InvalidInput);
}

}  // namespace
}  // namespace droplet
