// SPDX-License-Identifier: GPL-3.0-or-later
#include "expression/field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "expression/isoline.h"

namespace {

using droplet::ExpressionOptions;
using droplet::ExpressionState;
using droplet::Loop;
using droplet::ParticleFrame;
using droplet::Vec2;

/// Liquid with gaps of all sizes, and spray.
ParticleFrame porous(unsigned seed)
{
    std::mt19937 random(seed);
    const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
    ParticleFrame frame;
    frame.spacing = 0.02;
    std::vector<std::pair<Vec2, double>> gaps;
    for (int k = 0; k < 60; ++k) {
        const double x = number();
        gaps.push_back({{x, number()}, 0.03 * number()});
    }
    for (int j = 0; j < 60; ++j) {
        for (int i = 0; i < 60; ++i) {
            Vec2 p{0.02 * (i + 0.5), 0.02 * (j + 0.5)};
            p.x += 0.012 * (number() - 0.5);
            p.y += 0.012 * (number() - 0.5);
            bool is_liquid = true;
            for (const auto& [centre, radius] : gaps) {
                is_liquid = is_liquid && length(p - centre) > radius;
            }
            if (is_liquid) {
                frame.position.push_back(p);
            }
        }
    }
    for (int k = 0; k < 100; ++k) {
        const double x = -1.0 + 3.0 * number();
        frame.position.push_back({x, 1.3 + number()});
    }
    frame.velocity.resize(frame.position.size());
    for (std::uint32_t i = 0; i < frame.position.size(); ++i) {
        frame.id.push_back(i);
    }
    return frame;
}

TEST(LiquidField, SkipsNoGapOfTheLiquid)
{
    for (const double smoothing : {0.5, 1.0, 1.5}) {
        for (unsigned seed = 0; seed < 10; ++seed) {
            ExpressionOptions options;
            options.smoothing = smoothing;
            const ParticleFrame frame = porous(seed);
            const ExpressionState state = advanceExpression({}, frame, options);
            const auto near = isolines(fieldOf({}, state, frame, options));
            const auto all = isolines(fieldOf({}, state, frame, options, true));
            double area = 0.0;
            double all_area = 0.0;
            for (const Loop& loop : near) {
                area += signedArea(loop);
            }
            for (const Loop& loop : all) {
                all_area += signedArea(loop);
            }
            EXPECT_EQ(near.size(), all.size()) << smoothing << " " << seed;
            EXPECT_NEAR(area, all_area, 1e-9) << smoothing << " " << seed;
        }
    }
}

TEST(LiquidField, LoopsAreClosedAndStepFromCellToCell)
{
    const ParticleFrame frame = porous(3);
    const ExpressionOptions options;
    const auto loops = isolines(fieldOf({}, advanceExpression({}, frame, options), frame, options));
    ASSERT_GT(loops.size(), 20U);
    for (const Loop& loop : loops) {
        ASSERT_GE(loop.points.size(), 3U);
        ASSERT_EQ(loop.corner.size(), loop.points.size());
        for (std::size_t k = 0; k < loop.points.size(); ++k) {
            const double step = length(loop.points[(k + 1) % loop.points.size()] - loop.points[k]);
            EXPECT_GT(step, 0.0);
            EXPECT_LT(step, 1.42 * 0.5 * frame.spacing);
        }
    }
}

TEST(LiquidField, HoldsNodesAtTheRimAlone)
{
    ParticleFrame frame;
    frame.spacing = 1.0;
    for (int j = 0; j < 400; ++j) {
        for (int i = 0; i < 400; ++i) {
            frame.position.push_back({i + 0.5, j + 0.5});
            frame.id.push_back(static_cast<std::uint32_t>(frame.id.size()));
        }
    }
    // A droplet far away costs no more than one nearby.
    frame.position.push_back({1e6, 1e6});
    frame.id.push_back(static_cast<std::uint32_t>(frame.id.size()));
    frame.velocity.resize(frame.position.size());
    const auto field = fieldOf({}, advanceExpression({}, frame, {}), frame, {});
    // 4·50 tiles along the sides of the square on either side of its rim, and those around the droplet.
    EXPECT_LT(field.tiles.size(), 450U);
}

}  // namespace
