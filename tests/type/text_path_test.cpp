// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of drawings, and text that follows them.
#include "droplet/type/text_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/type/colour_glyph.h"
#include "droplet/type/glyph.h"
#include "droplet/units.h"
#include "support/fonts.h"
#include "support/hostile_drawings.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using testing::kSans;

constexpr double kPixel = 25.4e-3 / 96.0;

TextPath pathIn(const std::string& svg, std::optional<double> page_width = {})
{
    return decodeTextPath(std::as_bytes(std::span(svg)), page_width);
}

/// Drawing on a page of 100 mm × 50 mm, in mm.
std::string page(const std::string& content)
{
    return R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" )"
           R"(width="100mm" height="50mm" viewBox="0 0 100 50">)" +
           content + "</svg>";
}

/// Path data in mm.
TextPath pathOf(const std::string& data)
{
    return pathIn(page("<path d=\"" + data + "\"/>"));
}

double lengthOf(const std::vector<Vec2>& points)
{
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        sum += length(points[i + 1] - points[i]);
    }
    return sum;
}

void expectPoint(Vec2 p, double x_mm, double y_mm, double tolerance = 1e-12)
{
    EXPECT_NEAR(p.x, x_mm * kMillimetre, tolerance);
    EXPECT_NEAR(p.y, y_mm * kMillimetre, tolerance);
}

TEST(TextPath, HasTheLengthsOfTheDrawing)
{
    const TextPath line = pathOf("M10,20 H60 v10");
    ASSERT_EQ(line.points.size(), 3U);
    expectPoint(line.points[0], 10, -20);
    expectPoint(line.points[1], 60, -20);
    expectPoint(line.points[2], 60, -30);
    EXPECT_EQ(line.others, 0U);
    const auto end = [](const std::string& attributes, std::optional<double> width = {}) {
        return pathIn("<svg xmlns='http://www.w3.org/2000/svg' " + attributes + "><path d='M0,0H10'/></svg>", width)
            .points.back()
            .x;
    };
    EXPECT_NEAR(end(""), 10 * kPixel, 1e-15) << "px";
    EXPECT_NEAR(end("viewBox='0 0 20 20'"), 10 * kPixel, 1e-15);
    EXPECT_NEAR(end("width='40' height='40' viewBox='0 0 20 20'"), 20 * kPixel, 1e-15);
    EXPECT_NEAR(end("width='100%' viewBox='0 0 20 20'"), 10 * kPixel, 1e-15);
    EXPECT_NEAR(end("width='72pt' height='72pt' viewBox='0 0 20 20'"), 12.7e-3, 1e-12) << "half an inch";
    EXPECT_NEAR(end("width='40mm' height='20mm' viewBox='0 0 20 20'"), 10e-3, 1e-12) << "fitted into the page";
    EXPECT_NEAR(end("viewBox='0 0 20 20'", 0.1), 50e-3, 1e-12) << "page width";
    EXPECT_NEAR(end("height='10mm' viewBox='0 0 20 20'", 0.1), 50e-3, 1e-12);
    EXPECT_NEAR(end("", 0.1), 0.1, 1e-12) << "the page is as wide as its line";
    EXPECT_THROW(end("", 0.0), Error);
}

