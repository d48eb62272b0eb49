// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that the drawing and page of an SVG are as the file states, and that malicious files do no harm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <zlib.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <numbers>
#include <numeric>
#include <thread>

#include "droplet/domain/domain.h"
#include "droplet/outline/outline.h"
#include "image/encoded_images.h"
#include "support/hostile_drawings.h"

namespace droplet {
namespace {

using namespace encoded;
using ::testing::AllOf;
using ::testing::AnyOf;
using testing::filtered;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::repeated;

Bytes svg(const std::string& attributes, const std::string& content)
{
    return bytesOf(R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" )" +
                   attributes + ">" + content + "</svg>");
}

/// SVG with a page of 10 × 10.
Bytes drawing(const std::string& content)
{
    return svg(R"(viewBox="0 0 10 10")", content);
}

MaskOptions side(int pixels)
{
    MaskOptions options;
    options.vector_long_side = pixels;
    return options;
}

/// Covered share of the whole page.
double coveredPart(const Mask& mask)
{
    return std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0) / 65535.0 /
           static_cast<double>(mask.coverage.size());
}

double coveredPart(const Bytes& encoded, int pixels = 100)
{
    MaskOptions options = side(pixels);
    options.allow_dry = true;
    return coveredPart(decodeMask(encoded, options));
}

/// Outline on a page one metre wide.
Outline outlineOf(const Bytes& encoded, int pixels)
{
    TraceOptions options;
    options.width = 1.0;
    return trace(decodeMask(encoded, side(pixels)), options);
}

double areaOf(const Outline& outline)
{
    double area = 0.0;
    for (const Loop& loop : outline.loops) {
        area += signedArea(loop);
    }
    return area;
}

Bytes gzipped(const Bytes& bytes)
{
    z_stream stream{};
    constexpr int kGzip = 16 + MAX_WBITS;
    deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, kGzip, 9, Z_DEFAULT_STRATEGY);
    Bytes compressed(deflateBound(&stream, bytes.size()));
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(compressed.data());
    stream.avail_out = static_cast<uInt>(compressed.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    compressed.resize(stream.total_out);
    deflateEnd(&stream);
    return compressed;
}

TEST(Svg, CircleEnclosesTheAreaOfADisc)
{
    // Renderers draw circles as cubic curves, which are up to 0.03 % larger, and then as chords.
    const Outline outline = outlineOf(drawing(R"(<circle cx="5.013" cy="4.987" r="4"/>)"), 1024);
    ASSERT_EQ(outline.loops.size(), 1U);
    EXPECT_TRUE(outline.anti_aliased);
    EXPECT_NEAR(areaOf(outline) / (0.16 * std::numbers::pi), 1.0, 4e-4);
    for (const Vec2 p : outline.loops[0].points) {
        ASSERT_NEAR(std::hypot(p.x - 0.0013, p.y - 0.0013), 0.4, 3e-4);
    }
}

TEST(Svg, OutlineConvergesWithTheResolution)
{
    std::string path;
    std::vector<Vec2> corners;
    for (int i = 0; i < 10; ++i) {
        const double radius = i % 2 == 0 ? 4.3 : 1.7;
        const double angle = i * std::numbers::pi / 5.0 + 0.1;
        corners.push_back({5.0 + radius * std::sin(angle), 5.0 - radius * std::cos(angle)});
        path += (i == 0 ? "M" : "L") + std::to_string(corners.back().x) + "," + std::to_string(corners.back().y);
    }
    double exact = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        exact += 0.5 * cross(corners[i], corners[(i + 1) % corners.size()]) / 100.0;
    }
    const Bytes star = drawing("<path d='" + path + "z'/>");
    const auto error = [&](int pixels) { return std::abs(areaOf(outlineOf(star, pixels)) / std::abs(exact) - 1.0); };
    const double coarse = error(256);
    const double fine = error(2048);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_LT(fine, 0.25 * coarse);
}

