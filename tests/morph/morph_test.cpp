// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/morph/morph.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "droplet/error.h"
#include "liquid2d/region.h"
#include "support/loops.h"

namespace {

using droplet::LiquidShape;
using droplet::Loop;
using droplet::morph;
using droplet::MorphOptions;
using droplet::Region;
using droplet::Vec2;
using droplet::testing::pointsOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Region ring()
{
    Region region = droplet::circle({0.5, 0.5}, 0.3);
    region.loops.push_back(droplet::circle({0.5, 0.5}, 0.1).loops[0]);
    return region;
}

Region twoDiscs()
{
    Region region = droplet::circle({0.25, 0.5}, 0.15);
    region.loops.push_back(droplet::circle({0.75, 0.5}, 0.12).loops[0]);
    return region;
}

MorphOptions quick(std::size_t frames)
{
    MorphOptions options;
    options.size = {1.0, 1.0};
    options.frames = frames;
    options.particles = 4000;
    return options;
}

std::vector<LiquidShape> framesOf(const std::vector<Region>& footprints, const MorphOptions& options)
{
    std::vector<LiquidShape> all;
    morph(footprints, options, [&](std::size_t frame, const LiquidShape& shape) {
        EXPECT_EQ(frame, all.size());
        all.push_back(shape);
    });
    EXPECT_EQ(all.size(), options.frames);
    return all;
}

TEST(Morph, AreaFollowsTheWayAndTheEndsAreTheFootprints)
{
    const std::vector<Region> footprints{ring(), twoDiscs(), droplet::circle({0.5, 0.5}, 0.3)};
    const std::vector<LiquidShape> frames = framesOf(footprints, quick(21));
    const double disc = std::numbers::pi * 0.3 * 0.3;
    const double hollow = std::numbers::pi * (0.3 * 0.3 - 0.1 * 0.1);
    const double two = std::numbers::pi * (0.15 * 0.15 + 0.12 * 0.12);
    for (std::size_t k = 0; k <= 10; ++k) {
        const double t = static_cast<double>(k) / 10.0;
        const double way = t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
        const auto between = [way](double from, double to) {
            return std::pow((1.0 - way) / std::sqrt(from) + way / std::sqrt(to), -2.0);
        };
        EXPECT_NEAR(frames[k].area() / between(hollow, two), 1.0, 1e-3) << k;
        EXPECT_NEAR(frames[10 + k].area() / between(two, disc), 1.0, 1e-3) << k;
    }
    EXPECT_EQ(frames[10].liquid.size(), 2U);
    EXPECT_EQ(pointsOf(frames[20].liquid), footprints[2].loops);
    // The hole runs the other way round.
    ASSERT_EQ(frames[0].liquid.size(), 2U);
    EXPECT_LT(droplet::signedArea(frames[0].liquid[1]), 0.0);
}

/// Two dots that grow where they are.
TEST(Morph, LiquidInBothFootprintsStaysInItsPlace)
{
    const auto dots = [](double radius) {
        Region region = droplet::circle({0.25, 0.5}, radius);
        region.loops.push_back(droplet::circle({0.75, 0.5}, radius).loops[0]);
        return region;
    };
    for (const LiquidShape& frame : framesOf({dots(0.06), dots(0.2)}, quick(13))) {
        ASSERT_EQ(frame.liquid.size(), 2U);
        for (const Loop& loop : frame.liquid) {
            Vec2 middle;
            for (const Vec2 p : loop.points) {
                middle = middle + (1.0 / static_cast<double>(loop.points.size())) * p;
            }
            // The liquid is a little behind its way.
            EXPECT_NEAR(std::abs(middle.x - 0.5), 0.25, 0.02);
            EXPECT_NEAR(middle.y, 0.5, 0.01);
        }
    }
}

TEST(Morph, OutlinesNextToTheEndsAreCloseToTheFootprints)
{
    const Region disc = droplet::circle({0.5, 0.5}, 0.3);
    const Region square = droplet::rectangle({0.2, 0.2}, {0.8, 0.8});
    const std::vector<LiquidShape> frames = framesOf({disc, square}, quick(41));
    const double area = std::numbers::pi * 0.3 * 0.3;
    const double spacing = std::sqrt(area / 4000.0);
    ASSERT_EQ(frames[1].liquid.size(), 1U);
    const double radius = std::sqrt(frames[1].area() / std::numbers::pi);
    for (const Vec2 p : frames[1].liquid[0].points) {
        EXPECT_NEAR(droplet::length(p - Vec2{0.5, 0.5}), radius, 0.3 * spacing);
    }
    ASSERT_EQ(frames[39].liquid.size(), 1U);
    const double half = 0.5 * std::sqrt(frames[39].area());
    for (const Vec2 p : frames[39].liquid[0].points) {
        EXPECT_NEAR(std::max(std::abs(p.x - 0.5), std::abs(p.y - 0.5)), half, 0.5 * spacing);
    }
}

TEST(Morph, SameBytesAtAnyNumberOfThreads)
{
    const std::vector<Region> footprints{ring(), twoDiscs()};
    std::vector<std::vector<std::vector<Vec2>>> results;
    for (const std::size_t threads : {1U, 4U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        MorphOptions options = quick(5);
        options.particles = 1000;
        results.push_back(pointsOf(framesOf(footprints, options)[2].liquid));
    }
    EXPECT_EQ(results[0], results[1]);
}

TEST(Morph, RefusesWhatCannotFlow)
{
    const Region disc = droplet::circle({0.5, 0.5}, 0.3);
    const auto run = [](const std::vector<Region>& footprints, const MorphOptions& options) {
        return [=] { morph(footprints, options, [](std::size_t, const LiquidShape&) {}); };
    };
    EXPECT_THAT(run({disc}, quick(10)), ThrowsMessage<droplet::Error>(HasSubstr("footprints is 1")));
    EXPECT_THAT(run({disc, disc, disc}, quick(4)), ThrowsMessage<droplet::Error>(HasSubstr("frames is 4")));
    EXPECT_THAT(run({disc, {}}, quick(10)), ThrowsMessage<droplet::Error>(HasSubstr("area of a footprint is 0")));
    MorphOptions few = quick(10);
    few.particles = 100;
    EXPECT_THAT(run({disc, disc}, few), ThrowsMessage<droplet::Error>(HasSubstr("particles is 100")));
}

/// A hole that collapses stays round, and goes before the end: it is no cogwheel, and has no cracks.
TEST(Morph, HoleOfARingCollapsesRoundly)
{
    const std::vector<LiquidShape> frames = framesOf({ring(), droplet::circle({0.5, 0.5}, 0.3)}, quick(41));
    double before = 0.1;
    for (std::size_t k = 1; k < 40; ++k) {
        const std::vector<Loop>& loops = frames[k].liquid;
        ASSERT_LE(loops.size(), 2U) << k;
        if (loops.size() == 1) {
            EXPECT_GT(k, 20U);
            before = 0.0;
            continue;
        }
        const Loop& hole = droplet::signedArea(loops[0]) < 0.0 ? loops[0] : loops[1];
        double least = 1.0;
        double most = 0.0;
        for (const Vec2 p : hole.points) {
            const double radius = droplet::length(p - Vec2{0.5, 0.5});
            least = std::min(least, radius);
            most = std::max(most, radius);
        }
        // Particles are 0.008 apart.
        EXPECT_LT(most - least, 0.006) << k;
        EXPECT_LT(most, before + 0.004) << k;
        before = most;
    }
}

}  // namespace
