// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of footprints by colour, and of the notation of colours.
#include "droplet/image/css_colour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "image/encoded_images.h"

namespace droplet {
namespace {

using namespace encoded;
using testing::AllOf;
using testing::HasSubstr;

TEST(CssColour, IsReadByNameAndNumber)
{
    EXPECT_EQ(parseCssColour("red"), (CssColour{255, 0, 0}));
    EXPECT_EQ(parseCssColour("RebeccaPurple"), (CssColour{0x66, 0x33, 0x99}));
    EXPECT_EQ(parseCssColour("#E30613"), (CssColour{0xe3, 0x06, 0x13}));
    EXPECT_EQ(parseCssColour("#0af"), (CssColour{0x00, 0xaa, 0xff}));
    EXPECT_EQ(text(parseCssColour("#0af")), "#00aaff");
    for (const char* wrong : {"", "#", "#12", "#12345", "#1234567", "#ggg", "# 12", "#+12345", "reddish", "255,0,0"}) {
        EXPECT_THROW(parseCssColour(wrong), Error) << wrong;
    }
}

MaskOptions of(const char* colour)
{
    MaskOptions options;
    options.colour = parseCssColour(colour);
    options.vector_long_side = 200;
    return options;
}

double covered(const Mask& mask)
{
    return std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0) / 65535.0;
}

/// SVG of 200 × 200 px: a red disc of radius 90 with a white bar of 120.6 × 32.6 in it.
std::string icon(const std::string& background = "")
{
    return R"(<svg xmlns="http://www.w3.org/2000/svg" width="200" height="200">)" + background +
           R"(<circle cx="100" cy="100" r="90" fill="#e30613"/>)"
           R"(<rect x="39.7" y="84.2" width="120.6" height="32.6" fill="white"/></svg>)";
}

TEST(FootprintColour, FindsASignInsideAnIconAndTheIconAroundIt)
{
    constexpr double kBar = 120.6 * 32.6;
    constexpr double kDisc = std::numbers::pi * 90 * 90 - kBar;
    const Mask sign = decodeMask(bytesOf(icon()), of("white"));
    EXPECT_NEAR(covered(sign), kBar, 0.005 * kBar);
    EXPECT_EQ(sign.segment, Segmentation::Colour);
    EXPECT_EQ(sign.at(100, 100), 65535);
    EXPECT_EQ(sign.at(100, 40), 0);
    EXPECT_NEAR(covered(decodeMask(bytesOf(icon()), of("#e30613"))), kDisc, 0.002 * kDisc);
    EXPECT_NEAR(covered(decodeMask(bytesOf(icon()), of("red"))), kDisc, 0.002 * kDisc) << "a similar colour";
    const std::string on_blue = icon("<rect width='200' height='200' fill='#0044aa'/>");
    EXPECT_NEAR(covered(decodeMask(bytesOf(on_blue), of("red"))), kDisc, 0.003 * kDisc) << "on any ground";
}

TEST(FootprintColour, CoverageAtEdgesIsTheShareOfTheColour)
{
    // Columns of red, two mixtures with yellow, yellow, and black, which is not a mixture.
    Raster raster{9, 9, 3, 8, {}};
    for (int y = 0; y < 9; ++y) {
        for (const double share : {1.0, 1.0, 1.0, 0.75, 0.25, 0.0, 0.0, 0.0}) {
            raster.samples.insert(raster.samples.end(), {220, static_cast<unsigned>(200 * (1.0 - share)), 20});
        }
        raster.samples.insert(raster.samples.end(), {0, 0, 0});
    }
    const Mask mask = decodeMask(encodePng(raster, {PNG_COLOR_TYPE_RGB, false, {}, {}, nullptr}), of("#dc0014"));
    EXPECT_EQ(mask.at(1, 4), 65535);
    EXPECT_NEAR(mask.at(3, 4) / 65535.0, 0.75, 0.01);
    EXPECT_NEAR(mask.at(4, 4) / 65535.0, 0.25, 0.01);
    EXPECT_EQ(mask.at(6, 4), 0);
    EXPECT_EQ(mask.at(8, 4), 0);
}

TEST(FootprintColour, OutlineOfAnotherColourIsDry)
{
    // Red, a column of black, white: black is not a mixture of red and white.
    Raster raster{9, 5, 3, 8, {}};
    for (int i = 0; i < 45; ++i) {
        const int x = i % 9;
        raster.samples.insert(raster.samples.end(), {x == 4  ? 0U
                                                     : x < 4 ? 230U
                                                             : 255U,
                                                     x < 5 ? 0U : 255U, x < 5 ? 0U : 255U});
    }
    const Mask mask = decodeMask(encodePng(raster, {PNG_COLOR_TYPE_RGB, false, {}, {}, nullptr}), of("red"));
    EXPECT_EQ(mask.at(3, 2), 65535);
    EXPECT_EQ(mask.at(4, 2), 0);
}

TEST(FootprintColour, MissingColourIsAnErrorThatListsTheCommonOnes)
{
    EXPECT_THAT(messageOf(bytesOf(icon()), of("lime")),
                AllOf(HasSubstr("#00ff00"), HasSubstr("#e306"), HasSubstr("#ffffff")));
}

TEST(FootprintColour, MissingColourMayGiveADryFrame)
{
    MaskOptions options = of("lime");
    options.allow_dry = true;
    EXPECT_EQ(covered(decodeMask(bytesOf(icon()), options)), 0.0);
}

TEST(FootprintColour, InversionComesLast)
{
    MaskOptions options = of("white");
    const Mask sign = decodeMask(bytesOf(icon()), options);
    options.invert = true;
    const Mask rest = decodeMask(bytesOf(icon()), options);
    EXPECT_NEAR(covered(sign) + covered(rest), 200.0 * 200.0, 1e-6);
}

}  // namespace
}  // namespace droplet