TEST(Svg, FillRuleDecidesOverHoles)
{
    const std::string squares = R"( d="M1,1H9V9H1zM3,3H7V7H3z"/>)";
    const Outline filled = outlineOf(drawing("<path" + squares), 200);
    EXPECT_EQ(filled.loops.size(), 1U);
    EXPECT_NEAR(areaOf(filled), 0.64, 1e-3);
    const Outline holed = outlineOf(drawing(R"(<path fill-rule="evenodd")" + squares), 200);
    EXPECT_EQ(holed.loops.size(), 2U);
    EXPECT_NEAR(areaOf(holed), 0.48, 1e-3);
    // The rule is non-zero, but the inner square runs the other way.
    const Outline wound = outlineOf(drawing(R"(<path d="M1,1H9V9H1zM3,3V7H7V3z"/>)"), 200);
    EXPECT_EQ(wound.loops.size(), 2U);
    EXPECT_NEAR(areaOf(wound), 0.48, 1e-3);
}

TEST(Svg, PathsAndGroupsAreUnited)
{
    const Bytes two = drawing(
        "<g transform='translate(1 1)'><rect width='2' height='2'/><g transform='scale(2)'><rect x='.5' y='.5' "
        "width='1' height='1'/></g></g><g><g><path d='M6 6h3v3h-3z'/></g></g><rect display='none' x='4' width='5' "
        "height='5'/>");
    const Outline outline = outlineOf(two, 500);
    EXPECT_EQ(outline.loops.size(), 2U);
    EXPECT_NEAR(areaOf(outline), 0.07 + 0.09, 1e-3);
    // Strokes are drawn, too.
    EXPECT_NEAR(coveredPart(drawing(R"(<path d="M1 5h8" stroke="red" stroke-width="2"/>)"), 100), 0.16, 1e-3);
}

TEST(Svg, TextIsDrawnWhereThereAreFonts)
{
    const Bytes text = drawing(R"(<text x="1" y="8" font-size="8">W</text>)");
    const double covered = coveredPart(text);
    if (covered == 0.0) {
        GTEST_SKIP() << "no fonts";
    }
    EXPECT_GT(covered, 0.05);
    EXPECT_LT(covered, 0.6);
}

TEST(Svg, TextIsDrawnAtAnyViewBox)
{
    // At 2048 pixels for a page of 24, Pango requests larger fonts than FreeType can make.
    const auto covered = [](double unit, int pixels) {
        const auto u = [unit](double length) { return std::to_string(length * unit); };
        return coveredPart(svg("viewBox='0 0 " + u(24) + " " + u(24) + "'",
                               "<text y='" + u(20) + "' font-size='" + u(20) + "'>A</text><text x='" + u(14) + "' y='" +
                                   u(9) + "' font-size='" + u(12) + "'>B</text>"),
                           pixels);
    };
    const double expected = covered(10.0, 240);
    if (expected == 0.0) {
        GTEST_SKIP() << "no fonts";
    }
    EXPECT_GT(expected, 0.05);
    for (const double unit : {0.1, 1.0, 10.0, 1e3}) {
        for (const int pixels : {64, 2048}) {
            EXPECT_NEAR(covered(unit, pixels), expected, 0.03 * expected) << unit << " " << pixels;
        }
    }
    EXPECT_THAT(messageOf(drawing("<text y='9' font-size='500000'>W</text>")), HasSubstr("letters of more than 65535"));
}

TEST(Svg, TransparentPageIsReadByAlphaAndOpaqueOneByLuma)
{
    const std::string square = R"(x="2" y="2" width="4" height="4"/>)";
    for (const char* colour : {"white", "black", "#c04020", "white' opacity='.5"}) {
        const Mask mask = decodeMask(drawing("<rect fill='" + std::string(colour) + "' " + square), side(100));
        EXPECT_EQ(mask.channel, Channel::Alpha) << colour;
        EXPECT_NEAR(coveredPart(mask), 0.16, 1e-3) << colour;
    }
    for (const auto& [page, colour] : {std::pair{"white", "black"}, {"#123", "yellow"}}) {
        const std::string background = "<rect width='10' height='10' fill='" + std::string(page) + "'/>";
        const Mask mask = decodeMask(drawing(background + "<rect fill='" + colour + "' " + square), side(100));
        EXPECT_EQ(mask.channel, Channel::Luma) << colour;
        EXPECT_NEAR(coveredPart(mask), 0.16, 1e-3) << colour;
    }
    EXPECT_NEAR(coveredPart(decodeMask(drawing("<rect " + square), only(Channel::Alpha))), 0.16, 1e-3);
}

