// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/drawing/drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/error.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr Colour kBlack{0, 0, 0};

std::string svgOf(const Drawing& drawing)
{
    std::ostringstream out;
    writeSvg(drawing, out);
    return out.str();
}

/// Darkness of a pixel, from 0 to 1.
double inkAt(const Picture& picture, int x, int y)
{
    const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
    return 1.0 - picture.rgb[3 * at] / 255.0;
}

double inkOf(const Picture& picture)
{
    double ink = 0.0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            ink += inkAt(picture, x, y);
        }
    }
    return ink;
}

TEST(Drawing, AreaCoversEveryPixelByItsShare)
{
    const Drawing drawing{8.0, 8.0, {Area{{{2.5, 3.0}, {5.25, 3.0}, {5.25, 5.5}, {2.5, 5.5}}, kBlack, 1.0}}};
    const Picture picture = pictureOf(drawing, 1.0);
    EXPECT_NEAR(inkAt(picture, 2, 3), 0.5, 0.003);
    EXPECT_NEAR(inkAt(picture, 3, 3), 1.0, 0.003);
    EXPECT_NEAR(inkAt(picture, 5, 4), 0.25, 0.003);
    EXPECT_NEAR(inkAt(picture, 2, 5), 0.25, 0.003);
    EXPECT_EQ(inkAt(picture, 1, 4), 0.0);
    EXPECT_EQ(inkAt(picture, 4, 2), 0.0);
    EXPECT_EQ(inkAt(picture, 4, 6), 0.0);
}

TEST(Drawing, InkIsTheAreaAtAnyScale)
{
    constexpr double kOpacity = 0.6;  // 153 of 255 levels, which a pixel holds exactly
    const Drawing triangle{40.0, 30.0, {Area{{{3.3, 4.1}, {36.2, 9.7}, {11.8, 27.4}}, kBlack, kOpacity}}};
    const double area = 0.5 * cross(Vec2{36.2, 9.7} - Vec2{3.3, 4.1}, Vec2{11.8, 27.4} - Vec2{3.3, 4.1});
    for (const double scale : {1.0, 1.7, 3.0}) {
        EXPECT_NEAR(inkOf(pictureOf(triangle, scale)) / (kOpacity * area * scale * scale), 1.0, 5e-3) << scale;
    }
}

// A stroke of width w and length l with round ends has ink w l + π w²/4.
TEST(Drawing, LineHasItsWidth)
{
    for (const double width : {1.0, 2.2, 5.0}) {
        const Drawing drawing{80.0, 60.0, {Line{{{10.3, 12.1}, {66.7, 47.9}}, kBlack, width, 0.0}}};
        const double expected = width * std::hypot(56.4, 35.8) + 0.25 * 3.14159265 * width * width;
        EXPECT_NEAR(inkOf(pictureOf(drawing, 1.0)) / expected, 1.0, 0.02) << width;
    }
    const Drawing hair{80.0, 60.0, {Line{{{10.5, 20.5}, {70.5, 20.5}}, kBlack, 0.25, 0.0}}};
    EXPECT_NEAR(inkOf(pictureOf(hair, 1.0)) / (0.25 * 60.0), 1.0, 0.05);
}

TEST(Drawing, DashesAreHalfOfTheLineHoweverItBends)
{
    const std::vector<Vec2> bent{{5.0, 5.0}, {45.0, 5.0}, {45.0, 45.0}, {5.0, 45.0}};
    const Drawing whole{50.0, 50.0, {Line{bent, kBlack, 3.0, 0.0}}};
    const Drawing dashed{50.0, 50.0, {Line{bent, kBlack, 3.0, 6.0}}};
    // There are ten dashes of length 6, each with round ends.
    EXPECT_NEAR(inkOf(pictureOf(dashed, 1.0)) / (10 * (18.0 + 2.25 * 3.14159265)), 1.0, 0.03);
    EXPECT_NEAR(inkOf(pictureOf(whole, 1.0)) / (3.0 * 120.0 + 2.25 * 3.14159265), 1.0, 0.03);
    EXPECT_THAT(svgOf(dashed), HasSubstr("stroke-dasharray=\"6\""));
    EXPECT_THAT(svgOf(whole), Not(HasSubstr("dasharray")));
}

