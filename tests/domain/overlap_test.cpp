// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/domain/overlap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "droplet/error.h"
#include "support/domains.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::polygonLoop;
using testing::reversed;

Loop square(Vec2 centre, double half)
{
    return polygonLoop({centre + Vec2{-half, -half}, centre + Vec2{half, -half}, centre + Vec2{half, half},
                        centre + Vec2{-half, half}});
}

Loop shifted(Loop loop, Vec2 by)
{
    for (Vec2& p : loop.points) {
        p = p + by;
    }
    return loop;
}

double onlyArea(const Domain& a, const Domain& b, double row)
{
    const std::vector<Overlap> found = overlaps(a, b, row);
    EXPECT_EQ(found.size(), 1U);
    return found.empty() ? 0.0 : found[0].area;
}

TEST(Overlaps, OfSquaresAreExactWhereRowsFit)
{
    const Domain a = domainOf(square({0, 0}, 1.0));
    EXPECT_NEAR(onlyArea(a, a, 0.125), 4.0, 1e-12);
    EXPECT_NEAR(onlyArea(a, domainOf(square({0.5, 1.5}, 1.0)), 0.125), 1.5 * 0.5, 1e-12);
    EXPECT_TRUE(overlaps(a, domainOf(square({2.5, 0}, 1.0)), 0.125).empty());
    EXPECT_TRUE(overlaps(a, domainOf(square({0, 2.5}, 1.0)), 0.125).empty());
}

TEST(Overlaps, OfDiscsHaveTheAreaOfALens)
{
    const double apart = 0.8;
    const double lens = 2 * std::acos(apart / 2) - apart / 2 * std::sqrt(4 - apart * apart);
    const Domain a = domainOf(ellipseLoop(1, 1));
    for (const Vec2 by : {Vec2{apart, 0}, Vec2{0, apart}, Vec2{-apart * 0.6, apart * 0.8}}) {
        EXPECT_NEAR(onlyArea(a, domainOf(shifted(ellipseLoop(1, 1), by)), 0.01), lens, 1e-3);
    }
}

TEST(Overlaps, HolesDoNotCount)
{
    const Domain ring = domainOf(ellipseLoop(1, 1), {reversed(ellipseLoop(0.5, 0.5))});
    EXPECT_TRUE(overlaps(ring, domainOf(ellipseLoop(0.4, 0.4)), 0.01).empty());
    EXPECT_NEAR(onlyArea(ring, domainOf(ellipseLoop(0.8, 0.8)), 0.01), std::numbers::pi * (0.64 - 0.25), 1e-3);
    EXPECT_NEAR(onlyArea(ring, ring, 0.01), std::numbers::pi * 0.75, 1e-3);
}

TEST(Overlaps, AreInOrderAndSymmetric)
{
    Domain a;
    a.droplets = {{square({3, 0}, 1), {}}, {square({0, 0}, 1), {}}, {square({0, 9}, 1), {}}};
    Domain b;
    b.droplets = {{square({-0.5, 0}, 1), {}}, {square({1.5, 0}, 1), {}}};
    const std::vector<Overlap> found = overlaps(a, b, 0.125);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].first, 0U);
    EXPECT_EQ(found[0].second, 1U);
    EXPECT_NEAR(found[0].area, 1.0, 1e-12);
    EXPECT_EQ(found[1].first, 1U);
    EXPECT_EQ(found[1].second, 0U);
    EXPECT_NEAR(found[1].area, 3.0, 1e-12);
    EXPECT_EQ(found[2].second, 1U);
    EXPECT_NEAR(found[2].area, 1.0, 1e-12);
    for (const Overlap& back : overlaps(b, a, 0.125)) {
        bool same = false;
        for (const Overlap& there : found) {
            same = same || (there.first == back.second && there.second == back.first &&
                            std::abs(there.area - back.area) < 1e-12);
        }
        EXPECT_TRUE(same);
    }
}

TEST(Overlaps, RequireAPositiveRowDistance)
{
    const Domain a = domainOf(square({0, 0}, 1.0));
    EXPECT_THROW(overlaps(a, a, 0.0), Error);
    EXPECT_THROW(overlaps(a, a, std::nan("")), Error);
}

}  // namespace
}  // namespace droplet