struct PageCase {
    std::string attributes;
    int width;
    int height;
    double page_px;                  ///< width [CSS px]
    std::optional<double> physical;  ///< [m]
};

TEST(Svg, PageHasTheStatedSize)
{
    const std::vector<PageCase> cases{
        {R"(width="80" height="40")", 200, 100, 80, {}},
        {R"(width="80px" height="160px")", 100, 200, 80, {}},
        {R"(width="80mm" height="40mm")", 200, 100, 80 / 25.4 * 96, 0.08},
        {R"(width="8cm" height="4cm")", 200, 100, 80 / 25.4 * 96, 0.08},
        {R"(width="2in" height="1in")", 200, 100, 192, 0.0508},
        {R"(width="72pt" height="36pt")", 200, 100, 96, 0.0254},
        {R"(width="6pc" height="3pc")", 200, 100, 96, 0.0254},
        {R"(viewBox="0 0 30 10")", 200, 67, 30, {}},
        {R"(viewBox="5 5 10 30")", 67, 201, 10, {}},
        {R"(width="100%" height="100%" viewBox="0 0 30 10")", 200, 67, 30, {}},
        {R"(width="60mm" viewBox="0 0 30 10")", 200, 67, 60 / 25.4 * 96, 0.06},
        {R"(height="60mm" viewBox="0 0 30 10")", 200, 67, 180 / 25.4 * 96, 0.18},
        {R"(width="90" viewBox="0 0 30 10")", 200, 67, 90, {}},
        {R"(height="90" viewBox="0 0 30 10")", 200, 67, 270, {}},
        {R"(width="80mm" height="80mm" viewBox="0 0 30 10")", 200, 200, 80 / 25.4 * 96, 0.08},
    };
    for (const PageCase& page : cases) {
        const Mask mask = decodeMask(svg(page.attributes, R"(<rect x="1" y="1" width="7" height="7"/>)"), side(200));
        EXPECT_EQ(mask.width, page.width) << page.attributes;
        EXPECT_EQ(mask.height, page.height) << page.attributes;
        ASSERT_TRUE(mask.raster_scale) << page.attributes;
        EXPECT_NEAR(mask.width / *mask.raster_scale, page.page_px, 1e-9 * page.page_px) << page.attributes;
        ASSERT_EQ(mask.physical_width.has_value(), page.physical.has_value()) << page.attributes;
        EXPECT_NEAR(mask.physical_width.value_or(0.0), page.physical.value_or(0.0), 1e-12) << page.attributes;
    }
}

TEST(Svg, PageWithoutASizeHasTheBoundsOfTheDrawing)
{
    for (const char* place : {"x='500' y='-80'", "x='0' y='0'"}) {
        const Mask mask = decodeMask(svg("", "<rect width='60' height='20' " + std::string(place) + "/>"),
                                     {Channel::Alpha, false, 1 << 20, 300});
        EXPECT_EQ(mask.width, 300);
        EXPECT_EQ(mask.height, 100);
        EXPECT_NEAR(coveredPart(mask), 1.0, 1e-3);
    }
}

TEST(Svg, ContentKeepsItsAspectOnAPageOfAnotherAspect)
{
    const std::string disc = R"(<circle cx="5" cy="5" r="5"/>)";
    const double fitted = coveredPart(svg(R"(width="40" height="20" viewBox="0 0 10 10")", disc), 400);
    EXPECT_NEAR(fitted, 0.25 * std::numbers::pi / 2.0, 1e-3);
    const double stretched =
        coveredPart(svg(R"(width="40" height="20" viewBox="0 0 10 10" preserveAspectRatio="none")", disc), 400);
    EXPECT_NEAR(stretched, 0.25 * std::numbers::pi, 1e-3);
}

TEST(Svg, UnitsOfThePageDoNotMatter)
{
    const auto scaled = [](double unit) {
        const auto u = [unit](double length) { return std::to_string(length * unit); };
        return svg("viewBox='0 0 " + u(10) + " " + u(10) + "'",
                   "<circle cx='" + u(5) + "' cy='" + u(5) + "' r='" + u(4) + "'/>");
    };
    const double disc = 0.16 * std::numbers::pi;
    for (const double unit : {1e-3, 1.0, 1e3, 1e6}) {
        EXPECT_NEAR(coveredPart(scaled(unit), 200), disc, 1e-3 * disc) << unit;
    }
}