TEST(TextPath, ReadsAllCommands)
{
    // Each draws the same two lines, or half circles of radius 10 about (20, 20).
    for (const char* data : {"M10 20L20 10 30 20", "m10,20 10-10 10,10", "M10 20l1e1-10,10,+10",
                             "M10,20L20,10L30,20M1,1", "M10 20 20 10L30 20L"}) {
        const TextPath line = pathOf(data);
        ASSERT_EQ(line.points.size(), 3U) << data;
        expectPoint(line.points[1], 20, -10);
        expectPoint(line.points[2], 30, -20);
    }
    for (const char* data : {"M10 20A10 10 0 0 1 30 20", "M10 20a10,10,0,0130,20", "M10 20a10 10 0 0 1 20 0",
                             "M10 20a10 10 45 1 1 20 0", "M10 20A5 5 0 0 1 30 20"}) {
        const TextPath line = pathOf(data);
        if (std::string(data).find("0130") != std::string::npos) {
            expectPoint(line.points.back(), 40, -40);  // flags need no separators
            continue;
        }
        expectPoint(line.points.back(), 30, -20);
        EXPECT_NEAR(lengthOf(line.points), std::numbers::pi * 10e-3, 1e-7) << data;
        for (const Vec2 p : line.points) {
            EXPECT_NEAR(length(p - Vec2{20e-3, -20e-3}), 10e-3, 1e-7);
            EXPECT_GE(p.y, -20e-3 - 1e-12) << "over the top";
        }
    }
    EXPECT_NEAR(lengthOf(pathOf("M30 20a10 10 0 1 0-10 10").points), 1.5 * std::numbers::pi * 10e-3, 1e-7);
    // Curves: smooth ones reflect the last control point; a parabola's arc is known.
    const double parabola = 10e-3 * (std::sqrt(2.0) + std::asinh(1.0));  // y = x² / 20 … from -10 to 10
    EXPECT_NEAR(lengthOf(pathOf("M10 20Q20 10 30 20").points), parabola, 1e-7);
    EXPECT_NEAR(lengthOf(pathOf("M10 20q10-10 20 0t20 0").points), 2 * parabola, 1e-7);
    expectPoint(pathOf("M10 20q10-10 20 0t20 0").points.back(), 50, -20);
    EXPECT_EQ(pathOf("M0 0C0 10 10 10 10 0S20-10 20 0").points, pathOf("M0 0c0 10 10 10 10 0c0-10 10-10 10 0").points);
    EXPECT_EQ(pathOf("M10 10h20v20h-20z").points, pathOf("M10 10H30V30H10V10").points);
    EXPECT_EQ(pathOf("M10 10h20v20h-20zl1 1").points.size(), 5U) << "z ends a part";
    EXPECT_EQ(pathOf("M10 10h20 # v20").points.size(), 2U) << "up to the error";
}

TEST(TextPath, ReadsShapesAndTransformations)
{
    const auto points = [](const std::string& content) { return pathIn(page(content)).points; };
    EXPECT_EQ(points("<line x1='10' y1='10' x2='30' y2='30'/>"), pathOf("M10,10 30,30").points);
    EXPECT_EQ(points("<polyline points='10,10 30,30 30,40'/>"), pathOf("M10,10 30,30 30,40").points);
    EXPECT_EQ(points("<polygon points='10,10 30,30 30,40'/>"), pathOf("M10,10 30,30 30,40z").points);
    EXPECT_NEAR(lengthOf(points("<rect x='10' y='10' width='30' height='20'/>")), 100e-3, 1e-12);
    EXPECT_NEAR(lengthOf(points("<rect width='30' height='20' rx='5'/>")), (60 + 10 * std::numbers::pi) * 1e-3, 1e-7);
    const auto circle = points("<circle cx='50' cy='25' r='20'/>");
    EXPECT_NEAR(lengthOf(circle), 40e-3 * std::numbers::pi, 1e-6);
    EXPECT_EQ(circle.front(), circle.back());
    expectPoint(circle.front(), 70, -25);
    EXPECT_LT(circle[5].y, circle[0].y) << "clockwise";
    EXPECT_NEAR(lengthOf(points("<ellipse rx='20' ry='10'/>")), 96.8844822e-3, 1e-6);
    const auto moved = points(
        "<g transform='translate(5,5)'><g style='transform:scale(2)'>"
        "<path transform='rotate(90)' d='M0,0H10'/></g></g>");
    expectPoint(moved[0], 5, -5);
    expectPoint(moved[1], 5, -25);
}

