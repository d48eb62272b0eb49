// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/domain/domain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "droplet/error.h"
#include "support/domains.h"
#include "support/masks.h"

namespace droplet {
namespace {

using testing::ellipseLoop;
using testing::reversed;

Loop circleAt(Vec2 centre, double radius)
{
    Loop loop = ellipseLoop(radius, radius);
    for (Vec2& p : loop.points) {
        p = p + centre;
    }
    return loop;
}

TEST(Domain, IslandsInHolesAreDropletsOfTheirOwn)
{
    Outline outline;
    outline.extent = {40, 40};
    outline.loops = {circleAt({0, 0}, 10), reversed(circleAt({0, 0}, 8)), circleAt({0, 0}, 6),
                     reversed(circleAt({1, 0}, 3)), circleAt({1, 0}, 1)};
    const Domain domain = split(outline);
    ASSERT_EQ(domain.droplets.size(), 3U);
    EXPECT_EQ(domain.droplets[0].holes.size(), 1U);
    EXPECT_EQ(domain.droplets[1].holes.size(), 1U);
    EXPECT_EQ(domain.droplets[2].holes.size(), 0U);
    EXPECT_NEAR(area(domain.droplets[0]), std::numbers::pi * (100 - 64), 1e-3);
    EXPECT_NEAR(area(domain.droplets[1]), std::numbers::pi * (36 - 9), 1e-3);
    EXPECT_NEAR(rimLength(domain.droplets[1]), 2 * std::numbers::pi * 9, 1e-3);
    EXPECT_EQ(domain.extent, outline.extent);
}

TEST(Domain, HolesBesideEachOtherShareADroplet)
{
    Outline outline;
    outline.extent = {40, 40};
    // The nearest loop to the left of the right-hand holes is another hole, not the rim.
    outline.loops = {circleAt({0, 0}, 10), reversed(circleAt({-5, 0}, 2)), reversed(circleAt({0, 0.3}, 2)),
                     reversed(circleAt({5, -0.2}, 2)), circleAt({25, 0}, 3)};
    const Domain domain = split(outline);
    ASSERT_EQ(domain.droplets.size(), 2U);
    EXPECT_EQ(domain.droplets[0].holes.size(), 3U);
    EXPECT_EQ(domain.droplets[1].holes.size(), 0U);
}

TEST(Domain, OrderOfLoopsDoesNotMatter)
{
    Outline outline;
    outline.extent = {40, 40};
    outline.loops = {reversed(circleAt({0, 0}, 8)), circleAt({0, 0}, 6), circleAt({0, 0}, 10)};
    const Domain domain = split(outline);
    ASSERT_EQ(domain.droplets.size(), 2U);
    EXPECT_EQ(domain.droplets[0].holes.size(), 0U);
    EXPECT_EQ(domain.droplets[1].holes.size(), 1U);
}

TEST(Domain, AreasOfATracedMaskAddUp)
{
    // Rings within rings: the areas of all droplets add up to the sum of the loops' areas.
    const Mask mask = testing::smoothMask(200, 200, [](Vec2 p) {
        const double r = length(p - Vec2{100, 100});
        return r < 95 && static_cast<int>(r / 9) % 2 == 0;
    });
    const Outline outline = trace(mask);
    double sum = 0.0;
    for (const Loop& loop : outline.loops) {
        sum += signedArea(loop);
    }
    const Domain domain = split(outline);
    double areas = 0.0;
    for (const Footprint& f : domain.droplets) {
        EXPECT_GT(area(f), 0);
        areas += area(f);
    }
    EXPECT_NEAR(areas, sum, 1e-12 * sum);
    EXPECT_EQ(domain.droplets.size(), 6U);
}

/// Whether a loop winds around a point.
bool encloses(const Loop& loop, Vec2 point)
{
    bool inside = false;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
        const Vec2 a = loop.points[i];
        const Vec2 b = loop.points[(i + 1) % loop.points.size()];
        if ((a.y > point.y) != (b.y > point.y) && cross(b - a, point - a) * (b.y - a.y) > 0) {
            inside = !inside;
        }
    }
    return inside;
}

// Blobs with blobs in their holes, of all sizes: hundreds of loops, and many edges at one height.
TEST(Domain, EveryHoleLiesInTheSmallestRimAroundIt)
{
    const Mask mask = testing::hardMask(300, 300, [](Vec2 p) {
        return std::sin(0.31 * p.x) + std::sin(0.37 * p.y) + std::sin(0.9 * p.x + 1.1 * p.y) +
                   std::sin(0.05 * p.x * p.y / 40.0) >
               -0.1;
    });
    const Domain domain = split(trace(mask));
    std::size_t holes = 0;
    for (const Footprint& footprint : domain.droplets) {
        for (const Loop& hole : footprint.holes) {
            ++holes;
            const Footprint* smallest = nullptr;
            for (const Footprint& other : domain.droplets) {
                if (encloses(other.rim, hole.points.front()) &&
                    (smallest == nullptr || signedArea(other.rim) < signedArea(smallest->rim))) {
                    smallest = &other;
                }
            }
            EXPECT_EQ(smallest, &footprint);
        }
    }
    EXPECT_GT(holes, 50U);
    EXPECT_GT(domain.droplets.size(), 5U);
}

TEST(Domain, RejectsHolesOutsideOfAllRims)
{
    Outline outline;
    outline.extent = {40, 40};
    outline.loops = {reversed(circleAt({0, 0}, 8))};
    EXPECT_THROW((void)split(outline), Error);
    outline.loops.push_back(circleAt({20, 0}, 3));
    EXPECT_THROW((void)split(outline), Error);
}

}  // namespace
}  // namespace droplet