TEST(Svg, ResolutionStaysWithinItsBounds)
{
    const std::string rect = R"(<rect width="5" height="5"/>)";
    MaskOptions few = side(5000);
    few.max_pixels = 10'000;
    const Mask small = decodeMask(drawing(rect), few);
    EXPECT_EQ(small.width, 100);
    EXPECT_EQ(small.height, 100);
    EXPECT_EQ(decodeMask(drawing(rect)).width, 2048);
    // A very narrow page is drawn larger, so that it is more than a row of pixels.
    const Mask hair = decodeMask(svg(R"(viewBox="0 0 1000 2")", rect), side(2000));
    EXPECT_EQ(hair.height, 16);
    EXPECT_EQ(hair.width, 8000);
    EXPECT_EQ(decodeMask(svg(R"(viewBox="0 0 2 1000")", rect), side(2000)).width, 16);
    EXPECT_THAT(messageOf(svg(R"(viewBox="0 0 1 1e6")", rect)), HasSubstr("too narrow"));
    for (const char* none : {"width='0' height='5'", "viewBox='0 0 0 0' width='0' height='0'", ""}) {
        EXPECT_THAT(messageOf(svg(none, "")), AnyOf(HasSubstr("no size"), HasSubstr("without area"))) << none;
    }
}

TEST(Svg, CompressionAndEncodingDoNotChangeThePicture)
{
    const std::string text =
        R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><circle cx="5" cy="5" r="4"/></svg>)";
    const Mask plain = decodeMask(bytesOf(text), side(64));
    const auto expect_same = [&](const Bytes& encoded) {
        EXPECT_EQ(decodeMask(encoded, side(64)).coverage, plain.coverage);
    };
    expect_same(gzipped(bytesOf(text)));
    expect_same(bytesOf("\xef\xbb\xbf" + text));
    expect_same(bytesOf("\n  \t" + text));
    expect_same(bytesOf("<?xml version=\"1.0\"?>\n<!-- a drawing -->\n" + text));
    expect_same(bytesOf("<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"svg11.dtd\">" + text));
    expect_same(
        bytesOf("<s:svg xmlns:s=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 10 10\"><s:circle cx=\"5\" "
                "cy=\"5\" r=\"4\"/></s:svg>"));
    for (const bool little : {true, false}) {
        std::string wide = little ? "\xff\xfe" : "\xfe\xff";
        for (const char c : text) {
            wide += little ? std::string{c, '\0'} : std::string{'\0', c};
        }
        expect_same(bytesOf(wide));
    }
}

TEST(Svg, NothingOutsideTheFileIsRead)
{
    const Folder folder;
    writeFile(folder / "full.svg", drawing(R"(<rect width="10" height="10"/>)"));
    const std::string full = (folder / "full.svg").string();
    const std::string dot = R"(<rect width="1" height="1"/>)";
    for (const std::string& harm :
         {"<image width='10' height='10' xlink:href='" + full + "'/>",
          "<image width='10' height='10' xlink:href='file://" + full + "'/>",
          "<use xlink:href='file://" + full + "#r'/>",
          std::string("<image width='10' height='10' xlink:href='http://127.0.0.1:9/x.png'/>"),
          "<xi:include xmlns:xi='http://www.w3.org/2001/XInclude' href='" + full + "'/>",
          "<style>@import url(file://" + full + ");</style>",
          std::string("<script>document.documentElement.remove()</script>")}) {
        EXPECT_NEAR(coveredPart(drawing(dot + harm)), 0.01, 1e-4) << harm;
    }
    const std::string entity = "<!DOCTYPE svg [<!ENTITY x SYSTEM \"file://" + full + "\">]>";
    const Bytes outside = bytesOf(entity + R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">&x;</svg>)");
    EXPECT_THAT(messageOf(outside), HasSubstr("SVG"));
    // Embedded data are drawn: a black pixel as a PNG.
    const Bytes inside = drawing(
        dot +
        R"(<image x="5" y="5" width="5" height="5" xlink:href="data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAA)"
        R"(AAAA6fptVAAAACklEQVR4nGNgAAAAAgABSK+kcQAAAABJRU5ErkJggg=="/>)");
    EXPECT_NEAR(coveredPart(inside), 0.26, 1e-3);
}

