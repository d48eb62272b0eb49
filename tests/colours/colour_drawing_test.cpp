// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/colours/colour_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "droplet/error.h"
#include "support/colour_footprints.h"

namespace droplet {
namespace {

using testing::outerEdges;
using testing::totalArea;
using testing::tracedAt;

using Polygon = std::vector<Vec2>;

Polygon ring(Vec2 middle, double radius, std::size_t count = 720)
{
    Polygon points;
    for (std::size_t i = 0; i < count; ++i) {
        const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        points.push_back(middle + radius * Vec2{std::cos(turn), std::sin(turn)});
    }
    return points;
}

Polygon reversed(Polygon polygon)
{
    std::reverse(polygon.begin(), polygon.end());
    return polygon;
}

/// A disc in a disc, off the middle, 1 m wide.
ColourDrawing discs(CssColour outer, CssColour inner)
{
    const Polygon island = ring({0.11, 0.07}, 0.2);
    return {{{outer, {ring({}, 0.4), reversed(island)}}, {inner, {island}}}, {1.0, 1.0}};
}

// Sums over all pixels of what they know are the areas of the polygons.
TEST(ColourDrawing, PixelsKnowExactAreas)
{
    const ColourDrawing drawing = discs({200, 0, 0}, {0, 0, 200});
    for (const int side : {1, 7, 100, 333}) {
        const ColourRegions regions = drawColours(drawing, side);
        ASSERT_EQ(regions.width, side);
        double sum = 0.0;
        for (const std::uint16_t alpha : regions.alpha) {
            sum += alpha / 65535.0 / (side * side);
        }
        EXPECT_NEAR(sum, area(drawing.areas[0]) + area(drawing.areas[1]), 1e-5) << side;
    }
    const ColourRegions regions = drawColours(drawing, 333);
    double inner = 0.0;
    for (std::size_t i = 0; i < regions.label.size(); ++i) {
        const double share = regions.mixture[i].share / 255.0;
        const double alpha = regions.alpha[i] / 65535.0;
        inner += alpha * (regions.label[i] == 2 ? share : regions.mixture[i].other == 2 ? 1.0 - share : 0.0);
    }
    EXPECT_NEAR(inner / (333.0 * 333.0), area(drawing.areas[1]), 1e-5);
}

// Unlike in a picture, colours may differ by a single level.
TEST(ColourDrawing, BoundariesHaveTheirPlaceWhateverTheColours)
{
    const ColourDrawing drawing = discs({100, 100, 100}, {100, 101, 100});
    const ColourDomain traced = tracedAt(drawColours(drawing, 400), 1.0);
    ASSERT_EQ(traced.domain.droplets.size(), 2U);
    EXPECT_TRUE(traced.anti_aliased);
    for (std::size_t k = 0; k < 2; ++k) {
        const double exact = area(drawing.areas[traced.colour[k]]);
        EXPECT_NEAR(area(traced.domain.droplets[k]), exact, 2e-4 * exact);
    }
    EXPECT_EQ(traced.domain.droplets[0].holes.size(), 1U);
}

// A square in four slanted pieces: all edges without a twin are on the square's rim.
TEST(ColourDrawing, NeighboursShareTheirBoundaryBitForBit)
{
    const Vec2 middle{0.03, -0.05};
    const std::array<Vec2, 4> corner{{{-0.4, -0.37}, {0.39, -0.41}, {0.42, 0.38}, {-0.36, 0.41}}};
    ColourDrawing drawing{{}, {1.0, 1.0}};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto level = static_cast<std::uint8_t>(k);
        drawing.areas.push_back({{level, level, level}, {{middle, corner[k], corner[(k + 1) % 4]}}});
    }
    const ColourDomain traced = tracedAt(drawColours(drawing, 300), 1.0, 0.02);
    ASSERT_EQ(traced.domain.droplets.size(), 4U);
    double whole = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        const double exact = area(drawing.areas[traced.colour[k]]);
        EXPECT_NEAR(area(traced.domain.droplets[k]), exact, 1e-3 * exact);
        whole += exact;
    }
    EXPECT_NEAR(totalArea(traced), whole, 2e-4 * whole);
    constexpr double kNear = 0.5 / 300.0;
    for (const auto& [ax, ay, bx, by] : outerEdges(traced)) {
        double away = 1.0;
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec2 along = corner[(k + 1) % 4] - corner[k];
            away = std::min(away, std::abs(cross(along, Vec2{ax, ay} - corner[k])) / length(along));
        }
        EXPECT_LT(away, kNear);
    }
}

TEST(ColourDrawing, SizeIsThatOfTheDrawing)
{
    const ColourDrawing drawing{{{{1, 2, 3}, {{{-0.9, -0.2}, {0.9, -0.2}, {0.9, 0.2}, {-0.9, 0.2}}}}}, {2.0, 0.5}};
    const ColourRegions regions = drawColours(drawing, 101);
    EXPECT_EQ(regions.width, 101);
    EXPECT_EQ(regions.height, 26);
    EXPECT_DOUBLE_EQ(*regions.physical_width, 2.0);
    ASSERT_EQ(regions.palette.size(), 1U);
    EXPECT_EQ(text(regions.palette[0].colour), "#010203");
    EXPECT_EQ(regions.palette[0].pixels,
              static_cast<std::size_t>(std::count(regions.label.begin(), regions.label.end(), 1)));
}

TEST(ColourDrawing, IsTheSameWithAnyNumberOfThreads)
{
    const ColourDrawing drawing = discs({200, 0, 0}, {0, 0, 200});
    const auto made = [&](int threads) {
        ColourRegions regions;
        tbb::task_arena(threads).execute([&] { regions = drawColours(drawing, 200); });
        return regions;
    };
    const ColourRegions one = made(1);
    const ColourRegions four = made(4);
    EXPECT_EQ(one.label, four.label);
    EXPECT_EQ(one.alpha, four.alpha);
}

TEST(ColourDrawing, RefusesTooManyColoursAndPixels)
{
    ColourDrawing drawing{std::vector<ColourArea>(256), {1.0, 1.0}};
    EXPECT_THROW(drawColours(drawing), Error);
    drawing.areas.resize(1);
    EXPECT_THROW(drawColours(drawing, 0), Error);
    EXPECT_THROW(drawColours(drawing, 16385), Error);
}

}  // namespace
}  // namespace droplet
