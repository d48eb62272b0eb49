// SPDX-License-Identifier: GPL-3.0-or-later
#include "type/contour_union.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "support/loops.h"

namespace droplet {
namespace {

using testing::minGap;
using testing::polygonArea;
using testing::windingNumber;

constexpr double kGap = 1.0 / 4096.0;

Contour square(Vec2 low, double side)
{
    return {low, low + Vec2{side, 0}, low + Vec2{side, side}, low + Vec2{0, side}};
}

Contour backward(Contour contour)
{
    return {contour.rbegin(), contour.rend()};
}

double totalArea(const std::vector<Contour>& loops)
{
    double sum = 0.0;
    for (const Contour& loop : loops) {
        sum += polygonArea(loop);
    }
    return sum;
}

TEST(ContourUnion, OverlappingContoursAreOneLoop)
{
    const Contour a = square({0, 0}, 1.0);
    const Contour b = square({0.5, 0.5}, 1.0);
    const United united = unite({a, b}, 0.0);
    ASSERT_EQ(united.loops.size(), 1U);
    EXPECT_EQ(united.loops[0].size(), 8U);
    EXPECT_EQ(polygonArea(united.loops[0]), 1.75);
    EXPECT_EQ(united.specks, 0U);
    // In both directions: TrueType's outer contours run clockwise, PostScript's counter-clockwise.
    EXPECT_EQ(unite({backward(a), backward(b)}, 0.0).loops, united.loops);
    EXPECT_EQ(unite({b, a, a}, 0.0).loops, united.loops);
}

TEST(ContourUnion, EnclosedLoopsMayTouch)
{
    const Contour a = square({0, 0}, 1.0);
    EXPECT_EQ(totalArea(enclosed({a, square({1, 1}, 1.0), square({0.5, 0.5}, 0.5)})), 2.0);
    EXPECT_TRUE(enclosed({}).empty());
    EXPECT_TRUE(enclosed({{}, {{0, 0}, {1, 0}}}).empty());
}

TEST(ContourUnion, PartsAddUpToTheWhole)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    for (int round = 0; round < 50; ++round) {
        const auto star = [&] {
            Contour contour;
            for (int i = 0; i < 12; ++i) {
                contour.push_back({place(random), place(random)});
            }
            return enclosed({contour});
        };
        const std::vector<Contour> a = star();
        const std::vector<Contour> b = star();
        const Parts parts = divide(a, b, 0.0);
        EXPECT_NEAR(totalArea(parts.inside) + totalArea(parts.outside), totalArea(a), 1e-6);
        EXPECT_NEAR(totalArea(parts.inside), totalArea(divide(b, a, 0.0).inside), 1e-6);
        EXPECT_NEAR(totalArea(divide(parts.outside, b, 0.0).inside), 0.0, 1e-6);
        EXPECT_TRUE(parts.slivers.empty());
    }
}

// A hairline beside the edge of what covers a square is a sliver; a line that was drawn as thin is not.
TEST(ContourUnion, SliversAreNarrowOnlyWhereTheWholeIsWide)
{
    const double narrow = 1.0 / 64.0;
    const std::vector<Contour> whole = enclosed({square({0, 0}, 1.0)});
    const Parts hairline = divide(whole, enclosed({square({1.0 / 128.0, -1.0}, 3.0)}), narrow);
    EXPECT_NEAR(totalArea(hairline.slivers), 1.0 / 128.0, 1e-6);
    EXPECT_TRUE(hairline.outside.empty());
    const Parts stripe = divide(whole, enclosed({square({1.0 / 32.0, -1.0}, 3.0)}), narrow);
    EXPECT_TRUE(stripe.slivers.empty());
    EXPECT_NEAR(totalArea(stripe.outside), 1.0 / 32.0, 1e-6);
    const Contour line{{0, 0}, {1, 0}, {1, 1.0 / 128.0}, {0, 1.0 / 128.0}};
    const Parts drawn = divide(enclosed({line}), enclosed({square({0.5, -1.0}, 3.0)}), narrow);
    EXPECT_TRUE(drawn.slivers.empty());
    EXPECT_NEAR(totalArea(drawn.outside), 0.5 / 128.0, 1e-6);
}

TEST(ContourUnion, HolesAreContoursInTheOppositeDirection)
{
    const Contour outer = square({0, 0}, 1.0);
    const Contour inner = square({0.25, 0.25}, 0.5);
    const United ring = unite({outer, backward(inner)}, 0.0);
    ASSERT_EQ(ring.loops.size(), 2U);
    EXPECT_EQ(polygonArea(ring.loops[0]), 1.0);
    EXPECT_EQ(polygonArea(ring.loops[1]), -0.25);
    EXPECT_EQ(unite({backward(outer), inner}, 0.0).loops, ring.loops);
    EXPECT_EQ(totalArea(unite({outer, inner}, 0.0).loops), 1.0) << "twice around is inside";
    EXPECT_EQ(unite({outer, backward(outer)}, 0.0).loops, std::vector<Contour>{});
}

TEST(ContourUnion, AdjacentContoursAreJoined)
{
    const United united = unite({square({0, 0}, 1.0), square({1, 0}, 1.0)}, 0.0);
    ASSERT_EQ(united.loops.size(), 1U);
    EXPECT_EQ(united.loops[0].size(), 4U);
    EXPECT_EQ(polygonArea(united.loops[0]), 2.0);
}

TEST(ContourUnion, LoopsThatTouchAreSeparatedByASmallGap)
{
    const struct {
        const char* what;
        std::vector<Contour> contours;
        std::size_t loops;
        double area;
    } cases[] = {
        {"two squares at a corner", {square({0, 0}, 1.0), square({1, 1}, 1.0)}, 2, 2.0},
        {"a corner on a side", {square({0, 0}, 1.0), {{1, 0.5}, {1.5, 0}, {1.5, 1}}}, 2, 1.25},
        {"a hole that touches its rim", {square({0, 0}, 1.0), {{0, 0.5}, {0.5, 0.75}, {0.5, 0.25}}}, 1, 0.875},
        {"two holes at a corner",
         {square({0, 0}, 3.0), backward(square({0.5, 0.5}, 1.0)), backward(square({1.5, 1.5}, 1.0))},
         2,
         7.0},
        {"a bow tie", {{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}, 2, 0.5},
        {"a bow tie that winds around once", {{{0, 0}, {2, 1}, {2, 0}, {0, 1}}}, 2, 1.0},
    };
    for (const auto& [what, contours, loops, area] : cases) {
        SCOPED_TRACE(what);
        const United united = unite(contours, 0.0);
        EXPECT_EQ(united.loops.size(), loops);
        EXPECT_GT(minGap(united.loops), 0.5 * kGap);
        EXPECT_LT(totalArea(united.loops), area);
        EXPECT_GT(totalArea(united.loops), area - 10.001 * kGap) << "at most half a gap on all sides";
    }
}

TEST(ContourUnion, LoopsThatDoNotTouchStay)
{
    // A quarter of the gap that touching sides get.
    const Contour a = square({0, 0}, 1.0);
    const Contour b = square({1 + kGap / 4, 0}, 1.0);
    EXPECT_EQ(unite({a, b}, 0.0).loops, (std::vector<Contour>{a, b}));
}

TEST(ContourUnion, ContoursWithoutAreaGiveNoLoops)
{
    EXPECT_EQ(unite({}, 0.0).loops.size(), 0U);
    EXPECT_EQ(unite({{}, {{1, 1}}, {{0, 0}, {1, 0}}, {{0, 0}, {1, 1}, {2, 2}}}, 0.0).loops.size(), 0U);
    EXPECT_EQ(unite({{{0, 0}, {1, 0}, {0, 0}, {1, 0}}}, 0.0).loops.size(), 0U);
    // A line to a square and back encloses only the square.
    const United united = unite({{{0, 0}, {1, 0}, {1, -1}, {2, -1}, {2, 0}, {1, 0}}}, 0.0);
    ASSERT_EQ(united.loops.size(), 1U);
    EXPECT_EQ(polygonArea(united.loops[0]), 1.0);
}

TEST(ContourUnion, SpecksAreDroppedAndCounted)
{
    const std::vector<Contour> contours{square({0, 0}, 1.0), backward(square({0.5, 0.5}, 0.01)), square({2, 0}, 0.02),
                                        square({3, 0}, 0.1)};
    EXPECT_EQ(unite(contours, 0.0).loops.size(), 4U);
    const United united = unite(contours, 5e-4);
    EXPECT_EQ(united.loops.size(), 2U);
    EXPECT_EQ(united.specks, 2U);
    EXPECT_NEAR(totalArea(united.loops), 1.01, 1e-6) << "a dry speck is filled";
}

TEST(ContourUnion, PointsAreInsideWhereContoursWindAroundThem)
{
    std::mt19937 random(7);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    for (int trial = 0; trial < 60; ++trial) {
        std::vector<Contour> contours(1 + random() % 3);
        for (Contour& contour : contours) {
            for (std::size_t i = 0, n = 3 + random() % 8; i < n; ++i) {
                // Also on a coarse lattice, where many sides touch and coincide.
                contour.push_back(trial % 2 == 0
                                      ? Vec2{uniform(), uniform()}
                                      : Vec2{std::floor(5.0 * uniform()) / 4.0, std::floor(5.0 * uniform()) / 4.0});
            }
        }
        const United united = unite(contours, 0.0);
        EXPECT_GT(minGap(united.loops), 0.0) << trial;
        for (int sample = 0; sample < 300; ++sample) {
            const Vec2 p{1.2 * uniform() - 0.1, 1.2 * uniform() - 0.1};
            int around = 0;
            double away = 1.0;
            for (const Contour& contour : contours) {
                around += windingNumber(contour, p);
                for (std::size_t i = 0; i < contour.size(); ++i) {
                    away = std::min(away, testing::distanceToPiece(p, contour[i], contour[(i + 1) % contour.size()]));
                }
            }
            int inside = 0;
            for (const Contour& loop : united.loops) {
                inside += windingNumber(loop, p);
            }
            // Sharp corners of separated loops are cut by up to two gaps.
            if (away > 3.0 * kGap) {
                EXPECT_EQ(inside, around != 0 ? 1 : 0) << trial << ": " << p.x << ", " << p.y;
            }
        }
    }
}

}  // namespace
}  // namespace droplet