TEST(Svg, DrawingThatShowsNothingIsToldSo)
{
    for (const char* nothing :
         {"", "<rect width='9' height='9' opacity='0'/>", "<rect x='20' width='9' height='9'/>"}) {
        EXPECT_THAT(messageOf(drawing(nothing)), HasSubstr("draws nothing: all is transparent")) << nothing;
        EXPECT_EQ(coveredPart(drawing(nothing)), 0.0) << "frames may be dry";
    }
    EXPECT_THAT(messageOf(drawing("<image width='9' height='9' href='photo.png'/>")),
                HasSubstr("draws nothing: it has linked pictures (embed them), which is not drawn"));
}

/// Lower and upper corner of what is drawn, on a page of 10 × 10.
std::array<Vec2, 2> boundsOf(const std::string& content)
{
    const Mask mask = decodeMask(drawing(content), side(200));
    std::array<Vec2, 2> bounds{Vec2{10.0, 10.0}, Vec2{0.0, 0.0}};
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) {
            if (mask.at(x, y) >= 32768) {
                bounds[0] = {std::min(bounds[0].x, x / 20.0), std::min(bounds[0].y, y / 20.0)};
                bounds[1] = {std::max(bounds[1].x, (x + 1) / 20.0), std::max(bounds[1].y, (y + 1) / 20.0)};
            }
        }
    }
    return bounds;
}

struct RewrittenCase {
    const char* content;
    double left, top, right, bottom;  ///< of what is drawn
};

// The drawings of tests/studio/drawings.mjs are compared with those of a browser.
TEST(Svg, WhatLibrsvgLacksIsDrawnInOtherWords)
{
    const std::string bar = "<rect x='4' y='1' width='2' height='6' ";
    const std::vector<RewrittenCase> cases{
        {"style='transform:rotate(90deg);transform-origin:5px 5px'/>", 3, 4, 9, 6},
        {"transform='rotate(90)' transform-origin='5 5'/>", 3, 4, 9, 6},
        {"style='transform:scale(.5);transform-origin:right bottom'/>", 7, 5.5, 8, 8.5},
        {"style='transform:rotate(90deg);transform-origin:center;transform-box:fill-box'/>", 2, 3, 8, 5},
        {"style='rotate:90deg;transform-origin:5px 4px'/>", 2, 3, 8, 5},
        {"style='translate:1px 2px;scale:.5'/>", 3, 2.5, 4, 5.5},
        {"transform='translate(9)' style='transform:translate(-1px,1px)'/>", 3, 2, 5, 8},
        {"style='height:calc(1px + (4px / 2))'/>", 4, 1, 6, 4},
        {"style='height:max(2px,3px)'/>", 4, 1, 6, 4},
        {"style='clip-path:inset(1px 0 50%)'/>", 4, 2, 6, 4},
        {"style='clip-path:circle(1px at 50% 2px)'/>", 4, 2, 6, 4},
        {"style='clip-path:polygon(0 0,100% 0,100% 3px,0 3px) fill-box'/>", 4, 1, 6, 4},
        {"style='clip-path:circle(2px at 5px 3px) view-box'/>", 4, 1, 6, 5},
    };
    for (const RewrittenCase& each : cases) {
        const auto [low, high] = boundsOf(bar + each.content);
        EXPECT_NEAR(low.x, each.left, 0.06) << each.content;
        EXPECT_NEAR(low.y, each.top, 0.06) << each.content;
        EXPECT_NEAR(high.x, each.right, 0.06) << each.content;
        EXPECT_NEAR(high.y, each.bottom, 0.06) << each.content;
    }
}

