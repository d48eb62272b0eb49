// SPDX-License-Identifier: GPL-3.0-or-later
#include "expression/bays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using droplet::Bridge;
using droplet::Loop;
using droplet::ParticleFrame;
using droplet::Vec2;

constexpr double kSpacing = 0.1;

/// Circle with a point for every 0.4 spacings.
Loop circle(Vec2 centre, double radius, bool is_hole)
{
    const auto count = static_cast<std::size_t>(std::ceil(2.0 * std::numbers::pi * radius / (0.4 * kSpacing)));
    Loop loop;
    for (std::size_t k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
        loop.points.push_back(centre + Vec2{radius * std::cos(angle), radius * std::sin(is_hole ? -angle : angle)});
    }
    loop.corner.resize(count);
    return loop;
}

/// Particles that fill a disc; in its right half they part from the middle, at a rate.
ParticleFrame discOfParticles(double radius, double parting)
{
    ParticleFrame frame;
    frame.spacing = kSpacing;
    const int count = static_cast<int>(radius / kSpacing);
    for (int row = -count; row <= count; ++row) {
        for (int column = -count; column <= count; ++column) {
            const Vec2 x{kSpacing * column, kSpacing * row};
            if (std::hypot(x.x, x.y) < radius) {
                frame.position.push_back(x);
                frame.velocity.push_back({0.0, x.x > 0.0 ? parting * x.y : 0.0});
                frame.id.push_back(static_cast<std::uint32_t>(frame.id.size()));
            }
        }
    }
    return frame;
}

}  // namespace

TEST(Bays, OpenAHoleAtItsThinBridge)
{
    const std::vector<Loop> rims{circle({0.0, 0.0}, 2.0, false)};
    const Loop hole = circle({0.85, 0.0}, 1.0, true);  // 0.15 from the right end
    const std::vector<Bridge> bridges = bridgesOf(hole, rims, discOfParticles(2.0, -1.0), {});
    ASSERT_FALSE(bridges.empty());
    const Bridge& bridge = bridges.front();
    EXPECT_GE(bridge.thickness, 0.149);
    EXPECT_LT(bridge.thickness, 2.7 * kSpacing);
    const std::optional<Loop> bay = withBay(rims, hole, bridge, kSpacing);
    ASSERT_TRUE(bay);
    EXPECT_EQ(bay->corner.size(), bay->points.size());
    // The gap is one spacing wide between the tops of its round ends.
    const double both = signedArea(rims[0]) + signedArea(hole);
    const double gap = bridge.thickness * (kSpacing + bridge.thickness * (1.0 - 0.25 * std::numbers::pi));
    EXPECT_NEAR(signedArea(*bay), both - gap, 0.6 * gap);
    EXPECT_LT(signedArea(*bay), both);
}

TEST(Bays, GapsStayWhereTheyAre)
{
    const std::vector<Loop> rims{circle({0.0, 0.0}, 2.0, false)};
    const Loop hole = circle({0.85, 0.0}, 1.0, true);
    const ParticleFrame frame = discOfParticles(2.0, -1.0);
    const std::vector<Bridge> all = bridgesOf(hole, rims, frame, {});
    const auto lowest = std::min_element(all.begin(), all.end(),
                                         [](const Bridge& a, const Bridge& b) { return a.middle.y < b.middle.y; });
    const std::vector<Bridge> near = bridgesOf(hole, rims, frame, lowest->middle);
    ASSERT_FALSE(near.empty());
    EXPECT_EQ(near.front().middle, lowest->middle);
    EXPECT_TRUE(bridgesOf(hole, rims, frame, Vec2{-1.0, 0.0}).empty()) << "no bridge there any more";
}

TEST(Bays, ThickLiquidAndOtherThingsInTheWayStay)
{
    const ParticleFrame frame = discOfParticles(2.0, -1.0);
    const std::vector<Loop> rims{circle({0.0, 0.0}, 2.0, false)};
    EXPECT_TRUE(bridgesOf(circle({0.0, 0.0}, 1.0, true), rims, frame, {}).empty());
    const Loop hole = circle({0.85, 0.0}, 1.0, true);
    const std::vector<Loop> with_drop{rims[0], circle({1.93, 0.0}, 0.05, false)};
    const Bridge bridge{0, 0, 0, 0.15, {1.925, 0.0}};
    EXPECT_TRUE(withBay(rims, hole, bridge, kSpacing));
    EXPECT_FALSE(withBay(with_drop, hole, bridge, kSpacing));
    EXPECT_FALSE(withBay(rims, circle({1.9, 0.0}, 0.05, true), {0, 0, 0, 0.05, {1.975, 0.0}}, kSpacing)) << "too small";
}
