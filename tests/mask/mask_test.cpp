// SPDX-License-Identifier: GPL-3.0-or-later
// Tests which pixels become liquid. The pictures are 16-bit PGMs and PNGs made here; the codecs have their own tests.
#include "droplet/mask/mask.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/outline/outline.h"
#include "image/encoded_images.h"

namespace droplet {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

using Bytes = std::vector<std::byte>;

/// Grey picture of 16-bit levels.
struct Grey {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> levels;

    Grey(int w, int h, const std::function<double(int, int)>& level) : width(w), height(h)
    {
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                levels.push_back(static_cast<std::uint16_t>(std::lround(level(x, y) * 65535)));
            }
        }
    }

    [[nodiscard]] Bytes encoded() const
    {
        const std::string header = "P5 " + std::to_string(width) + " " + std::to_string(height) + " 65535\n";
        Bytes bytes;
        for (const char c : header) {
            bytes.push_back(static_cast<std::byte>(c));
        }
        for (const std::uint16_t level : levels) {
            bytes.push_back(static_cast<std::byte>(level >> 8));
            bytes.push_back(static_cast<std::byte>(level & 255));
        }
        return bytes;
    }

    [[nodiscard]] Grey negative() const
    {
        Grey other = *this;
        for (std::uint16_t& level : other.levels) {
            level = static_cast<std::uint16_t>(65535 - level);
        }
        return other;
    }
};

/// Picture of 8-bit grey and alpha: 0xAAVV per pixel.
Bytes greyAlpha(int width, int height, const std::vector<unsigned>& pixels)
{
    encoded::Raster raster{width, height, 2, 8, {}};
    for (const unsigned pixel : pixels) {
        raster.samples.push_back(pixel & 255U);
        raster.samples.push_back(pixel >> 8);
    }
    return encodePng(raster, {PNG_COLOR_TYPE_GRAY_ALPHA, false, {}, {}, nullptr});
}

double ellipse(double x, double y)
{
    // Coverage of a soft-edged ellipse well inside 40 × 30.
    const double distance = std::hypot((x - 19.3) / 12, (y - 14.6) / 8);
    return std::clamp(0.5 + 6 * (1 - distance), 0.0, 1.0);
}

TEST(Mask, AcceptsOnlyACoverageOfItsSize)
{
    Mask mask;
    mask.width = 3;
    mask.height = 2;
    mask.coverage.assign(6, 0);
    EXPECT_NO_THROW(mask.validate());

    mask.coverage.pop_back();
    EXPECT_THAT([&] { mask.validate(); },
                testing::ThrowsMessage<Error>(AllOf(HasSubstr("coverage holds 5"), HasSubstr("= 6"))));
    mask.coverage.clear();
    mask.width = 0;
    EXPECT_THAT([&] { mask.validate(); }, testing::ThrowsMessage<Error>(HasSubstr("0 x 2")));
    mask.width = -1;
    mask.height = -1;
    mask.coverage.assign(1, 0);
    EXPECT_THROW(mask.validate(), Error);
}

TEST(MaskLevels, WhiteOnBlackIsNotChanged)
{
    const Grey picture(40, 30, ellipse);
    const Mask mask = decodeMask(picture.encoded());
    EXPECT_EQ(mask.coverage, picture.levels);
    EXPECT_EQ(mask.channel, Channel::Luma);
    EXPECT_FALSE(mask.inverted);
    EXPECT_EQ(mask.level_dry, 0.0);
    EXPECT_EQ(mask.level_liquid, 1.0);
}

TEST(MaskLevels, BlackOnWhiteGivesTheSameCoverage)
{
    const Grey picture(40, 30, ellipse);
    const Mask mask = decodeMask(picture.negative().encoded());
    EXPECT_EQ(mask.coverage, picture.levels);
    EXPECT_TRUE(mask.inverted);
    EXPECT_EQ(mask.level_dry, 1.0);
    EXPECT_EQ(mask.level_liquid, 0.0);
}

TEST(MaskLevels, PaleInkIsStretchedToFullCoverage)
{
    const Grey pale(40, 30, [](int x, int y) { return 0.9 - 0.5 * ellipse(x, y); });
    const Mask mask = decodeMask(pale.encoded());
    ASSERT_EQ(mask.coverage.size(), pale.levels.size());
    for (int y = 0; y < 30; ++y) {
        for (int x = 0; x < 40; ++x) {
            // Two roundings to 16 bits; the first is magnified by 1 / 0.5.
            EXPECT_NEAR(mask.at(x, y) / 65535.0, ellipse(x, y), 2.0 / 65535);
        }
    }
    EXPECT_NEAR(mask.level_dry, 0.9, 1e-5);
    EXPECT_NEAR(mask.level_liquid, 0.4, 1e-5);
    EXPECT_TRUE(mask.inverted);
}