TEST(Svg, VariablesAndStrokesThatDoNotScaleAreDrawn)
{
    const auto line = [](const std::string& attributes) {
        return coveredPart(drawing("<g fill='none'><path d='M1 5H9' " + attributes + "/></g>"));
    };
    EXPECT_NEAR(line("stroke='var(--stroke-0, #1E1E1E)'"), 0.08, 1e-3) << "as Figma exports it";
    EXPECT_NEAR(line("stroke='var(--a, var(--b, red))' stroke-width='2'"), 0.16, 1e-3);
    EXPECT_NEAR(line("style='--wide:3;stroke:red;stroke-width:var(--wide)'"), 0.24, 1e-3);
    EXPECT_NEAR(coveredPart(drawing("<style>:root{--ink:red}.a>path{stroke:var(--ink)}</style><g class='a'>"
                                    "<path d='M1 5H9'/></g>")),
                0.08, 1e-3);
    EXPECT_EQ(line("stroke='var(--unknown)'"), 0.0);
    EXPECT_EQ(line("style='--a:var(--b);--b:var(--a);stroke:var(--a)'"), 0.0) << "a circle of variables";
    const std::string scaled = "<g transform='scale(4) rotate(90)' stroke='red'><path d='M0 -2H2' stroke-width='1' ";
    EXPECT_NEAR(coveredPart(drawing(scaled + "/></g>")), 0.32, 1e-3);
    EXPECT_NEAR(coveredPart(drawing(scaled + "vector-effect='non-scaling-stroke'/></g>")), 0.08, 1e-3);
}

TEST(Svg, WhatIsNotDrawnIsNamed)
{
    const std::string dot = "<rect width='1' height='1'/>";
    const auto lacking = [&](const std::string& content) {
        return decodeMask(drawing(dot + content), side(64)).lacking;
    };
    EXPECT_EQ(lacking(""), "");
    EXPECT_EQ(lacking("<text font-family='sans-serif'>a</text><use href='#a'/><image href='data:,'/>"), "");
    EXPECT_EQ(lacking("<text><textPath href='#p'>a</textPath></text>"), "textPath (convert text to paths)");
    EXPECT_EQ(lacking("<foreignObject/><flowRoot/>"), "foreignObject, flowRoot (convert text to paths)");
    EXPECT_EQ(lacking("<switch><foreignObject requiredExtensions='x'/><g/></switch>"), "")
        << "as Illustrator writes it";
    EXPECT_EQ(lacking("<image href='a.png'/><image href='b.png'/><use href='c.svg#d'/>"),
              "linked pictures (embed them), linked drawings (embed them)");
    EXPECT_THAT(lacking("<text font-family='No Such Font, serif'>a</text>"),
                HasSubstr("the font 'No Such Font', for which another is used"));
    EXPECT_THAT(lacking("<style>@font-face{font-family:Own;src:url(own.woff)}</style><text font-family='Own'>a</text>"),
                HasSubstr("the web font 'Own'"));
    EXPECT_EQ(lacking("<style>@import 'a.css';</style>"), "imported style sheets");
    EXPECT_EQ(lacking("<rect style='width:calc(50% - 1px)'/>"), "calc() of percentages or of units of a font");
    EXPECT_EQ(lacking("<rect style='clip-path:inset(1px round 1px 2px)'/>"), "the clip-path inset() of this kind");
    EXPECT_EQ(lacking("<path vector-effect='non-scaling-stroke' transform='scale(1 2)'/>"),
              "vector-effect of this kind, or under an uneven scale");
    EXPECT_EQ(lacking("<rect fill='oklch(0.5 0.2 30)'/>"), "the colour function oklch()");
}

TEST(Svg, DamagedStylesAreDrawnAsFarAsTheyGo)
{
    for (const char* style :
         {"transform-origin:", "transform-origin:1px;transform:rotate(", "clip-path:circle(", "r:calc(", "r:calc(1px +",
          "r:calc(((((((((((((((((((((((((((((((((((((1))))", "--a:var(--a);r:var(--a)",
          "transform:matrix(1,2);transform-origin:5px", "clip-path:polygon(1px)", ";;:;", "}{", "\\",
          "transform-origin:0x10px 1px;transform:scale(2)", "r:calc(inf * 1px)", "r:calc(1px / 0)"}) {
        EXPECT_NEAR(coveredPart(drawing("<rect width='5' height='5'/><circle style='" + std::string(style) +
                                        "'/><style>" + std::string(style) + "{" + style + "}</style>")),
                    0.25, 1e-3)
            << style;
    }
}