TEST(TextPath, IsThatOfATextOrTheLongest)
{
    const std::string paths = "<path id='a' d='M0,0H10'/><path id='b' d='M0,0H30M0,10H20'/>";
    const TextPath longest = pathIn(page(paths));
    EXPECT_NEAR(lengthOf(longest.points), 30e-3, 1e-12);
    EXPECT_EQ(longest.others, 2U);
    const auto unseen = [&](const std::string& content) {
        const TextPath path = pathIn(page(paths + content));
        EXPECT_NEAR(lengthOf(path.points), 30e-3, 1e-12) << content;
        EXPECT_EQ(path.others, 2U);
    };
    unseen("<defs><path d='M0,0H90'/></defs>");
    unseen("<clipPath><rect width='90' height='90'/></clipPath>");
    unseen("<g style='display:none'><path d='M0,0H90'/></g>");
    unseen("<style>.x{display:none}</style><path class='x' d='M0,0H90'/>");
    unseen("<path xmlns='http://example.org/editor' d='M0,0H90'/>");
    unseen("<path d='M0,0'/><path/><circle/>");
    const TextPath named = pathIn(page(paths + "<text><textPath href='#a'>x</textPath></text>"));
    EXPECT_NEAR(lengthOf(named.points), 10e-3, 1e-12);
    EXPECT_EQ(named.others, 0U);
    EXPECT_NEAR(
        lengthOf(
            pathIn(page("<defs><path id='c' d='M0,0H90'/></defs><text><textPath xlink:href=' #c '/></text>")).points),
        90e-3, 1e-12);
    EXPECT_NEAR(lengthOf(pathIn(page(paths + "<text><textPath href='#none'/></text>")).points), 30e-3, 1e-12);
}

TEST(TextPath, ReadsFilesOfDrawingPrograms)
{
    // Illustrator declares entities for its namespaces, and has its pages in px of 1/72 inch.
    const std::string illustrator =
        R"(<?xml version="1.0" encoding="utf-8"?>)"
        R"(<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd" [)"
        R"(<!ENTITY ns_svg "http://www.w3.org/2000/svg"><!ENTITY ns_xlink "http://www.w3.org/1999/xlink">]>)"
        R"(<svg version="1.1" xmlns="&ns_svg;" xmlns:xlink="&ns_xlink;" x="0px" y="0px" width="566.929px" )"
        R"(height="283.465px" viewBox="0 0 566.929 283.465"><rect fill="none" width="566.929" height="283.465"/>)"
        R"(<defs><path id="SVGID_1_" d="M0,10h283.4645"/></defs>)"
        R"(<text><textPath xlink:href="#SVGID_1_" startOffset="0%"><tspan>x</tspan></textPath></text></svg>)";
    EXPECT_NEAR(lengthOf(pathIn(illustrator).points), 75e-3, 1e-7);
    EXPECT_NEAR(lengthOf(pathIn(illustrator, 0.2).points), 100e-3, 1e-7);
    // Inkscape has pages in mm, layers that are moved, and elements of its own.
    const TextPath inkscape = pathIn(
        R"(<svg width="210mm" height="297mm" viewBox="0 0 210 297" xmlns="http://www.w3.org/2000/svg" )"
        R"(xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" )"
        R"(xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd">)"
        R"(<sodipodi:namedview><inkscape:grid/></sodipodi:namedview><defs><inkscape:path-effect effect="bspline"/></defs>)"
        R"svg(<g inkscape:groupmode="layer" transform="translate(-10,5)">)svg"
        R"(<path style="fill:none;stroke:#000000" d="m 20,60 h 100" sodipodi:nodetypes="cc"/></g></svg>)");
    expectPoint(inkscape.points.at(0), 10, -65);
    expectPoint(inkscape.points.at(1), 110, -65);
    EXPECT_EQ(inkscape.others, 0U);
}

