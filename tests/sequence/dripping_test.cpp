// SPDX-License-Identifier: GPL-3.0-or-later
// Drops that fall from droplets under a ceiling: how much hangs and how much falls, free fall, and the volume of all.
#include "droplet/sequence/dripping.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/sequence/sequence_report.h"
#include "droplet/units.h"
#include "support/masks.h"

namespace droplet {
namespace {

using testing::disc;
using ::testing::HasSubstr;
using testing::Inside;
using testing::smoothMask;

constexpr double kPixel = 0.05 * kMillimetre;

Outline outlineOf(const Inside& inside)
{
    return trace(smoothMask(256, 128, inside), {.pixel_size = kPixel});
}

/// Discs with radii of 2 and 1 mm.
Outline twoDiscs()
{
    return outlineOf([](Vec2 p) { return disc({64, 64}, 40)(p) || disc({190, 64}, 20)(p); });
}

SequenceOptions underACeiling(double volume)
{
    SequenceOptions options;
    options.droplet.mesh.triangles = 3000;
    options.droplet.solve.tilt = std::numbers::pi;
    options.droplet.solve.fill = {FillBy::Volume, volume, FillSharing::Each};
    options.volume_mode = VolumeMode::Track;
    return options;
}

double capillaryLengthOf(const SequenceOptions& options)
{
    return *capillaryLength(options.droplet.solve.liquid, options.droplet.solve.gravity);
}

double volumeOf(const Frame& frame)
{
    double volume = frame.droplet.total.volume;
    for (const FallingDrop& drop : frame.falling) {
        volume += drop.volume;
    }
    return volume;
}

// L. W. Y. Lee, M. J. Chan and R. Pogaku's fit of Harkins' and Brown's fractions.
double fraction(double x)
{
    return 1.0 + x * (-0.9121 + x * (-2.109 + x * (13.38 + x * (-27.29 + x * (27.53 + x * (-13.58 + x * 2.593))))));
}

TEST(Dripping, DiscsShedWhatHarkinsAndBrownMeasured)
{
    // Radius, and largest volume that hangs, by the equation of Young and Laplace; in capillary lengths.
    for (const Vec2 tip : {Vec2{0.3, 1.4442}, {0.5, 2.3859}, {0.9, 4.6207}, {1.5, 8.8818}, {2.2, 14.3787}}) {
        const double drop = fallingShare(tip.y * 8e-9, 2e-3) * tip.y;
        EXPECT_NEAR(2.0 * std::numbers::pi * tip.x * fraction(tip.x / std::cbrt(drop)) / drop, 1.0, 0.01) << tip.x;
    }
    EXPECT_EQ(fallingShare(1e-9, 2e-3), fallingShare(2e-9, 2e-3)) << "no thinner tips were measured";
    EXPECT_GT(fallingShare(1e3, 2e-3), 0.6);
    EXPECT_THROW(fallingShare(0.0, 2e-3), Error);
    EXPECT_THROW(fallingShare(1e-9, 0.0), Error);
}

// Every amount of liquid is on the ceiling, on its way, or accounted for; drops have the sizes of their footprints.
TEST(Dripping, ConservesTheVolumeAndShedsDropsOfTheSizesOfFootprints)
{
    const Outline outline = twoDiscs();
    const SequenceOptions options = underACeiling(30 * kMicrolitre);
    const DrippingOptions dripping{.inflow = 600 * kMicrolitre, .time_step = 8e-3, .way = 8e-3};
    const double length = capillaryLengthOf(options);
    const double largest = 3.6264 * length * length * length;  // of 2 mm
    Frame frame = firstFrame(outline, options);
    std::vector<double> drops(2);
    std::size_t continued = 0;
    double lost = 0.0;
    for (int k = 0; k < 24; ++k) {
        const Frame next = nextDripping(frame, outline, options, dripping);
        const double expected = volumeOf(frame) + next.volume_gained - next.volume_lost;
        EXPECT_NEAR(volumeOf(next) / expected, 1.0, 1e-9) << k;
        ASSERT_NO_THROW(next.droplet.surface.validate());
        EXPECT_TRUE(topology(next.droplet.surface).closed);
        ASSERT_EQ(next.droplet.surface.parts.size(), 2 + next.falling.size());
        EXPECT_LE(next.droplet.figures[0].volume, 1.03 * largest);
        for (std::size_t i = 0; i < next.falling.size(); ++i) {
            const FallingDrop& drop = next.falling[i];
            drops.at(drop.droplet) = drop.volume;
            const Surface ball = extract(next.droplet.surface, {2 + i});
            EXPECT_NEAR(enclosedVolume(ball) / drop.volume, 1.0, 1e-9);
            EXPECT_NEAR(drop.place().z, drop.start.z + 0.5 * kStandardGravity * drop.since * drop.since, 1e-12);
        }
        continued += next.continues ? 1 : 0;
        lost += next.volume_lost;
        frame = next;
    }
    EXPECT_GE(frame.drops_shed, 2U);
    EXPECT_GT(lost, 0.0);
    EXPECT_NEAR(drops[0] / (0.824 * largest), 1.0, 0.03);
    EXPECT_LT(drops[1], 0.6 * drops[0]);
    EXPECT_GT(drops[1], 0.3 * drops[0]);
    EXPECT_GT(continued, 12U) << "vertices stay while droplets grow and drops fall";
}

TEST(Dripping, BallsBeginBelowWhatStays)
{
    const Outline outline = outlineOf(disc({64, 64}, 40));
    const SequenceOptions options = underACeiling(70 * kMicrolitre);
    const Frame frame = nextDripping(firstFrame(outline, options), outline, options,
                                     {.inflow = 1000 * kMicrolitre, .time_step = 6e-3, .way = 1.0});
    ASSERT_EQ(frame.falling.size(), 1U);
    const double radius = std::cbrt(frame.falling[0].volume * 3.0 / (4.0 * std::numbers::pi));
    EXPECT_GE(frame.falling[0].start.z - radius, frame.droplet.figures[0].height_max * (1.0 - 1e-12));
}

// A flood sheds several drops in one step.
TEST(Dripping, ShedsAsManyDropsAsItTakes)
{
    const Outline outline = outlineOf(disc({64, 64}, 40));
    const SequenceOptions options = underACeiling(60 * kMicrolitre);
    const Frame first = firstFrame(outline, options);
    const Frame flood =
        nextDripping(first, outline, options, {.inflow = 200 * kMicrolitre, .time_step = 1.0, .way = 100.0});
    EXPECT_EQ(flood.falling.size(), 4U);
    EXPECT_NEAR(volumeOf(flood) / (260 * kMicrolitre), 1.0, 1e-9);
    EXPECT_GT(flood.falling[0].since, flood.falling[1].since);
}

TEST(Dripping, WarnsWhereADropletGrowsIntoItsDrop)
{
    const Outline outline = outlineOf(disc({64, 64}, 40));
    const SequenceOptions options = underACeiling(70 * kMicrolitre);
    const DrippingOptions flood{.inflow = 10'000 * kMicrolitre, .time_step = 1e-3, .way = 1.0};
    Frame frame = firstFrame(outline, options);
    std::string warnings;
    for (int k = 0; k < 8; ++k) {
        frame = nextDripping(frame, outline, options, flood);
        for (const std::string& warning : frame.droplet.warnings) {
            warnings += warning;
        }
    }
    EXPECT_THAT(warnings, HasSubstr("runs rather than drips"));
}

// A star with long thin rays ends where the solver ends, long before gravity does.
TEST(Dripping, RefusesLimitsThatAreNotOfGravity)
{
    const Outline outline = outlineOf([](Vec2 p) {
        return (std::abs(p.x - 64) < 50 && std::abs(p.y - 64) < 1.5) ||
               (std::abs(p.y - 64) < 50 && std::abs(p.x - 64) < 1.5);
    });
    const SequenceOptions options = underACeiling(0.1 * kMicrolitre);
    Frame frame = firstFrame(outline, options);
    try {
        for (int k = 0; k < 20; ++k) {
            frame = nextDripping(frame, outline, options, {.inflow = 10 * kMicrolitre, .time_step = 0.1, .way = 1.0});
        }
        FAIL() << frame.drops_shed << " drops";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::NoSuchDroplet);
        EXPECT_THAT(error.what(), HasSubstr("largest volume was not found"));
    }
}

TEST(Dripping, GoesOnFromBytes)
{
    const Outline outline = outlineOf(disc({64, 64}, 40));
    const SequenceOptions options = underACeiling(70 * kMicrolitre);
    const DrippingOptions dripping{.inflow = 1000 * kMicrolitre, .time_step = 6e-3, .way = 1.0};
    const Frame frame = nextDripping(firstFrame(outline, options), outline, options, dripping);
    const Frame next = nextDripping(frame, outline, options, dripping);
    const Frame same = nextDripping(frameFromBytes(bytesOf(frame), "state"), outline, options, dripping);
    EXPECT_EQ(bytesOf(next), bytesOf(same));
    EXPECT_EQ(next.droplet.surface.vertices, same.droplet.surface.vertices);
    const std::vector<FrameReport> reports{reportOf(next, options)};
    const std::vector<FrameReport> read = frameReportsFromBytes(bytesOf(reports), "state");
    EXPECT_EQ(read[0].falling.size(), 1U);
    EXPECT_EQ(read[0].falling[0].place(), next.falling[0].place());
    EXPECT_EQ(read[0].drops_shed, 1U);
}

TEST(Dripping, RefusesWhatIsNoCeiling)
{
    const Outline outline = outlineOf(disc({64, 64}, 40));
    SequenceOptions options = underACeiling(20 * kMicrolitre);
    const Frame frame = firstFrame(outline, options);
    const auto refusal = [&](const SequenceOptions& tried, const DrippingOptions& dripping) {
        try {
            (void)nextDripping(frame, outline, tried, dripping);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(refusal(options, {.inflow = 0.0}), HasSubstr("inflow"));
    EXPECT_THAT(refusal(options, {.time_step = -1.0}), HasSubstr("time_step"));
    EXPECT_THAT(refusal(options, {.way = 0.0}), HasSubstr("way"));
    for (const double tilt : {0.0, 90.0, 170.0}) {
        options.droplet.solve.tilt = tilt * kDegree;
        EXPECT_THAT(refusal(options, {}), HasSubstr("level ceiling")) << tilt;
    }
    options = underACeiling(20 * kMicrolitre);
    options.volume_mode = VolumeMode::Fill;
    EXPECT_THAT(refusal(options, {}), HasSubstr("track"));
}

}  // namespace
}  // namespace droplet