TEST(Svg, TooLargeDrawingsAreRejected)
{
    // 10^7 squares, if every reference were followed
    std::string bomb = R"(<defs><g id="a0"/>)";
    for (int i = 1; i <= 7; ++i) {
        bomb += "<g id='a" + std::to_string(i) + "'>";
        for (int k = 0; k < 10; ++k) {
            bomb += "<use xlink:href='#a" + std::to_string(i - 1) + "'/>";
        }
        bomb += "</g>";
    }
    EXPECT_THAT(messageOf(drawing(bomb + R"(</defs><use xlink:href="#a7"/>)"), side(64)),
                HasSubstr("more than 500000"));

    std::string tags;
    for (int i = 0; i < 250'001; ++i) {
        tags += "<g/>";
    }
    EXPECT_THAT(messageOf(drawing(tags)), HasSubstr("tags, more than the limit of 250000"));

    const Bytes blank = drawing(std::string((std::size_t{1} << 26) + 1, ' '));
    EXPECT_THAT(messageOf(blank), HasSubstr("more than 64 MiB"));
    EXPECT_THAT(messageOf(gzipped(blank)), HasSubstr("more than 64 MiB"));

    std::string laughs = "<!DOCTYPE svg [<!ENTITY a0 \"ha\">";
    for (int i = 1; i <= 9; ++i) {
        laughs += "<!ENTITY a" + std::to_string(i) + " \"";
        for (int k = 0; k < 10; ++k) {
            laughs += "&a" + std::to_string(i - 1) + ";";
        }
        laughs += "\">";
    }
    const std::string laughing =
        laughs + R"(]><svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><text>&a9;</text></svg>)";
    EXPECT_THAT(messageOf(bytesOf(laughing)), HasSubstr("SVG"));

    std::string nested;
    for (int i = 0; i < 1000; ++i) {
        nested = "<g>" + nested + "</g>";
    }
    EXPECT_THAT(messageOf(drawing(nested)), HasSubstr("depth"));
}

/// Number of open files of this process.
std::size_t openFiles()
{
    const std::filesystem::directory_iterator all("/proc/self/fd");
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

TEST(Svg, TimeAndMemoryOfADrawingAreLimited)
{
    const std::size_t open_before = openFiles();
    std::size_t refused = 0;
    for (const testing::HostileDrawing& hostile : testing::hostileDrawings()) {
        MaskOptions options = side(128);
        options.vector_seconds = 0.15;
        options.vector_memory = std::size_t{128} << 20;
        try {
            decodeMask(bytesOf(hostile.text()), options).validate();
        } catch (const Error& error) {
            ++refused;
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << hostile.name;
            EXPECT_THAT(error.what(), AllOf(HasSubstr("SVG image"), Not(HasSubstr("\n")))) << hostile.name;
        }
    }
    EXPECT_GT(refused, 10U);
    EXPECT_EQ(openFiles(), open_before);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child process is left";

    MaskOptions options = side(2048);
    options.vector_memory = std::size_t{100} << 20;
    const Bytes layers =
        drawing(repeated(100, "<g opacity='.9'>") + "<rect width='9' height='9'/>" + repeated(100, "</g>"));
    EXPECT_THAT(messageOf(layers, options), HasSubstr("takes more than 100 MiB of memory to draw"));
    options.vector_seconds = 0.1;
    EXPECT_THAT(messageOf(drawing(filtered("<feTurbulence baseFrequency='.7' numOctaves='1000000'/>")), options),
                HasSubstr("takes more than 0.1 s to draw"));
}

TEST(Svg, DrawingDoesNotDependOnTheSignalsOfItsHost)
{
    // A host that ignores SIGCHLD cannot wait for children; signals blocked here must not be blocked in the drawing.
    const Bytes square = drawing("<rect width='5' height='10'/>");
    const auto before = std::signal(SIGCHLD, SIG_IGN);
    sigset_t all;
    sigset_t unblocked;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &unblocked);
    MaskOptions options = side(16);
    EXPECT_NEAR(coveredPart(decodeMask(square, options)), 0.5, 1e-6);
    options.vector_seconds = 0.1;
    EXPECT_THAT(messageOf(drawing(filtered("<feTurbulence baseFrequency='.7' numOctaves='1000000000'/>")), options),
                HasSubstr("takes more than 0.1 s to draw"));
    pthread_sigmask(SIG_SETMASK, &unblocked, nullptr);
    std::signal(SIGCHLD, before);
}

TEST(Svg, ElementsMayReferToOneAnotherDeeply)
{
    // Each link needs stack; the chain would overflow the stack of an ordinary thread many times.
    const auto chain = [](const std::string& first, const std::string& link, const std::string& last) {
        std::string content = "<defs>" + first;
        const int links = 3000;
        for (int i = 1; i < links; ++i) {
            std::string next = link;
            next.replace(next.find('@'), 1, std::to_string(i));
            next.replace(next.find('@'), 1, std::to_string(i - 1));
            content += next;
        }
        return drawing(content + "</defs>" + last + "#a" + std::to_string(links - 1) +
                       (last.back() == '(' ? ")'/>" : "'/>"));
    };
    const Bytes uses =
        chain("<rect id='a0' width='5' height='5'/>", "<use id='a@' xlink:href='#a@'/>", "<use xlink:href='");
    EXPECT_NEAR(coveredPart(uses, 16), 0.25, 1e-3);
    const Bytes patterns =
        chain("<pattern id='a0' width='1' height='1'><rect width='9' height='9'/></pattern>",
              "<pattern id='a@' width='1' height='1'><rect width='9' height='9' fill='url(#a@)'/></pattern>",
              "<rect width='5' height='5' fill='url(");
    EXPECT_GT(coveredPart(patterns, 16), 0.1);
}

TEST(Svg, BrokenFilesGiveAnErrorOfOneLine)
{
    const Bytes whole = svg("width='8' height='8'", "<g transform='scale(2)'><path d='M1 1h2v2z'/></g>");
    for (std::size_t length = 0; length < whole.size(); length += 3) {
        const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
        const std::string message = messageOf(cut, side(16));
        ASSERT_FALSE(message.empty()) << length;
        ASSERT_EQ(message.find('\n'), std::string::npos) << message;
    }
    const Bytes compressed = gzipped(whole);
    for (std::size_t length = 2; length < compressed.size(); length += 3) {
        const Bytes cut(compressed.begin(), compressed.begin() + static_cast<std::ptrdiff_t>(length));
        ASSERT_FALSE(messageOf(cut, side(16)).empty()) << length;
    }
    EXPECT_THAT(messageOf(bytesOf("<svg><circle></svg>")), AllOf(HasSubstr("damaged SVG"), HasSubstr("line 1")));
    EXPECT_THAT(messageOf(bytesOf("<html><svg/></html>")), HasSubstr("damaged SVG"));
    EXPECT_THAT(messageOf(bytesOf("<html><body/></html>")), HasSubstr("not an image this program reads"));
    EXPECT_THAT(messageOf(gzipped(bytesOf("some text"))), HasSubstr("without an SVG image"));
    EXPECT_THAT(messageOf(gzipped(gzipped(whole))), HasSubstr("without an SVG image"));
}

TEST(Svg, ThreadsCanDrawAtTheSameTime)
{
    const Bytes encoded = drawing(
        "<filter id='f'><feGaussianBlur stdDeviation='.2'/></filter><circle cx='5' cy='5' r='4' filter='url(#f)'/>"
        "<text x='1' y='8' font-size='8'>W</text>");
    const Mask alone = decodeMask(encoded, side(200));
    std::vector<Mask> masks(4);
    std::vector<std::thread> threads;
    for (Mask& mask : masks) {
        threads.emplace_back([&] { mask = decodeMask(encoded, side(200)); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const Mask& mask : masks) {
        EXPECT_EQ(mask.coverage, alone.coverage);
    }
}

TEST(Svg, PixelSizeIsThatOfThePage)
{
    TraceOptions options;
    options.pixel_size = 1e-3;
    const Bytes encoded = svg(R"(width="30" height="20")", R"(<rect x="5" y="5" width="10" height="10"/>)");
    for (const int pixels : {300, 1000}) {
        const Outline outline = trace(decodeMask(encoded, side(pixels)), options);
        EXPECT_NEAR(outline.extent.x, 30e-3, 1e-12);
        EXPECT_NEAR(areaOf(outline), 1e-4, 1e-7);
    }
}

}  // namespace
}  // namespace droplet