TEST(MaskLevels, InvertExchangesLiquidAndDryToTheBit)
{
    const Grey pale(40, 30, [](int x, int y) { return 0.13 + 0.61 * ellipse(x, y); });
    MaskOptions options;
    options.invert = true;
    for (const Channel channel : {Channel::Auto, Channel::Luma}) {
        options.channel = channel;
        MaskOptions as_is = options;
        as_is.invert = false;
        const Mask mask = decodeMask(pale.encoded(), as_is);
        const Mask inverted = decodeMask(pale.encoded(), options);
        for (std::size_t i = 0; i < mask.coverage.size(); ++i) {
            ASSERT_EQ(mask.coverage[i] + inverted.coverage[i], 65535);
        }
        EXPECT_NE(mask.inverted, inverted.inverted);
        EXPECT_EQ(mask.level_dry, inverted.level_liquid);
        EXPECT_EQ(mask.level_liquid, inverted.level_dry);
    }
}

TEST(MaskLevels, RequestedLumaIsAbsolute)
{
    const Grey pale(40, 30, [](int x, int y) { return 0.9 - 0.5 * ellipse(x, y); });
    MaskOptions options;
    options.channel = Channel::Luma;
    const Mask mask = decodeMask(pale.encoded(), options);
    EXPECT_EQ(mask.coverage, pale.levels);
    EXPECT_FALSE(mask.inverted);
    EXPECT_EQ(mask.level_liquid, 1.0);
}

TEST(MaskLevels, BorderIsDryEvenIfAMarkTouchesIt)
{
    // The mark covers a third of the border.
    const Grey picture(30, 30, [](int x, int) { return x < 14 ? 0.0 : 1.0; });
    const Mask mask = decodeMask(picture.encoded());
    EXPECT_EQ(mask.at(0, 15), 65535);
    EXPECT_EQ(mask.at(29, 15), 0);
}

TEST(MaskLevels, MarkOnTheFartherSideOfAGreyGroundWins)
{
    const Grey picture(20, 20, [](int x, int y) {
        const bool inside = y > 5 && y < 14;
        return inside && x > 2 && x < 8 ? 0.2 : inside && x > 11 && x < 17 ? 0.9 : 0.5;
    });
    const Mask mask = decodeMask(picture.encoded());
    EXPECT_EQ(mask.at(14, 10), 65535) << "brighter by 0.4";
    EXPECT_EQ(mask.at(5, 10), 0) << "darker by 0.3: dry";
    const Mask negative = decodeMask(picture.negative().encoded());
    EXPECT_EQ(negative.coverage, mask.coverage);
}

TEST(MaskLevels, HotPixelsDoNotSetTheLevel)
{
    const Grey clean(100, 100, [](int x, int y) { return 0.8 - 0.35 * ellipse(0.4 * x, 0.3 * y); });
    Grey spotted = clean;
    spotted.levels[205] = 0;
    spotted.levels[7777] = 0;
    spotted.levels[5050] = 65535;
    const Mask mask = decodeMask(spotted.encoded());
    EXPECT_NEAR(mask.level_liquid, 0.45, 1e-5);
    EXPECT_EQ(mask.at(50, 48), 65535);
    EXPECT_EQ(mask.at(5, 2), 65535) << "darker than liquid is liquid";
    EXPECT_EQ(mask.at(50, 50), 0) << "brighter than the ground is dry";
}

TEST(MaskLevels, TinyMarkInALargeImageKeepsItsLevel)
{
    const Grey picture(1500, 1500, [](int x, int y) { return x == 700 && y > 700 && y < 704 ? 0.4 : 1.0; });
    const Mask mask = decodeMask(picture.encoded());
    EXPECT_EQ(mask.at(700, 702), 65535);
    EXPECT_NEAR(mask.level_liquid, 0.4, 1e-5);
}

TEST(MaskLevels, SoftMarkKeepsItsPeak)
{
    // Only one pixel of a cone reaches the top, but the top is not a stray.
    const Grey cone(101, 101, [](int x, int y) { return std::max(0.0, 1 - std::hypot(x - 50, y - 50) / 45); });
    EXPECT_EQ(decodeMask(cone.encoded()).coverage, cone.levels);
}

