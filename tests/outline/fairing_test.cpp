// SPDX-License-Identifier: GPL-3.0-or-later
#include "outline/fairing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "outline/borders.h"
#include "support/masks.h"

namespace droplet {
namespace {

/// Slots of the first border of a hard mask.
SlotLoop slotsOf(const Mask& mask)
{
    const std::vector<Border> borders = followBorders(mask, 32768);
    SlotLoop loop;
    for (const Crossing& at : borders.front()) {
        const Step d = at.toward();
        loop.push_back({{at.x + 0.5, at.y + 0.5}, {static_cast<double>(d.x), static_cast<double>(d.y)}, 0.5, {}, 0.0});
    }
    return loop;
}

SlotLoop turned(SlotLoop loop, std::size_t by)
{
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(by), loop.end());
    return loop;
}

double farthestApart(const SlotLoop& a, const SlotLoop& b)
{
    double max = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        max = std::max(max, std::abs(a[i].t - b[i].t));
    }
    return max;
}

double totalStrain(const SlotLoop& loop, const FairingOptions& options)
{
    const std::vector<double> strains = strain(loop, options);
    return std::accumulate(strains.begin(), strains.end(), 0.0);
}

Mask ellipseMask(int size, double a, double b)
{
    return testing::hardMask(size, size, [=](Vec2 p) {
        const Vec2 d = p - Vec2{0.5 * size + 0.2, 0.5 * size - 0.1};
        return (d.x * d.x) / (a * a) + (d.y * d.y) / (b * b) < 1.0;
    });
}

// Loops from 12 slots, whose band overlaps itself in all but a few rows, to loops whose ends do not affect each other.
TEST(Fairing, ResultDoesNotDependOnWhereALoopBegins)
{
    for (const double radius : {2.0, 3.3, 8.0, 30.0, 90.0}) {
        const SlotLoop loop = slotsOf(ellipseMask(200, radius, 0.8 * radius));
        SlotLoop faired = loop;
        fair(faired);
        EXPECT_GT(farthestApart(faired, loop), 0.01) << radius;
        for (const std::size_t by :
             {std::size_t{1}, std::size_t{2}, std::size_t{5}, loop.size() / 2, loop.size() - 1}) {
            SlotLoop other = turned(loop, by);
            fair(other);
            EXPECT_LT(farthestApart(other, turned(faired, by)), 1e-9) << radius << " from slot " << by;
        }
    }
}

// Fairing stops when a step lowers the cost by less than a thousandth.
TEST(Fairing, NoMoveOfASlotImprovesTheCurve)
{
    for (const double fairness : {10.0, 3e5}) {
        const FairingOptions options{{}, fairness};
        SlotLoop loop = slotsOf(ellipseMask(100, 30.0, 24.0));
        const double before = totalStrain(loop, options);
        fair(loop, options);
        const double after = totalStrain(loop, options);
        EXPECT_LT(after, 0.5 * before);
        for (std::size_t i = 0; i < loop.size(); i += 7) {
            for (const double d : {-0.01, 0.01}) {
                SlotLoop other = loop;
                other[i].t += d;
                EXPECT_GT(totalStrain(other, options), after - 1e-3);
            }
        }
    }
}

// With a break at each corner, a square has four straight sides; without breaks its corners are rounded.
TEST(Fairing, CurvesMayTurnAtBreaks)
{
    const SlotLoop square = slotsOf(testing::hardMask(60, 60, testing::rectangle({30, 30}, {20, 20}, 0.0)));
    FairingOptions options;
    for (std::size_t i = 0; i < square.size(); ++i) {
        options.breaks.push_back(square[i].toward == square[(i + 1) % square.size()].toward ? 0 : 1);
    }
    ASSERT_EQ(std::accumulate(options.breaks.begin(), options.breaks.end(), 0), 4);
    for (const std::size_t by : {std::size_t{0}, std::size_t{1}, std::size_t{2}, square.size() - 1}) {
        FairingOptions broken = options;
        std::rotate(broken.breaks.begin(), broken.breaks.begin() + static_cast<std::ptrdiff_t>(by),
                    broken.breaks.end());
        const SlotLoop loop = turned(square, by);
        SlotLoop sharp = loop;
        fair(sharp, broken);
        EXPECT_LT(farthestApart(sharp, loop), 1e-12);
        EXPECT_NEAR(totalStrain(sharp, broken), 0.0, 1e-12);
        SlotLoop round = loop;
        fair(round);
        EXPECT_GT(farthestApart(round, loop), 0.1);
    }
}

}  // namespace
}  // namespace droplet
