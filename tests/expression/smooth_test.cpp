// SPDX-License-Identifier: GPL-3.0-or-later
#include "expression/smooth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace {

using droplet::Loop;
using droplet::signedArea;
using droplet::smoothed;
using droplet::Vec2;

constexpr double kSpacing = 0.1;
constexpr double kFairing = 2.5;

/// Points of a curve with the parameter from 0 to 1, about 0.3 spacings apart, as those of marching squares: not at
/// equal distances.
Loop loopOf(const std::function<Vec2(double)>& at, double length)
{
    Loop loop;
    const int count = static_cast<int>(length / (0.3 * kSpacing));
    for (int k = 0; k < count; ++k) {
        loop.points.push_back(at((k + 0.3 * std::sin(2.0 * k)) / count));
    }
    loop.corner.resize(loop.points.size());
    return loop;
}

/// Circle of a radius in spacings, with so many wrinkles of a height in spacings.
Loop wrinkled(double radius, int wrinkles, double height)
{
    return loopOf(
        [&](double t) {
            const double angle = 2.0 * std::numbers::pi * t;
            const double r = kSpacing * (radius + height * std::cos(wrinkles * angle));
            return Vec2{r * std::cos(angle), r * std::sin(angle)};
        },
        2.0 * std::numbers::pi * radius * kSpacing);
}

/// Greatest distance of a loop's points from a circle, in spacings.
double offCircle(const Loop& loop, double radius)
{
    double off = 0.0;
    for (const Vec2 x : loop.points) {
        off = std::max(off, std::abs(length(x) / kSpacing - radius));
    }
    return off;
}

Loop only(const Loop& loop)
{
    const std::vector<Loop> loops = smoothed({loop}, kSpacing, kFairing);
    EXPECT_EQ(loops.size(), 1U);
    return loops.front();
}

TEST(Smooth, WrinklesOfParticlesVanishAndLongBendsStay)
{
    // Lengths of 3, 4 and 5 spacings.
    const double radius = 20.0;
    const double around = 2.0 * std::numbers::pi * radius;
    for (const double wrinkle : {3.0, 4.0, 5.0}) {
        const Loop loop = only(wrinkled(radius, static_cast<int>(around / wrinkle), 0.3));
        EXPECT_LT(offCircle(loop, radius), 0.03) << wrinkle;
    }
    for (const double bend : {20.0, 40.0}) {
        const Loop loop = only(wrinkled(radius, static_cast<int>(around / bend), 0.3));
        EXPECT_NEAR(offCircle(loop, radius), 0.3, 0.06) << bend;
    }
}

TEST(Smooth, AreaStaysAndRoundDropletsStayRound)
{
    for (const double radius : {2.0, 3.0, 6.0, 20.0}) {
        const Loop circle = wrinkled(radius, 1, 0.0);
        const Loop loop = only(circle);
        EXPECT_NEAR(signedArea(loop), signedArea(circle), 1e-3 * signedArea(circle)) << radius;
        EXPECT_LT(offCircle(loop, radius), 0.03) << radius;
    }
}

TEST(Smooth, CornersMoveLessThanASpacing)
{
    const double half = 10.0 * kSpacing;
    const Loop square = loopOf(
        [&](double t) {
            const double side = 4.0 * t;
            const double along = 2.0 * half * (side - std::floor(side)) - half;
            switch (static_cast<int>(side) % 4) {
                case 0:
                    return Vec2{along, -half};
                case 1:
                    return Vec2{half, along};
                case 2:
                    return Vec2{-along, half};
                default:
                    return Vec2{-half, -along};
            }
        },
        8.0 * half);
    double nearest = 1e9;
    for (const Vec2 x : only(square).points) {
        nearest = std::min(nearest, length(x - Vec2{half, half}));
    }
    EXPECT_LT(nearest, kSpacing);
}

TEST(Smooth, SidesOfThinSheetsDoNotMeet)
{
    // A sheet of 0.8 spacings whose sides wave against one another, with necks of 0.4.
    const double length_of_side = 30.0 * kSpacing;
    const auto half_width = [&](double x) { return kSpacing * (0.3 + 0.1 * std::cos(x / kSpacing)); };
    const Loop sheet = loopOf(
        [&](double t) {
            const double x = length_of_side * (t < 0.5 ? 2.0 * t : 2.0 - 2.0 * t);
            return Vec2{x, t < 0.5 ? -half_width(x) : half_width(x)};
        },
        2.0 * length_of_side);
    for (const Vec2 x : only(sheet).points) {
        if (x.x > 2.0 * kSpacing && x.x < length_of_side - 2.0 * kSpacing) {
            EXPECT_GT(std::abs(x.y), 0.1 * kSpacing) << x.x;
        }
    }
}

TEST(Smooth, LeavesLoopsAloneIfAskedAndThoseOfFewPoints)
{
    const Loop loop = wrinkled(20.0, 30, 0.3);
    EXPECT_EQ(smoothed({loop}, kSpacing, 0.0).front().points, loop.points);
    const Loop small = wrinkled(0.8, 1, 0.0);
    EXPECT_EQ(smoothed({small}, kSpacing, kFairing).front().points, small.points);
    EXPECT_TRUE(smoothed({}, kSpacing, kFairing).empty());
}

}  // namespace
