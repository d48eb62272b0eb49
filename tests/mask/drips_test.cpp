// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mask/drips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "droplet/error.h"
#include "support/masks.h"

namespace droplet {
namespace {

/// A bar, 240 px wide and 40 px high, with grey edges.
Mask bar()
{
    Mask mask = testing::hardMask(280, 80, testing::rectangle({140.0, 40.0}, {120.0, 20.0}, 0.0));
    for (std::size_t x = 20; x < 260; ++x) {
        mask.coverage[60 * 280 + x] = 20'000;
    }
    return mask;
}

double areaOf(const Mask& mask)
{
    return std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0) / 65535.0;
}

TEST(Drips, BeginAsTheMaskAndCoverNoLess)
{
    const Mask whole = bar();
    const Drips drips(whole, {.count = 3});
    ASSERT_EQ(drips.drips().size(), 3U);
    Mask before = drips.at(0.0);
    ASSERT_GT(before.height, whole.height);
    EXPECT_EQ(before.width, whole.width);
    EXPECT_TRUE(std::equal(whole.coverage.begin(), whole.coverage.end(), before.coverage.begin()));
    EXPECT_EQ(areaOf(before), areaOf(whole)) << "added rows are dry";
    for (int k = 1; k <= 10; ++k) {
        const Mask now = drips.at(k / 10.0);
        EXPECT_EQ(now.height, before.height);
        for (std::size_t i = 0; i < whole.coverage.size(); ++i) {
            ASSERT_GE(now.coverage[i], whole.coverage[i]);
        }
        EXPECT_GT(areaOf(now), areaOf(before)) << k;
        before = now;
    }
}

// Each ends in a bulge that has come as far as it should, below its root, inside the picture.
TEST(Drips, RunDownAsFarAsTheirLength)
{
    const Drips drips(bar(), {.count = 3, .seed = 7});
    const Mask end = drips.at(1.0);
    const auto isLiquid = [&](double x, double y) {
        return end.coverage.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(end.width) +
                               static_cast<std::size_t>(x)) > 32768;
    };
    for (const Drips::Drip& drip : drips.drips()) {
        EXPECT_NEAR(drip.root.y, 59.5, 0.5);
        EXPECT_LT(drip.begin, 1.0);
        const double lowest = drip.root.y + drip.length + 1.2 * drip.radius;
        EXPECT_TRUE(isLiquid(drip.root.x, lowest - 2.0));
        EXPECT_FALSE(isLiquid(drip.root.x, lowest + 2.0));
        EXPECT_LT(lowest, end.height - 1.0);
        // The trail is narrower than the bulge.
        const double half_way = drip.root.y + 0.5 * drip.length;
        EXPECT_TRUE(isLiquid(drip.root.x, half_way));
        if (drip.length > 4.0 * drip.radius) {
            EXPECT_FALSE(isLiquid(drip.root.x + 0.9 * drip.radius, half_way));
        }
    }
}

// Drips that lie apart do not touch, and there are no more than there is room for.
TEST(Drips, LieApart)
{
    const Drips drips(bar(), {.count = 1000});
    EXPECT_LT(drips.drips().size(), 8U);
    for (const Drips::Drip& one : drips.drips()) {
        for (const Drips::Drip& other : drips.drips()) {
            if (&one != &other) {
                EXPECT_GT(std::abs(one.root.x - other.root.x), one.radius + other.radius + 2.0);
            }
        }
    }
}

TEST(Drips, HangAtTheLowestPlaces)
{
    // A V, whose only lower ends are its tip and no flank.
    const Mask v = testing::hardMask(300, 200, [](Vec2 p) {
        const double flank = std::abs(p.x - 150.5);
        const double middle = (170.5 - p.y) / 2.0;
        return p.y > 30.0 && p.y < 170.0 && std::abs(flank - middle) < 22.0;
    });
    const Drips drips(v, {.count = 1});
    ASSERT_EQ(drips.drips().size(), 1U);
    EXPECT_GT(drips.drips()[0].root.y, 165.0);
}

TEST(Drips, AreThoseOfTheirSeed)
{
    const Mask whole = bar();
    EXPECT_EQ(Drips(whole, {.count = 4, .seed = 3}).at(0.7).coverage,
              Drips(whole, {.count = 4, .seed = 3}).at(0.7).coverage);
    EXPECT_NE(Drips(whole, {.count = 4, .seed = 3}).at(0.7).coverage,
              Drips(whole, {.count = 4, .seed = 4}).at(0.7).coverage);
}

TEST(Drips, RefuseWhatIsNotAllowed)
{
    EXPECT_THROW(Drips(testing::hardMask(20, 20, [](Vec2 /*place*/) { return false; }), {}), Error);
    EXPECT_THROW(Drips(bar(), {.count = 0}), Error);
    EXPECT_THROW(static_cast<void>(Drips(bar(), {}).at(1.5)), Error);
    // A dot of one pixel has room for no drip, or for a tiny one.
    const Mask dot = testing::hardMask(9, 9, testing::rectangle({4.5, 4.5}, {0.5, 0.5}, 0.0));
    EXPECT_LE(Drips(dot, {}).drips().size(), 1U);
}

}  // namespace
}  // namespace droplet
