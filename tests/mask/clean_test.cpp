// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mask/clean.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "droplet/domain/domain.h"
#include "droplet/error.h"
#include "support/masks.h"

namespace droplet {
namespace {

using testing::disc;
using testing::smoothMask;

constexpr double kPixel = 1e-4;  // [m]

double covered(const Mask& mask)
{
    return std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0) / 65535.0;
}

Mask cleaned(const Mask& mask, const CleanOptions& options)
{
    return clean(mask, options, kPixel, 0.5);
}

/// Ring with a hole of radius 15, and a disc of radius 25 with a glint of radius 4.
testing::Inside ringAndGlint()
{
    return [ring = disc({40, 40}, 30), hole = disc({40, 40}, 15), blot = disc({110, 40}, 25),
            glint = disc({104, 33}, 4)](Vec2 p) { return (ring(p) && !hole(p)) || (blot(p) && !glint(p)); };
}

TEST(Clean, DoesNothingByDefault)
{
    const Mask mask = smoothMask(150, 80, ringAndGlint());
    EXPECT_FALSE(CleanOptions{}.any());
    EXPECT_EQ(cleaned(mask, {}).coverage, mask.coverage);
}

TEST(Clean, FillsAGlintAndKeepsARing)
{
    const Mask mask = smoothMask(150, 80, ringAndGlint());
    CleanOptions options;
    options.fill_holes = 100.0 * kPixel * kPixel;
    const Mask filled = cleaned(mask, options);
    const double pi = std::numbers::pi;
    EXPECT_NEAR(covered(filled), pi * (30 * 30 - 15 * 15 + 25 * 25), 2.0) << "the glint left no dent";
    options.fill_holes = 1000.0 * kPixel * kPixel;
    EXPECT_NEAR(covered(cleaned(mask, options)), pi * (30 * 30 + 25 * 25), 3.0);
    options.fill_holes = 20.0 * kPixel * kPixel;
    EXPECT_EQ(cleaned(mask, options).coverage, mask.coverage);
}

TEST(Clean, KeepsDryGroundAtTheBorder)
{
    const Mask mask = testing::hardMask(40, 40, [](Vec2 p) { return p.x > 3 && !disc({20, 0}, 5)(p); });
    CleanOptions options;
    options.fill_holes = 1.0;
    EXPECT_EQ(cleaned(mask, options).coverage, mask.coverage);
}

TEST(Clean, KeepsTheLargestDroplets)
{
    const Mask mask = smoothMask(200, 60, [](Vec2 p) {
        return disc({30, 30}, 20)(p) || disc({80, 30}, 10)(p) || disc({120, 30}, 15)(p) || disc({160, 30}, 10)(p);
    });
    CleanOptions options;
    options.keep = 2;
    const Mask kept = cleaned(mask, options);
    EXPECT_NEAR(covered(kept), std::numbers::pi * (20 * 20 + 15 * 15), 2.0) << "edges included";
    EXPECT_EQ(kept.at(80, 30), 0);
    options.keep = 3;
    EXPECT_EQ(cleaned(mask, options).at(80, 30), 65535) << "the first of two equal ones";
    EXPECT_EQ(cleaned(mask, options).at(160, 30), 0);
    options.keep = 9;
    EXPECT_EQ(cleaned(mask, options).coverage, mask.coverage);
}

TEST(Clean, SmoothingRemovesSpotsAndTeethButKeepsAreaAndStraightRims)
{
    const Mask teeth = smoothMask(200, 200, [](Vec2 p) {
        const double tooth = static_cast<int>(p.y) % 6 < 3 ? 2.0 : -2.0;
        return p.x < 100.3 + tooth || disc({150, 100}, 2.5)(p);
    });
    CleanOptions options;
    options.smooth = 8 * kPixel;
    const Mask smoothed = cleaned(teeth, options);
    EXPECT_EQ(smoothed.at(150, 100), 0);
    for (int y = 20; y < 180; ++y) {
        double row = 0.0;
        for (int x = 0; x < 200; ++x) {
            row += smoothed.at(x, y) / 65535.0;
        }
        EXPECT_NEAR(row, 100.3, 0.25) << y;
    }
    const Mask round = smoothMask(200, 200, disc({100, 100}, 60));
    EXPECT_NEAR(covered(cleaned(round, options)) / covered(round), 1.0, 0.01);
    // Wide smoothing works on a smaller image.
    options.smooth = 40 * kPixel;
    const Mask half = smoothMask(200, 200, [](Vec2 p) { return p.x < 100.5; });
    EXPECT_NEAR(covered(cleaned(half, options)) / covered(half), 1.0, 0.01);
    options.smooth = 1.0;
    EXPECT_NO_THROW(cleaned(half, options));
}

TEST(Clean, HappensBeforeTracing)
{
    TraceOptions options;
    options.pixel_size = kPixel;
    options.clean.keep = 1;
    options.clean.fill_holes = 100.0 * kPixel * kPixel;
    const Mask mask = smoothMask(150, 80, ringAndGlint());
    const Domain domain = split(trace(mask, options));
    ASSERT_EQ(domain.droplets.size(), 1U);
    EXPECT_EQ(domain.droplets[0].holes.size(), 1U) << "the hole of the ring";
}

TEST(Clean, RejectsOptionsOutOfRange)
{
    CleanOptions options;
    options.smooth = -1.0;
    EXPECT_THROW(options.validate(), Error);
    options = {};
    options.fill_holes = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(options.validate(), Error);
    options = {};
    options.keep = 0;
    EXPECT_THROW(options.validate(), Error);
}

}  // namespace
}  // namespace droplet
