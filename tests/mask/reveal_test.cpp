// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mask/reveal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "droplet/error.h"
#include "support/masks.h"

namespace droplet {
namespace {

double shareOf(const Mask& part, const Mask& whole)
{
    const auto sum = [](const Mask& mask) { return std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0); };
    return sum(part) / sum(whole);
}

Mask ring()
{
    return testing::hardMask(120, 100, [](Vec2 p) {
        const double r = length(p - Vec2{60.5, 50.5});
        return r > 25.0 && r < 40.0;
    });
}

TEST(Reveal, GrowsFromNothingToTheWholeMask)
{
    for (const RevealSource& source :
         std::vector<RevealSource>{RevealFrom::Left, RevealFrom::Right, RevealFrom::Top, RevealFrom::Bottom,
                                   RevealFrom::Middle, Vec2{0.2, 0.9}}) {
        const Mask whole = ring();
        const Reveal reveal(whole, source);
        EXPECT_EQ(reveal.at(1.0).coverage, whole.coverage);
        EXPECT_LT(shareOf(reveal.at(0.0), whole), 0.12);
        Mask before = reveal.at(0.0);
        for (int k = 1; k <= 20; ++k) {
            const Mask now = reveal.at(k / 20.0);
            for (std::size_t i = 0; i < now.coverage.size(); ++i) {
                ASSERT_GE(now.coverage[i], before.coverage[i]);
            }
            if (shareOf(before, whole) < 1.0) {
                EXPECT_GT(shareOf(now, whole), shareOf(before, whole)) << "no time without a change";
            }
            before = now;
        }
    }
}

// In a straight stroke the front goes evenly: after half the time, half of it is wet.
TEST(Reveal, GoesEvenlyAlongAStroke)
{
    const Mask stroke = testing::hardMask(440, 60, testing::rectangle({220.0, 30.0}, {200.0, 10.0}, 0.0));
    EXPECT_NEAR(shareOf(Reveal(stroke, RevealFrom::Left).at(0.5), stroke), 0.5, 0.03);
    EXPECT_NEAR(shareOf(Reveal(stroke, RevealFrom::Right).at(0.25), stroke), 0.25, 0.03);
    EXPECT_NEAR(shareOf(Reveal(stroke, RevealFrom::Middle).at(0.5), stroke), 0.5, 0.03);
}

// The middle is ahead of the rim: the front of a stroke is round.
TEST(Reveal, FrontIsRound)
{
    const Mask stroke = testing::hardMask(440, 60, testing::rectangle({220.0, 30.0}, {200.0, 10.0}, 0.0));
    const Mask half = Reveal(stroke, RevealFrom::Left).at(0.5);
    const auto reach = [&](int y) {
        int x = 0;
        for (; x < 440 && (x < 20 || half.at(x, y) > 32768); ++x) {
        }
        return x;
    };
    EXPECT_GT(reach(30), reach(20) + 4);
    EXPECT_NEAR(reach(20), reach(39), 1);
}

// Liquid goes around, not across, what is dry: the last place of a C is its other end, though that is near.
TEST(Reveal, FollowsStrokes)
{
    const Mask letter = testing::hardMask(120, 100, [](Vec2 p) {
        const double r = length(p - Vec2{60.5, 50.5});
        return r > 25.0 && r < 40.0 && !(p.x > 61.0 && std::abs(p.y - 50.5) < 6.0);
    });
    const Reveal reveal(letter, Vec2{92.0 / 120.0, 38.0 / 100.0});  // the upper end
    const Mask half = reveal.at(0.5);
    EXPECT_GT(half.at(60, 17), 60000) << "the top is wet";
    EXPECT_EQ(half.at(92, 62), 0) << "the lower end is dry";
    EXPECT_EQ(half.at(60, 83), 0) << "the bottom, too";
    EXPECT_GT(reveal.at(0.9).at(60, 83), 60000);
}

TEST(Reveal, DropletsBeginInTheOrderOfTheFront)
{
    const Mask dots =
        testing::hardMask(200, 40, [](Vec2 p) { return std::hypot(std::fmod(p.x, 50.0) - 25.5, p.y - 20.5) < 8.0; });
    const Mask half = Reveal(dots, RevealFrom::Left).at(0.5);
    EXPECT_GT(half.at(25, 20), 60000);
    EXPECT_GT(half.at(75, 20), 60000);
    EXPECT_EQ(half.at(175, 20), 0);
    const Mask back = Reveal(dots, RevealFrom::Right).at(0.5);
    EXPECT_EQ(back.at(25, 20), 0);
    EXPECT_GT(back.at(175, 20), 60000);
}

TEST(Reveal, KeepsPixelsThatAreLessThanHalfLiquid)
{
    Mask mask = testing::hardMask(60, 60, testing::rectangle({30.0, 30.0}, {10.0, 10.0}, 0.0));
    for (int y = 20; y < 40; ++y) {
        mask.coverage[static_cast<std::size_t>(y * 60 + 40)] = 20000;
    }
    mask.coverage[5] = 300;  // far from all liquid
    const Reveal reveal(mask, RevealFrom::Left);
    EXPECT_EQ(reveal.at(1.0).coverage, mask.coverage);
    EXPECT_EQ(reveal.at(0.5).at(40, 30), 0);
}

TEST(Reveal, RefusesWhatIsNot)
{
    EXPECT_THROW(Reveal(testing::hardMask(8, 8, [](Vec2 /*place*/) { return false; }), RevealFrom::Left), Error);
    const Mask full = testing::hardMask(8, 8, [](Vec2 /*place*/) { return true; });
    EXPECT_EQ(Reveal(full, RevealFrom::Left).at(1.0).coverage, full.coverage) << "without a rim";
    EXPECT_THROW(Reveal(full, Vec2{std::numeric_limits<double>::quiet_NaN(), 0.0}), Error);
    EXPECT_THROW(static_cast<void>(Reveal(full, RevealFrom::Left).at(1.1)), Error);
    EXPECT_THROW(revealFromNamed("up"), Error);
    EXPECT_EQ(revealFromNamed("middle"), RevealFrom::Middle);
}

}  // namespace
}  // namespace droplet
