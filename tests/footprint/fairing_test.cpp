// SPDX-License-Identifier: GPL-3.0-or-later
#include "footprint/fairing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "footprint/borders.h"
#include "support/masks.h"

namespace droplet {
namespace {

/// The slots of the first border of a hard mask.
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
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        most = std::max(most, std::abs(a[i].t - b[i].t));
    }
    return most;
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

// From 12 slots, whose band overlaps itself but for a few rows, to loops that do not feel their own ends.
TEST(Fairing, DoesNotMatterWhereALoopBegins)
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
            EXPECT_LT(farthestApart(other, turned(faired, by)), 1e-9) << radius << " begun at " << by;
        }
    }
}

// Steps are taken until they lower the cost by less than a thousandth.
TEST(Fairing, NoSlotCanBeMovedForABetterCurve)
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

// Where the curve may turn sharply, neither side feels the other.
TEST(Fairing, BreaksPartTheLoop)
{
    const SlotLoop loop = slotsOf(ellipseMask(120, 40.0, 33.0));
    FairingOptions options{{}, 10.0};
    options.breaks.assign(loop.size(), 0);
    options.breaks[0] = 1;
    options.breaks[loop.size() / 2] = 1;
    SlotLoop measured = loop;
    // Pulling at slots of the one half, next to its ends and inside.
    for (const std::size_t i : {std::size_t{1}, loop.size() / 4, loop.size() / 2}) {
        measured[i].measured = loop[i].t + 0.3;
        measured[i].spread = 0.05;
    }
    SlotLoop one = loop;
    fair(one, options);
    fair(measured, options);
    double near = 0.0;
    for (std::size_t i = 1; i <= loop.size() / 2; ++i) {
        near = std::max(near, std::abs(one[i].t - measured[i].t));
    }
    double far = 0.0;
    for (std::size_t i = loop.size() / 2 + 1; i < loop.size(); ++i) {
        far = std::max(far, std::abs(one[i].t - measured[i].t));
    }
    EXPECT_GT(near, 0.2);
    // Within a thousandth of the least cost, which rises by at least 8/2 times the square of a slot's way from its best.
    EXPECT_LT(far, std::sqrt(1e-3 / 4.0));
}

}  // namespace
}  // namespace droplet