TEST(MaskLevels, NoiseOfAScanShiftsHalfCoverageByLessThanASixteenthOfTheStep)
{
    // Ground 0.8, mark 0.3, uniform noise of up to ±0.04
    const Grey scan(200, 200, [](int x, int y) {
        const double noise = 0.04 * ((x * 7919 + y * 104729) % 201 - 100) / 100.0;
        return (x > 60 && x < 140 && y > 60 && y < 140 ? 0.3 : 0.8) + noise;
    });
    const Mask mask = decodeMask(scan.encoded());
    EXPECT_NEAR(mask.level_dry, 0.8, 0.005);
    EXPECT_NEAR((mask.level_dry + mask.level_liquid) / 2, 0.55, 0.5 / 16);
    EXPECT_GT(mask.at(100, 100), 55000);
    EXPECT_LT(mask.at(10, 10), 10000);
}

TEST(MaskLevels, FaintPictureIsNotStretchedAndHoldsNoLiquid)
{
    for (const double ground : {0.1, 0.5, 0.95}) {
        for (const double step : {-0.09, 0.04, 0.24, -0.24}) {
            if (ground + step < 0 || ground + step > 1) {
                continue;
            }
            const Grey faint(20, 20, [&](int x, int y) {
                return x > 5 && x < 15 && y == 10 ? ground + step * (x % 2 == 0 ? 1.0 : 0.5) : ground;
            });
            const Mask mask = decodeMask(faint.encoded());
            EXPECT_THAT(mask.coverage, Each(testing::Lt(32768))) << ground << " " << step;
            EXPECT_NEAR(mask.level_dry, ground, 1e-5);
        }
    }
    const Grey clear(20, 20, [](int x, int y) { return x > 5 && x < 15 && y == 10 ? 0.3501 : 0.1; });
    EXPECT_EQ(decodeMask(clear.encoded()).at(10, 10), 65535) << "a quarter of the range is enough";
}

TEST(MaskLevels, HigherOfTwoDarkLevelsIsLiquid)
{
    // As tools for segmentation write masks: 0 and 1 or 20 of 255, 12 bits in 16; also where the border is liquid.
    for (const auto& [lower, higher] : {std::pair{0.0, 1.0}, {0.0, 20.0}, {1.0, 2.0}, {0.0, 4095.0 / 257}}) {
        for (const bool at_border : {false, true}) {
            const Grey picture(40, 30, [&, low = lower, high = higher](int x, int y) {
                return (ellipse(x, y) > 0.5 ? at_border ? low : high : at_border ? high : low) / 255;
            });
            const Mask mask = decodeMask(picture.encoded());
            EXPECT_EQ(mask.at(19, 14), at_border ? 0 : 65535) << higher;
            EXPECT_EQ(mask.at(1, 1), at_border ? 65535 : 0) << higher;
            EXPECT_FALSE(mask.inverted);
            EXPECT_NEAR(mask.level_liquid, higher / 255, 1e-5);
            EXPECT_TRUE(mask.found);
        }
    }
}

TEST(MaskLevels, TwoDarkLevelsMayHaveSoftRims)
{
    const Grey picture(40, 30, ellipse);
    const Mask mask = decodeMask(Grey(40, 30, [](int x, int y) { return ellipse(x, y) / 16; }).encoded());
    for (std::size_t k = 0; k < picture.levels.size(); ++k) {
        ASSERT_NEAR(mask.coverage[k], picture.levels[k], 9);
    }
}

TEST(MaskLevels, PaleDrawingOfTwoLevelsHasItsGroundAtTheBorder)
{
    for (const auto& [ground, ink] : {std::pair{1.0, 0.85}, {0.7, 0.85}}) {
        const Mask mask = decodeMask(Grey(40, 30, [&, paper = ground, mark = ink](int x, int y) {
                                         return ellipse(x, y) > 0.5 ? mark : paper;
                                     }).encoded());
        EXPECT_EQ(mask.at(19, 14), 65535) << ink;
        EXPECT_EQ(mask.at(1, 1), 0) << ink;
    }
}

