// SPDX-License-Identifier: GPL-3.0-or-later
#include "type/flatten.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "support/loops.h"

namespace droplet {
namespace {

Vec2 mix(Vec2 a, Vec2 b, double t)
{
    return (1.0 - t) * a + t * b;
}

Vec2 conicAt(Vec2 a, Vec2 b, Vec2 c, double t)
{
    return mix(mix(a, b, t), mix(b, c, t), t);
}

Vec2 cubicAt(Vec2 a, Vec2 b, Vec2 c, Vec2 d, double t)
{
    return mix(conicAt(a, b, c, t), conicAt(b, c, d, t), t);
}

/// Largest distance of a curve from an open polyline through points of it.
template <typename Curve>
double farthest(const Contour& pieces, const Curve& curve)
{
    double max = 0.0;
    for (int i = 0; i <= 2000; ++i) {
        double min = 1e9;
        for (std::size_t k = 0; k + 1 < pieces.size(); ++k) {
            min = std::min(min, testing::distanceToPiece(curve(i / 2000.0), pieces[k], pieces[k + 1]));
        }
        max = std::max(max, min);
    }
    return max;
}

double longest(const Contour& pieces)
{
    double max = 0.0;
    for (std::size_t k = 0; k + 1 < pieces.size(); ++k) {
        max = std::max(max, length(pieces[k + 1] - pieces[k]));
    }
    return max;
}

TEST(Flatten, ConicsStayWithinTheTolerance)
{
    const Vec2 a{0, 0};
    const Vec2 b{0.4, 0.9};
    const Vec2 c{1, 0.1};
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
        Contour pieces{a};
        addConic(pieces, b, c, {tolerance, 10.0});
        const double off = farthest(pieces, [&](double t) { return conicAt(a, b, c, t); });
        EXPECT_LE(off, tolerance);
        EXPECT_EQ(pieces.back(), c);
        // The second difference of a conic is constant, so the bound is sharp except for rounding up and the limit of
        // 10° per piece.
        if (tolerance < 1e-3) {
            EXPECT_GT(off, 0.3 * tolerance);
        }
    }
}

TEST(Flatten, CubicsStayWithinTheTolerance)
{
    const Vec2 a{0, 0};
    const Vec2 b{1.2, 0.9};
    const Vec2 c{-0.3, 1};
    const Vec2 d{1, 0};
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
        Contour pieces{a};
        addCubic(pieces, b, c, d, {tolerance, 10.0});
        EXPECT_LE(farthest(pieces, [&](double t) { return cubicAt(a, b, c, d, t); }), tolerance);
        EXPECT_EQ(pieces.back(), d);
    }
}

TEST(Flatten, PiecesAreShortAndTurnLittleAtAnyTolerance)
{
    // A quarter of a circle.
    const double k = 0.5522847498;
    Contour coarse{{1, 0}};
    addCubic(coarse, {1, k}, {k, 1}, {0, 1}, {1.0, 10.0});
    for (std::size_t i = 0; i + 2 < coarse.size(); ++i) {
        const Vec2 before = coarse[i + 1] - coarse[i];
        const Vec2 after = coarse[i + 2] - coarse[i + 1];
        EXPECT_LT(std::atan2(cross(before, after), dot(before, after)), 0.2) << i;
    }
    EXPECT_EQ(coarse.size(), 10U) << "90 degrees in nine pieces";
    Contour dense{{1, 0}};
    addCubic(dense, {1, k}, {k, 1}, {0, 1}, {1.0, 0.01});
    EXPECT_LT(longest(dense), 0.0105);
}

TEST(Flatten, StraightCurvesAndPointsTakeOnePiece)
{
    Contour straight{{0, 0}};
    addConic(straight, {0.5, 0.5}, {1, 1}, {1e-9, 10.0});
    EXPECT_EQ(straight.size(), 2U);
    Contour point{{3, 3}};
    addCubic(point, {3, 3}, {3, 3}, {3, 3}, {1e-9, 1e-3});
    EXPECT_EQ(point.size(), 2U);
}

}  // namespace
}  // namespace droplet
