// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/colours/colour_domain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "droplet/error.h"
#include "support/colour_footprints.h"
#include "support/colour_pictures.h"
#include "support/loops.h"

namespace droplet {
namespace {

using testing::kBlue;
using testing::kGold;
using testing::kRed;
using testing::kWhite;
using testing::labelled;
using testing::loopsOf;
using testing::outerEdges;
using testing::pie;
using testing::pixmap;
using testing::totalArea;

/// A pixel is one millimetre.
ColourTraceOptions inPixels(std::optional<double> edge = std::nullopt)
{
    ColourTraceOptions options;
    options.trace.pixel_size = 1e-3;
    if (edge) {
        options.edge = *edge * 1e-3;
    }
    return options;
}

ColourRegions regionsOf(const std::string& picture, const ColourOptions& options = {})
{
    return decodeColours(std::as_bytes(std::span(picture)), options);
}

ColourRegions noise(int width, int height, std::uint8_t colours, std::uint8_t dry, unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<std::uint8_t> labels;
    for (int i = 0; i < width * height; ++i) {
        labels.push_back(static_cast<std::uint8_t>(random() % (colours + dry) + 1 - dry));
    }
    return labelled(width, height, std::move(labels), colours);
}

/// Largest distance of a free edge from the picture's border [m].
double strayOf(const ColourDomain& traced)
{
    double stray = 0.0;
    for (const auto& [ax, ay, bx, by] : outerEdges(traced)) {
        const auto inside = [&](double x, double y) {
            return std::min(0.5 * traced.domain.extent.x - std::abs(x), 0.5 * traced.domain.extent.y - std::abs(y));
        };
        stray = std::max({stray, inside(ax, ay), inside(bx, by)});
    }
    return stray;
}

// Where all of a picture is liquid, the only edges without a twin, bit for bit, are at the picture's border. So nothing
// is between neighbours, and nothing belongs to two.
TEST(ColourDomain, NeighboursShareTheirBoundaryBitForBit)
{
    const ColourOptions all{.channel = Channel::Alpha};
    const std::vector<ColourRegions> pictures{regionsOf(pie(120, 50.0), all), noise(24, 20, 3, 0, 1),
                                              noise(40, 30, 5, 0, 2), noise(16, 16, 2, 0, 3)};
    for (const ColourRegions& regions : pictures) {
        for (const std::optional<double> edge : {std::optional<double>{}, {1.0}, {4.0}, {30.0}}) {
            const ColourDomain traced = traceColours(regions, inPixels(edge));
            EXPECT_EQ(strayOf(traced), 0.0);
            const double whole = traced.domain.extent.x * traced.domain.extent.y;
            EXPECT_NEAR(totalArea(traced), whole, 1e-9 * whole) << regions.width;
        }
    }
}

TEST(ColourDomain, AreasOfAFlagAddUpToThePicture)
{
    const std::string flag = pixmap(90, 60, [](Vec2 at) {
        return at.x < 30.25 ? kBlue : at.x < 60.625 ? kWhite : kRed;
    });
    const ColourDomain traced = traceColours(regionsOf(flag), inPixels(3.0));
    ASSERT_EQ(traced.domain.droplets.size(), 3U);
    EXPECT_NEAR(totalArea(traced), 90.0 * 60.0 * 1e-6, 1e-9 * 90.0 * 60.0 * 1e-6);
    std::map<std::string, double> areas;
    const ColourRegions regions = regionsOf(flag);
    for (std::size_t k = 0; k < 3; ++k) {
        areas[text(regions.palette[traced.colour[k]].colour)] = area(traced.domain.droplets[k]);
    }
    constexpr double kPlace = 0.02 * 60e-6;  // a fiftieth of a pixel along the boundary
    EXPECT_NEAR(areas["#0062b8"], 30.25 * 60e-6, kPlace);
    EXPECT_NEAR(areas["#ffffff"], 30.375 * 60e-6, kPlace);
    EXPECT_NEAR(areas["#e30613"], 29.375 * 60e-6, kPlace);
}

TEST(ColourDomain, SectorsHaveTheirExactAreas)
{
    const ColourRegions regions = regionsOf(pie(240, 100.0));
    for (const std::optional<double> edge : {std::optional<double>{}, {3.0}}) {
        const ColourDomain traced = traceColours(regions, inPixels(edge));
        ASSERT_EQ(traced.domain.droplets.size(), 3U);
        EXPECT_TRUE(traced.anti_aliased);
        const double sector = std::numbers::pi * 1e4 * 1e-6 / 3.0;
        for (const Footprint& footprint : traced.domain.droplets) {
            EXPECT_NEAR(area(footprint), sector, 1e-3 * sector);
        }
        EXPECT_NEAR(totalArea(traced), 3.0 * sector, 3e-4 * sector);
    }
}

TEST(ColourDomain, IslandIsTheHoleOfItsNeighbour)
{
    const std::string picture = pixmap(80, 80, [](Vec2 at) {
        const double r = length(at - Vec2{40.0, 40.0});
        return r < 14.0 ? kRed : r < 30.0 ? kGold : kWhite;
    });
    const ColourDomain traced = traceColours(regionsOf(picture), inPixels(2.0));
    ASSERT_EQ(traced.domain.droplets.size(), 2U);
    const Footprint& ring = traced.domain.droplets[0];
    const Footprint& island = traced.domain.droplets[1];
    ASSERT_EQ(ring.holes.size(), 1U);
    std::vector<Vec2> hole = ring.holes[0].points;
    std::vector<Vec2> rim = island.rim.points;
    std::reverse(hole.begin(), hole.end());
    std::rotate(hole.begin(), std::find(hole.begin(), hole.end(), rim.front()), hole.end());
    EXPECT_EQ(hole, rim);
    EXPECT_NEAR(area(island), std::numbers::pi * 196e-6, 5e-3 * std::numbers::pi * 196e-6);
}

// Pixels in one row: no loop may cross itself, whatever the labels are.
TEST(ColourDomain, LoopsDoNotCross)
{
    for (unsigned seed = 0; seed < 12; ++seed) {
        const ColourDomain traced = traceColours(noise(20, 20, 3, 1, seed), inPixels(3.0));
        const std::vector<Loop> loops = loopsOf(traced);
        std::vector<std::pair<Vec2, Vec2>> pieces;
        for (const Loop& loop : loops) {
            EXPECT_GT(std::abs(signedArea(loop)), 0.0);
            for (std::size_t i = 0; i < loop.points.size(); ++i) {
                pieces.emplace_back(loop.points[i], loop.points[(i + 1) % loop.points.size()]);
            }
        }
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            for (std::size_t j = i + 1; j < pieces.size(); ++j) {
                const auto& [a, b] = pieces[i];
                const auto& [c, d] = pieces[j];
                const bool meet = a == c || a == d || b == c || b == d;
                const bool cross_here =
                    cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
                ASSERT_FALSE(!meet && cross_here) << seed << " at " << a.x << " " << a.y;
            }
        }
    }
}

TEST(ColourDomain, GapSeparatesNeighbours)
{
    const std::string flag = pixmap(90, 60, [](Vec2 at) { return at.x < 45.25 ? kBlue : kRed; });
    for (const double gap : {0.5, 2.0, 7.0}) {
        ColourTraceOptions options = inPixels();
        options.gap = gap * 1e-3;
        const ColourDomain traced = traceColours(regionsOf(flag), options);
        ASSERT_EQ(traced.domain.droplets.size(), 2U);
        EXPECT_NEAR(totalArea(traced), (90.0 - gap) * 60.0 * 1e-6, 0.1 * 60.0 * 1e-6) << gap;
        const auto right = [](const Footprint& f) {
            double most = -1.0;
            for (const Vec2 p : f.rim.points) {
                most = std::max(most, p.x);
            }
            return most;
        };
        const double blue = std::min(right(traced.domain.droplets[0]), right(traced.domain.droplets[1]));
        EXPECT_NEAR(blue, (0.25 - 0.5 * gap) * 1e-3, 0.1e-3) << gap;
    }
    ColourTraceOptions wide = inPixels();
    wide.gap = 0.2;
    EXPECT_THROW(traceColours(regionsOf(flag), wide), Error);
}

TEST(ColourDomain, SpecksBecomePartOfTheirNeighbour)
{
    std::vector<std::uint8_t> labels(20 * 20, 1);
    labels[10 * 20 + 10] = 2;
    labels[4 * 20 + 4] = 0;
    for (int i = 0; i < 6; ++i) {
        labels[static_cast<std::size_t>(15 * 20 + 5 + i)] = 2;
    }
    const ColourDomain traced = traceColours(labelled(20, 20, labels, 2), inPixels());
    EXPECT_EQ(traced.specks_dropped, 2U);
    EXPECT_EQ(traced.largest_speck_px, 1.0);
    ASSERT_EQ(traced.domain.droplets.size(), 2U);
    EXPECT_EQ(traced.domain.droplets[0].holes.size(), 1U);
}

TEST(ColourDomain, IsTheSameWithAnyNumberOfThreads)
{
    const ColourRegions regions = regionsOf(pie(160, 70.0));
    const auto made = [&](int threads) {
        std::vector<Vec2> points;
        tbb::task_arena(threads).execute([&] {
            for (const Loop& loop : loopsOf(traceColours(regions, inPixels(2.0)))) {
                points.insert(points.end(), loop.points.begin(), loop.points.end());
            }
        });
        return points;
    };
    EXPECT_EQ(made(1), made(4));
}

TEST(ColourDomain, RefusesOptionsOutOfRange)
{
    const ColourRegions regions = labelled(4, 4, std::vector<std::uint8_t>(16, 1), 1);
    ColourTraceOptions options = inPixels();
    options.gap = -1.0;
    EXPECT_THROW(traceColours(regions, options), Error);
    options = inPixels(0.0);
    EXPECT_THROW(traceColours(regions, options), Error);
    EXPECT_THROW(traceColours(labelled(4, 4, std::vector<std::uint8_t>(16, 0), 1), inPixels()), Error);
}

}  // namespace
}  // namespace droplet