TEST(MaskLevels, SeveralLabelsAreListedAndChosenByThresholdOrColour)
{
    const Grey labels(40, 30, [](int x, int y) { return (ellipse(x, y) > 0.5 ? x < 20 ? 1.0 : 2.0 : 0.0) / 255; });
    const Mask mask = decodeMask(labels.encoded());
    EXPECT_THAT([&] { trace(mask); }, testing::ThrowsMessage<Error>(
                                          AllOf(HasSubstr("levels 0, 1 and 2 of 255: choose a threshold, 0.0059 for"),
                                                HasSubstr("or a colour"), testing::Not(HasSubstr("--")))));
    TraceOptions from_two;
    from_two.threshold = 0.0059;
    const Outline right = trace(mask, from_two);
    ASSERT_EQ(right.loops.size(), 1U);
    for (const Vec2 p : right.loops[0].points) {
        EXPECT_GE(p.x, -1e-3 * right.extent.x);
    }
    MaskOptions one;
    one.colour = CssColour{1, 1, 1};
    const Mask left = decodeMask(labels.encoded(), one);
    EXPECT_EQ(left.at(15, 14), 65535);
    EXPECT_EQ(left.at(25, 14), 0);
    EXPECT_EQ(left.at(1, 1), 0);
}

TEST(MaskLevels, OneLevelIsAllLiquidOrAllDry)
{
    for (const double level : {0.0, 0.3, 0.499, 0.501, 0.7, 1.0}) {
        for (const int side : {1, 2, 9}) {
            const Mask mask = decodeMask(Grey(side, side, [&](int, int) { return level; }).encoded());
            EXPECT_THAT(mask.coverage, Each(level > 0.5 ? 65535 : 0)) << level;
            EXPECT_EQ(mask.coverage.size(), static_cast<std::size_t>(side * side));
            EXPECT_FALSE(mask.inverted);
        }
    }
}

TEST(MaskLevels, StrokesOfOnePixelAndCheckerboardsStayWhole)
{
    const Grey column(5, 1, [](int x, int) { return x == 2 ? 1.0 : 0.0; });
    EXPECT_THAT(decodeMask(column.encoded()).coverage, ElementsAre(0, 0, 65535, 0, 0));
    const Grey row(1, 5, [](int, int y) { return y == 4 ? 1.0 : 0.0; });
    EXPECT_THAT(decodeMask(row.encoded()).coverage, ElementsAre(0, 0, 0, 0, 65535));
    const Grey board(9, 9, [](int x, int y) { return (x + y) % 2; });
    EXPECT_EQ(decodeMask(board.encoded()).coverage, board.levels);
}

TEST(MaskAlpha, TransparentLogoIsReadByItsAlpha)
{
    const Mask mask = decodeMask(greyAlpha(4, 2, {0x00ff, 0x4000, 0x7fff, 0xff00, 0x00ff, 0x80ff, 0xff00, 0x0000}));
    EXPECT_EQ(mask.channel, Channel::Alpha);
    EXPECT_FALSE(mask.inverted);
    EXPECT_THAT(mask.coverage, ElementsAre(0, 0x40 * 257, 0x7f * 257, 65535, 0, 0x80 * 257, 65535, 0));
}

TEST(MaskAlpha, HalfTransparentLogoIsStretched)
{
    const Mask mask = decodeMask(greyAlpha(3, 1, {0x0000, 0x3200, 0x6400}));
    EXPECT_THAT(mask.coverage, ElementsAre(0, 32768, 65535));
    EXPECT_NEAR(mask.level_liquid, 100 / 255.0, 1e-12);
}

TEST(MaskAlpha, NearlyInvisibleLogoIsNotStretched)
{
    const Mask mask = decodeMask(greyAlpha(3, 1, {0x0000, 0x1e00, 0x3200}));
    EXPECT_THAT(mask.coverage, ElementsAre(0, 0x1e * 257, 0x32 * 257));
    EXPECT_EQ(mask.level_liquid, 1.0);
}

TEST(MaskAlpha, HigherOfTwoLevelsIsLiquid)
{
    EXPECT_THAT(decodeMask(greyAlpha(3, 1, {0x0000, 0x0100, 0x0000})).coverage, ElementsAre(0, 65535, 0));
}

TEST(MaskAlpha, OpaqueImageIsReadByItsLuma)
{
    const Mask mask =
        decodeMask(greyAlpha(3, 3, {0xffff, 0xffff, 0xffff, 0xffff, 0xff00, 0xffff, 0xffff, 0xffff, 0xffff}));
    EXPECT_EQ(mask.channel, Channel::Luma);
    EXPECT_TRUE(mask.inverted);
    EXPECT_EQ(mask.at(1, 1), 65535);
    EXPECT_EQ(mask.at(0, 1), 0);
}