TEST(TextPath, RefusesOtherFiles)
{
    const auto refused = [](const std::string& svg, const char* words) {
        try {
            pathIn(svg);
            ADD_FAILURE() << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    };
    refused("", "is not an SVG drawing");
    refused("P2 1 1 255 0", "is not an SVG drawing");
    refused(page(""), "no path that text could follow");
    refused(page("<path d='M5,5 5,5z'/>"), "no path that text could follow");
    refused(page("<path d='10,10 20,20'/><path d='Mx'/><path d='MInfinity,0 0,0'/>"), "no path that text could follow");
    refused(page("<path d='M0,0H1e300L1e300,1e300' transform='scale(1e300)'/>"), "no path");
    refused(page("<path d='M0,0H1e300'/><g>"), "SVG image");
    EXPECT_THROW((void)readTextPath("none.svg"), Error);
}

TEST(TextPath, HostileDrawingsDoNoHarm)
{
    std::vector<testing::HostileDrawing> drawings = testing::hostileDrawings();
    // One takes all of the ten seconds that a drawing has.
    std::erase_if(drawings, [](const testing::HostileDrawing& drawing) { return drawing.name == "many_rules"; });
    drawings.push_back({"many parts", [] { return page("<path d='" + testing::repeated(300'000, "M1,1h1") + "'/>"); }});
    drawings.push_back(
        {"arcs", [] { return page("<path d='M0,0" + testing::repeated(50'000, "a1e9,1e-9 7 1 1 1,1") + "'/>"); }});
    drawings.push_back({"groups", [] {
                            return page(testing::repeated(200, "<g transform='scale(1e9)'>") + "<path d='M0,0h1'/>" +
                                        testing::repeated(200, "</g>"));
                        }});
    for (const testing::HostileDrawing& hostile : drawings) {
        SCOPED_TRACE(hostile.name);
        try {
            const TextPath path = pathIn(hostile.text());
            EXPECT_TRUE(std::isfinite(lengthOf(path.points)));
            EXPECT_GT(lengthOf(path.points), 0.0);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
        }
    }
}

// Text along lines.

TextOptions inEms()
{
    TextOptions options;
    options.glyph.em = 1.0;
    return options;
}

/// Same loops, up to a displacement.
void expectSameLoops(const Outline& a, const Outline& b, double tolerance)
{
    ASSERT_EQ(a.loops.size(), b.loops.size());
    EXPECT_NEAR(a.extent.x, b.extent.x, tolerance);
    EXPECT_NEAR(a.extent.y, b.extent.y, tolerance);
    double farthest = 0.0;
    for (std::size_t k = 0; k < a.loops.size(); ++k) {
        ASSERT_EQ(a.loops[k].points.size(), b.loops[k].points.size());
        for (std::size_t i = 0; i < a.loops[k].points.size(); ++i) {
            farthest = std::max(farthest, length(a.loops[k].points[i] - b.loops[k].points[i]));
        }
    }
    EXPECT_LE(farthest, tolerance);
}

/// Middles of the boxes of all bars of l, from left to right.
std::vector<Vec2> barsOf(const Outline& outline)
{
    std::vector<Vec2> middles;
    for (const Loop& loop : outline.loops) {
        Vec2 sum;
        // Corners of the bar; its sides are divided evenly.
        std::size_t count = 0;
        for (std::size_t i = 0; i < loop.points.size(); ++i) {
            if (loop.corner[i] != 0) {
                sum = sum + loop.points[i];
                ++count;
            }
        }
        middles.push_back((1.0 / static_cast<double>(count)) * sum);
    }
    std::sort(middles.begin(), middles.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
    return middles;
}

/// Circle from its bottom on, clockwise.
std::vector<Vec2> circlePoints(double radius, std::size_t count)
{
    std::vector<Vec2> points;
    points.reserve(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        points.push_back({-radius * std::sin(angle), -radius * std::cos(angle)});
    }
    points.push_back(points.front());
    return points;
}

TEST(TextOnAPath, StraightIsAsWithoutAPath)
{
    const Font font = readFont(kSans);
    for (const TextAlign align : {TextAlign::Start, TextAlign::Centre, TextAlign::End}) {
        TextOptions options = inEms();
        options.align = align;
        options.line_sizes = {1.5, 1.0};
        options.tracking = 1.0 / 32.0;
        const char* const text = "Straight fi AV e\u0301\nאן Hug\nבب";
        const Outline without = layOutText(font, text, options).outline;
        // As wide as the text: lines from right to left start at its end.
        options.path = {{3.0, 7.0}, {3.5, 7.0}, {3.0 + without.extent.x, 7.0}};
        expectSameLoops(layOutText(font, text, options).outline, without, 0.0);
        // Turned as a whole.
        options.path = {{3.0, 7.0}, {3.0, 7.0 + without.extent.x}};
        const Outline upright = layOutText(font, text, options).outline;
        EXPECT_NEAR(upright.extent.x, without.extent.y, 1e-7);
        EXPECT_NEAR(upright.extent.y, without.extent.x, 1e-7);
    }
}

TEST(TextOnAPath, CircleIsAsAnArc)
{
    const Font font = readFont(kSans);
    for (const double radius : {6.0, -6.0}) {
        TextOptions arc = inEms();
        arc.align = TextAlign::Centre;
        arc.arc = radius;
        TextOptions path = arc;
        path.arc.reset();
        path.path = circlePoints(6.0, 2000);
        if (radius < 0.0) {  // from the top on, the other way round
            std::reverse(path.path.begin(), path.path.end());
            for (Vec2& p : path.path) {
                p = -1.0 * p;
            }
        }
        const char* const text = "Fresh Wáter\nof the x\u0301";
        expectSameLoops(layOutText(font, text, path).outline, layOutText(font, text, arc).outline, 1e-5);
    }
}

TEST(TextOnAPath, DrawnCircleIsAsAnArc)
{
    const Font font = readFont(kSans);
    TextOptions options;
    options.align = TextAlign::Centre;
    options.arc = 60e-3;
    const Outline arc = layOutText(font, "WATER\nround", options).outline;
    options.arc.reset();
    options.path = pathIn(R"(<svg xmlns="http://www.w3.org/2000/svg" width="200mm" viewBox="0 0 200 200">)"
                          R"(<path d="M100,160A60,60 0 0 1 100,40A60,60 0 0 1 100,160Z"/></svg>)")
                       .points;
    const Outline drawn = layOutText(font, "WATER\nround", options).outline;
    ASSERT_EQ(drawn.loops.size(), arc.loops.size());
    EXPECT_NEAR(drawn.extent.x, arc.extent.x, 1e-6);
    for (std::size_t k = 0; k < arc.loops.size(); ++k) {
        EXPECT_NEAR(signedArea(drawn.loops[k]), signedArea(arc.loops[k]), 1e-10);
        EXPECT_LT(length(drawn.loops[k].points[0] - arc.loops[k].points[0]), 1e-6);
    }
}

TEST(TextOnAPath, AdvancesAreLengthsOfTheLine)
{
    const Font font = readFont(kSans);
    TextOptions options = inEms();
    const std::string bars(20, 'l');
    const double advance = 569.0 / 2048.0;
    // Before a corner, letters are as far apart as on a straight line.
    options.path = {{0.0, 0.0}, {3.0, 0.0}, {3.0, -3.0}};
    const double height = 0.5 * 1556.0 / 2048.0;
    const double bearing = (193.0 + 377.0 - 569.0) / 2.0 / 2048.0;  // of the bar's middle
    std::vector<Vec2> along = barsOf(layOutText(font, bars, options).outline);
    ASSERT_EQ(along.size(), 20U);
    for (std::size_t i = 0; i + 1 < 10; ++i) {
        EXPECT_NEAR(along[i + 1].x - along[i].x, advance, 1e-6);
        EXPECT_NEAR(along[i + 1].y, along[i].y, 1e-6);
    }
    // On a curve, the middles' feet are as far apart along it as the advances.
    options.path = pathIn("<svg xmlns='http://www.w3.org/2000/svg'><path d='M0,0C4,-6 8,6 12,0'/></svg>").points;
    for (Vec2& p : options.path) {
        p = (1.0 / kPixel) * p;
    }
    const std::vector<Vec2> curve = options.path;
    const std::vector<Vec2> middles = barsOf(layOutText(font, bars, options).outline);
    ASSERT_EQ(middles.size(), 20U);
    std::vector<double> feet;
    Vec2 shift;
    double walked = 0.0;
    double wanted = 0.5 * advance;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const Vec2 piece = curve[i + 1] - curve[i];
        const Vec2 along_piece = (1.0 / length(piece)) * piece;
        while (walked + length(piece) >= wanted && feet.size() < middles.size()) {
            const Vec2 foot = curve[i] + (wanted - walked) * along_piece;
            const Vec2 middle = foot + bearing * along_piece + height * Vec2{-along_piece.y, along_piece.x};
            if (feet.empty()) {
                shift = middles[0] - middle;
            }
            feet.push_back(length(middle + shift - middles[feet.size()]));
            wanted += advance;
        }
        walked += length(piece);
    }
    ASSERT_EQ(feet.size(), 20U);
    EXPECT_LT(*std::max_element(feet.begin(), feet.end()), 1e-3);
}

TEST(TextOnAPath, FurtherLinesKeepTheirDistance)
{
    // On an arc to the right, a line further in has less room: its letters are as far apart as on the first line.
    const Font font = readFont(kSans);
    TextOptions options = inEms();
    options.align = TextAlign::Centre;
    options.path = circlePoints(8.0, 1000);
    const double pitch = 2384.0 / 2048.0;
    const Outline two = layOutText(font, "lll\nlll", options).outline;
    const std::vector<Vec2> bars = barsOf(two);
    ASSERT_EQ(bars.size(), 6U);
    const double advance = 569.0 / 2048.0;
    const double middle = 0.5 * 1556.0 / 2048.0;
    std::vector<Vec2> upper;
    std::vector<Vec2> lower;
    for (const Vec2 p : bars) {
        (p.y > 0.0 ? upper : lower).push_back(p);
    }
    ASSERT_EQ(upper.size(), 3U);
    // Chord at the middle of the bars, which stand on circles of radius 8 and 8 − pitch.
    const auto chord = [&](double radius) { return 2.0 * (radius + middle) * std::sin(0.5 * advance / radius); };
    EXPECT_NEAR(length(upper[1] - upper[0]), chord(8.0), 1e-5);
    EXPECT_NEAR(length(lower[1] - lower[0]), chord(8.0 - pitch), 1e-5);
    EXPECT_NEAR(length(upper[1] - lower[1]), pitch, 1e-5);
    // Outside of a corner, a further line goes round it on an arc: nothing falls into the gap.
    options.path = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}};
    options.align = TextAlign::Start;
    const TextLayout around = layOutText(font, "\n" + std::string(35, 'l'), options);
    EXPECT_EQ(around.outline.loops.size(), 35U) << "9.7 em on a line of 8 em, and a quarter of a circle";
    EXPECT_EQ(around.beyond, 0U);
    // A line on the inside of a circle that is too small has no place.
    options.path = circlePoints(1.0, 100);
    EXPECT_EQ(layOutText(font, "l\nl", options).beyond, 1U);
}

TEST(TextOnAPath, LettersBeyondItsEndsAreLeftOut)
{
    const Font font = readFont(kSans);
    TextOptions options = inEms();
    options.path = {{0.0, 0.0}, {1.0, 0.0}};  // the advance of l is 0.278
    const auto set = [&](const char* text, TextAlign align) {
        options.align = align;
        const TextLayout layout = layOutText(font, text, options);
        EXPECT_EQ(layout.outline.loops.size() + layout.beyond, 6U);
        return layout.beyond;
    };
    EXPECT_EQ(set("llllll", TextAlign::Start), 2U);
    EXPECT_EQ(set("llllll", TextAlign::End), 2U);
    EXPECT_EQ(set("llllll", TextAlign::Centre), 2U);
    options.align = TextAlign::Start;
    EXPECT_EQ(layOutText(font, "lll      ", options).beyond, 0U) << "spaces";
    options.path = {{0.0, 0.0}, {0.01, 0.0}};
    const TextLayout none = layOutText(font, "ll", options);
    EXPECT_EQ(none.beyond, 2U);
    EXPECT_TRUE(none.outline.loops.empty());
    EXPECT_EQ(layOutColours(font, "ll", options).beyond, 2U);
    options.path = {{0.0, 0.0}, {1.0, 0.0}};
    EXPECT_EQ(layOutText(font, "ן", options).beyond, 0U) << "from the right end on";
}

TEST(TextOnAPath, ShiftsAlongIt)
{
    const Font font = readFont(kSans);
    TextOptions options = inEms();
    options.path = {{0.0, 0.0}, {10.0, 0.0}};
    const auto middles = [&](const char* text) { return barsOf(layOutText(font, text, options).outline); };
    options.shift = 0.5;
    EXPECT_EQ(layOutText(font, "llll", options).beyond, 0U);
    options.align = TextAlign::Centre;
    EXPECT_EQ(layOutText(font, "llll", options).beyond, 2U) << "half of them";
    // Around a circle, by a quarter: from the top to the right.
    options.path.clear();
    options.arc = 5.0;
    options.shift = 0.0;
    const Outline top = layOutText(font, "lll", options).outline;
    options.shift = 0.25;
    const Outline right = layOutText(font, "lll", options).outline;
    EXPECT_NEAR(right.extent.y, top.extent.x, 1e-7);
    EXPECT_NEAR(right.extent.x, top.extent.y, 1e-7);
    for (const double turn : {1.0, -1.0}) {
        options.shift = turn;
        expectSameLoops(layOutText(font, "lll", options).outline, top, 1e-7);
    }
    options.shift = 0.5;  // across the seam at the bottom
    EXPECT_EQ(middles("lll").size(), 3U);
    EXPECT_EQ(layOutText(font, "lll", options).beyond, 0U);
    // A closed path takes no more text than without a shift.
    options.arc.reset();
    options.path = circlePoints(1.0, 100);
    options.align = TextAlign::Start;
    const std::size_t beyond = layOutText(font, std::string(30, 'l'), options).beyond;
    EXPECT_GT(beyond, 0U);
    options.shift = 0.0;
    EXPECT_EQ(layOutText(font, std::string(30, 'l'), options).beyond, beyond);
    options.shift = 1.5;
    EXPECT_THROW((void)layOutText(font, "l", options), Error);
}

TEST(TextOnAPath, MarksStayOnTheirLetter)
{
    // A letter with a mark turns as one piece: as its glyph does.
    const Font font = readFont(kSans);
    TextOptions options = inEms();
    options.align = TextAlign::Centre;
    const Outline straight = layOutText(font, "x\u0301", options).outline;
    options.arc = 1.0;
    const Outline turned = layOutText(font, "x\u0301", options).outline;
    ASSERT_EQ(turned.loops.size(), 2U);
    EXPECT_NEAR(turned.extent.x, straight.extent.x, 1e-7) << "alone at the top, it is not turned at all";
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_LT(length(turned.loops[k].points[0] - straight.loops[k].points[0]), 1e-7);
    }
}

TEST(TextOnAPath, OptionsAreChecked)
{
    const Font font = readFont(kSans);
    const auto refused = [&](std::vector<Vec2> path, const char* words) {
        TextOptions options;
        options.path = std::move(path);
        try {
            (void)layOutText(font, "a", options);
            ADD_FAILURE() << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    };
    refused({{0.0, 0.0}}, "path is 0, must be a line of finite length");
    refused({{1.0, 1.0}, {1.0, 1.0}}, "path is 0");
    refused({{0.0, 0.0}, {INFINITY, 0.0}}, "path is inf");
    refused({{0.0, 0.0}, {NAN, 0.0}}, "path is nan");
    TextOptions far;
    far.path = {{0.0, 0.0}, {1e6, 0.0}};  // 5·10⁷ em
    EXPECT_EQ(layOutText(font, "l", far).outline.loops.size(), 1U);
    EXPECT_THROW((void)layOutText(font, "l\nן", far), Error) << "one at each end";
    TextOptions both;
    both.arc = 1.0;
    both.path = {{0.0, 0.0}, {1.0, 0.0}};
    EXPECT_THROW((void)layOutText(font, "a", both), Error);
}

TEST(TextOnAPath, OfTightCurvesIsOneClosedSurface)
{
    // On the inside of a tight curve letters overlap; their union is liquid as any other footprint.
    const Font font = readFont(kSans);
    TextOptions options;
    options.path = pathIn(page("<path d='M0,0C30,60 35,60 45,0S80,-40 100,0'/>")).points;
    options.glyph.em = 10e-3;
    const Outline outline = layOutText(font, "Overlapping wave", options).outline;
    DropletOptions small;
    small.mesh.triangles = 3000;
    EXPECT_TRUE(topology(makeDroplet(outline, small).surface).closed);
}

// Sizes.

TEST(LineSizes, ScaleOutlinesExactly)
{
    const Font font = readFont(kSans);
    TextOptions options = inEms();
    for (const double size : {2.0, 0.5}) {
        options.glyph.em = size;
        options.line_sizes.clear();
        const Outline alone = layOutText(font, "Big e\u0301", options).outline;
        options.glyph.em = 1.0;
        options.line_sizes = {size};
        expectSameLoops(layOutText(font, "Big e\u0301", options).outline, alone, 1e-7);
    }
    options.line_sizes = {1.0, 1.0, 1.0};
    const Outline ones = layOutText(font, "a\nb\nc\nd", options).outline;
    options.line_sizes.clear();
    expectSameLoops(ones, layOutText(font, "a\nb\nc\nd", options).outline, 0.0);
}

TEST(LineSizes, LeadingFollowsThem)
{
    const Font font = readFont(kSans);
    TextOptions options = inEms();
    const double ascender = 1901.0 / 2048.0;
    const double descender = 483.0 / 2048.0;  // DejaVu has no gap between lines
    const auto height = [&](const char* text) { return layOutText(font, text, options).outline.extent.y; };
    options.line_sizes = {2.0, 1.0};
    EXPECT_NEAR(height("H\nH"), 3.0 * (ascender + descender), 1e-9) << "the boxes of the lines stand on one another";
    EXPECT_NEAR(height("H\nH\nH"), 4.0 * (ascender + descender), 1e-9) << "the last size is repeated";
    options.line_sizes = {1.0, 3.0};
    EXPECT_NEAR(height("H\nH"), 4.0 * (ascender + descender), 1e-9);
    options.line_spacing = 2.0;
    EXPECT_NEAR(height("H\nH"), 4.0 * (ascender + descender) + descender + 3.0 * ascender, 1e-9);
    // Wrapped lines keep the size of their line of text, and break by it.
    options.line_spacing = 1.0;
    options.line_sizes = {2.0, 1.0};
    options.measure = 4.7;  // three H are 2.26 em wide, a space is 0.32
    EXPECT_EQ(layOutText(font, "HHH HHH\nHHH HHH", options).lines, 4U);
    options.measure = 6.0;
    EXPECT_EQ(layOutText(font, "HHH HHH\nHHH HHH", options).lines, 3U);
    EXPECT_NEAR(height("HHH HHH\nHHH HHH"), 5.0 * (ascender + descender), 1e-9);
    for (const double wrong : {0.0, 0.01, 21.0, -1.0, static_cast<double>(NAN)}) {
        options.line_sizes = {1.0, wrong};
        EXPECT_THROW((void)layOutText(font, "H", options), Error);
    }
}

TEST(LineSizes, AlignWithOtherLines)
{
    const Font font = readFont(kSans);
    TextOptions options = inEms();
    options.line_sizes = {1.0, 3.0};
    options.align = TextAlign::End;
    const Outline right = layOutText(font, "l\nl", options).outline;
    ASSERT_EQ(right.loops.size(), 2U);
    const double bearing = (569.0 - 377.0) / 2048.0;
    std::vector<double> sides;
    for (const Loop& loop : right.loops) {
        const auto far =
            std::max_element(loop.points.begin(), loop.points.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
        sides.push_back(0.5 * right.extent.x - far->x);
    }
    std::sort(sides.begin(), sides.end());
    EXPECT_NEAR(sides[0], bearing, 1e-7);
    EXPECT_NEAR(sides[1], 3.0 * bearing, 1e-7);
    EXPECT_NEAR(right.extent.x, 3.0 * 569.0 / 2048.0, 1e-9);
    // Colours of a text without layers cover the same area.
    EXPECT_NEAR(layOutColours(font, "l\nl", options).drawing.extent.x, right.extent.x, 1e-9);
}

}  // namespace
}  // namespace droplet