TEST(Drawing, ClipsMarksToThePage)
{
    const Drawing drawing{
        20.0,
        20.0,
        {Area{{{-50.0, -50.0}, {70.0, -50.0}, {70.0, 70.0}, {-50.0, 70.0}}, kBlack, 1.0},
         Line{{{-1e4, 5.0}, {1e4, 5.0}}, kBlack, 3.0, 0.0}, Text{"far away", {1000.0, -1000.0}, 9.0, kBlack}}};
    EXPECT_NEAR(inkOf(pictureOf(drawing, 1.0)), 400.0, 1e-9);
}

TEST(Drawing, PlacesTextByItsAnchor)
{
    const auto columns = [](Anchor anchor) {
        const Picture picture = pictureOf({200.0, 40.0, {Text{"m/s² −4", {100.0, 30.0}, 12.0, kBlack, anchor}}}, 1.0);
        int first = picture.width;
        int last = -1;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                if (inkAt(picture, x, y) > 0.0) {
                    first = std::min(first, x);
                    last = std::max(last, x);
                }
            }
        }
        return std::pair(first, last);
    };
    const auto [start_first, start_last] = columns(Anchor::Start);
    const auto [middle_first, middle_last] = columns(Anchor::Middle);
    const auto [end_first, end_last] = columns(Anchor::End);
    EXPECT_NEAR(start_first, 99, 2);
    EXPECT_NEAR(end_last, 100, 2);
    EXPECT_NEAR(middle_first + middle_last, 200, 3);
    EXPECT_EQ(start_last - start_first, end_last - end_first);
}

TEST(Drawing, EscapesSpecialCharactersInSvg)
{
    const std::string svg = svgOf({10.0, 10.0, {Text{"a<b & c>d", {1.0, 1.0}}}});
    EXPECT_THAT(svg, HasSubstr(">a&lt;b &amp; c&gt;d</text>"));
}

// An independent renderer draws the SVG as pictureOf draws the drawing.
TEST(Drawing, SvgEqualsThePicture)
{
    const Drawing drawing{128.0,
                          96.0,
                          {Area{{{10.0, 10.0}, {100.5, 20.25}, {60.0, 80.0}}, {200, 40, 90}, 0.4},
                           Area{{{30.0, 5.0}, {80.0, 5.0}, {80.0, 60.0}, {30.0, 60.0}}, {20, 90, 200}, 1.0},
                           Line{{{5.0, 70.0}, {50.0, 15.0}, {115.0, 75.0}}, {10, 120, 40}, 2.2, 0.0},
                           Line{{{60.0, 2.0}, {60.0, 88.0}}, kBlack, 1.3, 5.0}}};
    const std::string svg = svgOf(drawing);
    const Picture theirs = decodePicture(std::as_bytes(std::span(svg.data(), svg.size())));
    ASSERT_EQ(theirs.width % 128, 0);
    const Picture ours = pictureOf(drawing, theirs.width / 128.0);
    ASSERT_EQ(ours.height, theirs.height);
    double difference = 0.0;
    for (std::size_t i = 0; i < ours.rgb.size(); ++i) {
        difference += std::abs(ours.rgb[i] - theirs.rgb[i]);
    }
    EXPECT_LT(difference / static_cast<double>(ours.rgb.size()), 0.5) << "levels of 255 on average";
}

TEST(Drawing, PlacesDrawingsSideBySide)
{
    const Drawing a{10.0, 8.0, {Area{{{0.0, 0.0}, {10.0, 0.0}, {10.0, 8.0}, {0.0, 8.0}}, kBlack, 1.0}}};
    const Drawing b{6.0, 12.0, {}};
    const Drawing all = beside({b, a, b});
    EXPECT_EQ(all.width, 22.0);
    EXPECT_EQ(all.height, 12.0);
    const Picture picture = pictureOf(all, 1.0);
    EXPECT_EQ(inkAt(picture, 5, 4), 0.0);
    EXPECT_EQ(inkAt(picture, 6, 0), 1.0);
    EXPECT_EQ(inkAt(picture, 15, 7), 1.0);
    EXPECT_EQ(inkAt(picture, 16, 7), 0.0);
    EXPECT_NEAR(inkOf(picture), 80.0, 1e-9);
}

TEST(Drawing, RefusesEmptyAndTooLargePictures)
{
    EXPECT_THROW(pictureOf({0.0, 10.0, {}}, 1.0), Error);
    EXPECT_THROW(pictureOf({1e5, 1e5, {}}, 1.0), Error);
    EXPECT_THROW(pictureOf({std::nan(""), 10.0, {}}, 1.0), Error);
}

}  // namespace
}  // namespace droplet