TEST(MaskAlpha, HalfOpaqueDoesNotCountAsTransparent)
{
    const auto channel_of = [](unsigned alpha) {
        return decodeMask(greyAlpha(2, 1, {0xff00, alpha << 8 | 0xff})).channel;
    };
    EXPECT_EQ(channel_of(128), Channel::Luma);
    EXPECT_EQ(channel_of(127), Channel::Alpha);
}

TEST(MaskAlpha, RequestedAlphaIsAbsolute)
{
    MaskOptions options;
    options.channel = Channel::Alpha;
    const Mask mask = decodeMask(greyAlpha(3, 1, {0x00ff, 0x3200, 0x6400}), options);
    EXPECT_THAT(mask.coverage, ElementsAre(0, 0x32 * 257, 0x64 * 257));
    options.invert = true;
    const Mask inverted = decodeMask(greyAlpha(3, 1, {0x00ff, 0x3200, 0x6400}), options);
    EXPECT_THAT(inverted.coverage, ElementsAre(65535, 65535 - 0x32 * 257, 65535 - 0x64 * 257));
    EXPECT_TRUE(inverted.inverted) << "transparent pixels are the liquid";
}

TEST(MaskAlpha, RequestedButMissingAlphaIsAnError)
{
    MaskOptions options;
    options.channel = Channel::Alpha;
    const Bytes grey = Grey(2, 2, [](int x, int) { return x; }).encoded();
    try {
        decodeMask(grey, options);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_THAT(error.what(), HasSubstr("alpha"));
    }
}

TEST(MaskAlpha, RequestedLumaIsThatInFrontOfBlack)
{
    MaskOptions options;
    options.channel = Channel::Luma;
    const Mask mask = decodeMask(greyAlpha(4, 1, {0x00ff, 0xff64, 0x80ff, 0x8064}), options);
    EXPECT_THAT(mask.coverage, ElementsAre(0, 0x64 * 257, 0x80 * 257, std::lround(0x64 * 257.0 * 0x80 * 257 / 65535)));
}

TEST(Mask, GivenLevelsReplaceItsOwn)
{
    const Grey ring(40, 40, [](int x, int y) { return std::hypot(x - 20, y - 20) < 12 ? 0.2 : 0.9; });
    const Mask own = decodeMask(ring.encoded());
    ASSERT_TRUE(own.found);
    EXPECT_EQ(own.found->channel, Channel::Luma);
    EXPECT_NEAR(own.found->dry, 0.9, 1e-4);
    EXPECT_NEAR(own.found->liquid, 0.2, 1e-4);
    MaskOptions options;
    options.levels = own.found;
    EXPECT_EQ(decodeMask(ring.encoded(), options).coverage, own.coverage);
    // This mark covers the border, so the image itself suggests the opposite.
    const Grey grown(40, 40, [](int x, int y) { return std::hypot(x - 20, y - 20) < 26 ? 0.2 : 0.9; });
    const Mask alone = decodeMask(grown.encoded());
    EXPECT_EQ(alone.at(20, 20), 0);
    const Mask alike = decodeMask(grown.encoded(), options);
    EXPECT_EQ(alike.at(20, 20), 65535);
    EXPECT_EQ(alike.at(0, 0), 0);
    EXPECT_TRUE(alike.inverted);
    EXPECT_LT(alike.found->dry, alike.found->liquid) << "its own levels are still reported";
    // An image of one level has no levels of its own, but this level is one of the given two.
    const Grey dark(40, 40, [](int, int) { return 0.2; });
    EXPECT_FALSE(decodeMask(dark.encoded()).found);
    EXPECT_THAT(decodeMask(dark.encoded(), options).coverage, Each(65535));
    options.invert = true;
    EXPECT_THAT(decodeMask(dark.encoded(), options).coverage, Each(0));
    // An image without alpha is opaque.
    options = {};
    options.levels = MaskLevels{Channel::Alpha, 0.0, 1.0};
    EXPECT_THAT(decodeMask(dark.encoded(), options).coverage, Each(65535));
    options.levels->liquid = 0.0;
    EXPECT_THROW(decodeMask(dark.encoded(), options), Error);
    options.levels = MaskLevels{Channel::Luma, 0.0, 1.0};
    options.channel = Channel::Luma;
    EXPECT_THROW(decodeMask(dark.encoded(), options), Error);
}

}  // namespace
}  // namespace droplet
