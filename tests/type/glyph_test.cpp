// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/type/glyph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "support/fonts.h"
#include "support/loops.h"

namespace droplet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::kSans;
using testing::kVariable;
using testing::RenderedFont;

constexpr double kEm = 1.0;

GlyphOptions inEms()
{
    GlyphOptions options;
    options.em = kEm;
    return options;
}

double inkArea(const Outline& outline)
{
    double sum = 0.0;
    for (const Loop& loop : outline.loops) {
        sum += signedArea(loop);
    }
    return sum;
}

std::size_t holesIn(const Outline& outline)
{
    return static_cast<std::size_t>(
        std::count_if(outline.loops.begin(), outline.loops.end(), [](const Loop& l) { return signedArea(l) < 0.0; }));
}

std::size_t cornersIn(const Outline& outline)
{
    std::size_t count = 0;
    for (const Loop& loop : outline.loops) {
        count += static_cast<std::size_t>(std::count(loop.corner.begin(), loop.corner.end(), 1));
    }
    return count;
}

Outline glyphOf(const Font& font, char32_t character)
{
    return glyphOutline(font, font.glyphOf(character).value(), inEms());
}

struct Box {
    Vec2 low{1e9, 1e9};
    Vec2 high{-1e9, -1e9};
};

Box boxOf(const Loop& loop)
{
    Box box;
    for (const Vec2 p : loop.points) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
    return box;
}

Box inkOf(const Outline& outline)
{
    Box box;
    for (const Loop& loop : outline.loops) {
        const Box one = boxOf(loop);
        box.low = {std::min(box.low.x, one.low.x), std::min(box.low.y, one.low.y)};
        box.high = {std::max(box.high.x, one.high.x), std::max(box.high.y, one.high.y)};
    }
    return box;
}

TEST(Glyph, HasTheLoopsAndCornersOfTheFont)
{
    const Font font = readFont(kSans);
    const struct {
        char32_t character;
        std::size_t loops;
        std::size_t holes;
        std::size_t corners;
    } cases[] = {
        {'l', 1, 0, 4}, {'o', 2, 1, 0},  {'i', 2, 0, 8},  {'A', 2, 1, 11},
        {'%', 5, 2, 4}, {U'Θ', 3, 1, 4}, {U'●', 1, 0, 0}, {U'◉', 3, 1, 0},
    };
    for (const auto& [character, loops, holes, corners] : cases) {
        SCOPED_TRACE(characterText(character));
        const Outline outline = glyphOf(font, character);
        EXPECT_EQ(outline.loops.size(), loops);
        EXPECT_EQ(holesIn(outline), holes);
        EXPECT_EQ(cornersIn(outline), corners);
    }
}

TEST(Glyph, HasTheSizesOfTheFont)
{
    const Font font = readFont(kSans);
    // The bar of l: from 193 to 377 and 0 to 1556, in 2048ths of an em; advance 569, ascender 1901, descender −483.
    const Outline l = glyphOf(font, 'l');
    const Box ink = inkOf(l);
    EXPECT_DOUBLE_EQ(ink.high.x - ink.low.x, 184.0 / 2048.0);
    EXPECT_DOUBLE_EQ(ink.high.y - ink.low.y, 1556.0 / 2048.0);
    EXPECT_DOUBLE_EQ(l.extent.x, 569.0 / 2048.0);
    EXPECT_DOUBLE_EQ(l.extent.y, (1901.0 + 483.0) / 2048.0);
    EXPECT_DOUBLE_EQ(ink.low.y, -(1901.0 - 483.0) / 2.0 / 2048.0) << "the base line";
    EXPECT_EQ(l.pixel_size, 0.0);
    // The same in another size.
    const Outline large = glyphOutline(font, font.glyphOf('l').value(), {0.05, {}, 1e-5});
    EXPECT_NEAR(inkOf(large).high.x, 0.05 * ink.high.x, 1e-12);
    EXPECT_NEAR(large.extent.y, 0.05 * l.extent.y, 1e-12);
}

TEST(Glyph, PointsAreCloseAndCornersStay)
{
    const Font font = readFont(kSans);
    for (const char32_t character : U"lgR&@") {
        if (character == 0) {
            continue;
        }
        const Outline outline = glyphOf(font, character);
        for (const Loop& loop : outline.loops) {
            ASSERT_EQ(loop.corner.size(), loop.points.size());
            const std::size_t n = loop.points.size();
            for (std::size_t i = 0; i < n; ++i) {
                const Vec2 after = loop.points[(i + 1) % n] - loop.points[i];
                const Vec2 before = loop.points[i] - loop.points[(i + n - 1) % n];
                const double turn = std::abs(std::atan2(cross(before, after), dot(before, after)));
                EXPECT_LE(length(after), 1.02 / 256.0);
                EXPECT_GT(length(after), 0.0);
                EXPECT_EQ(loop.corner[i] != 0, turn > 25.0 * kDegree);
                EXPECT_TRUE(turn > 25.0 * kDegree || turn < 12.0 * kDegree) << turn / kDegree;
            }
        }
    }
}

TEST(Glyph, ToleranceBoundsTheDistance)
{
    const Font font = readFont(kSans);
    const GlyphId glyph = font.glyphOf(U'°').value();  // a small ring
    GlyphOptions fine = inEms();
    fine.tolerance = 1e-7;
    const Outline exact = glyphOutline(font, glyph, fine);
    for (const double tolerance : {1e-4, 1e-5, 1e-6}) {
        GlyphOptions options = inEms();
        options.tolerance = tolerance;
        const Outline outline = glyphOutline(font, glyph, options);
        EXPECT_LT(outline.loops[0].points.size(), exact.loops[0].points.size());
        double max = 0.0;
        for (std::size_t k = 0; k < outline.loops.size(); ++k) {
            const std::vector<Vec2>& pieces = outline.loops[k].points;
            for (const Vec2 p : exact.loops[k].points) {
                double min = 1.0;
                for (std::size_t i = 0; i < pieces.size(); ++i) {
                    min = std::min(min, testing::distanceToPiece(p, pieces[i], pieces[(i + 1) % pieces.size()]));
                }
                max = std::max(max, min);
            }
        }
        EXPECT_LT(max, tolerance + 1e-7);
    }
}

TEST(Glyph, BlanksHaveNoInk)
{
    const Font font = readFont(kSans);
    for (const char32_t blank : {U' ', U' ', U'​'}) {
        const Outline outline = glyphOf(font, blank);
        EXPECT_TRUE(outline.loops.empty());
        EXPECT_EQ(outline.specks_dropped, 0U);
    }
}

TEST(Glyph, HasTheBaseLineOfOthersEvenIfItIsTall)
{
    const Font font = readFont(kSans);
    const auto base = [&](char32_t c) { return inkOf(glyphOf(font, c)).low.y; };
    EXPECT_DOUBLE_EQ(base('l'), base('H'));
    // Its box grows to contain it, and stays centred.
    const Outline tall = glyphOf(font, U'⎮');
    EXPECT_GT(tall.extent.y, glyphOf(font, 'l').extent.y);
    for (GlyphId glyph = 0; glyph < font.glyphCount(); glyph += 97) {
        const Outline outline = glyphOutline(font, glyph, inEms());
        const Box ink = inkOf(outline);
        if (!outline.loops.empty()) {
            EXPECT_LE(std::max(std::abs(ink.low.x), std::abs(ink.high.x)), 0.5 * outline.extent.x + 1e-15);
            EXPECT_LE(std::max(std::abs(ink.low.y), std::abs(ink.high.y)), 0.5 * outline.extent.y + 1e-15);
        }
    }
}

TEST(Glyph, EnclosesTheExactAreaOfItsCurves)
{
    for (const char* path : {kSans, testing::kSerif}) {
        const Font font = readFont(path);
        const RenderedFont rendered(path, 2048);  // one pixel per unit, so that nothing is rounded
        for (char32_t character = '!'; character <= '~'; ++character) {
            SCOPED_TRACE(characterText(character));
            const GlyphId glyph = font.glyphOf(character).value();
            const double exact = rendered.exactArea(glyph);
            // Chords of length s cut off s²/12r per length, and pieces are shorter than em/256.
            EXPECT_NEAR(inkArea(glyphOutline(font, glyph, inEms())), exact, 1e-3 * exact);
            GlyphOptions fine = inEms();
            fine.tolerance = 1e-8;
            EXPECT_NEAR(inkArea(glyphOutline(font, glyph, fine)), exact, 5e-6 * exact);
        }
    }
}

/// Compares every n-th glyph with FreeType's rasteriser, which needs neither unions nor flattening.
void expectAsRendered(const char* path, GlyphId step)
{
    constexpr unsigned kPixels = 256;  // per em; a whole number of font units per pixel
    const Font font = readFont(path);
    const RenderedFont rendered(path, kPixels);
    for (GlyphId glyph = 0; glyph < font.glyphCount(); glyph += step) {
        SCOPED_TRACE(font.nameOf(glyph));
        const Outline outline = glyphOutline(font, glyph, inEms());
        const Mask mask = rendered(glyph);
        const double pixels = std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0) / 65535.0;
        if (outline.loops.empty()) {
            EXPECT_EQ(pixels, 0.0);
            continue;
        }
        // FreeType replaces curves by straight pieces that lie at most a 16th of a pixel inside them.
        const double border = std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0, [](double sum, auto c) {
            return sum + (c > 0 && c < 65535 ? 1.0 : 0.0);
        });
        EXPECT_NEAR(inkArea(outline) * kPixels * kPixels, pixels, 0.02 * border + 1e-9);
        const Outline traced = trace(mask, {.pixel_size = kEm / kPixels, .speck_size = 2.0});
        EXPECT_EQ(outline.loops.size() - holesIn(outline), traced.loops.size() - holesIn(traced));
        EXPECT_EQ(holesIn(outline), holesIn(traced));
        EXPECT_EQ(outline.specks_dropped, 0U);

        DropletOptions options;
        options.mesh.triangles = 300;
        const Droplet droplet = makeDroplet(outline, options);
        const Topology shape = topology(droplet.surface);
        EXPECT_TRUE(shape.closed);
        EXPECT_EQ(shape.components, outline.loops.size() - holesIn(outline));
        EXPECT_EQ(shape.euler, 2 * static_cast<long>(shape.components) - 2 * static_cast<long>(holesIn(outline)));
        EXPECT_NEAR(droplet.total.footprint_area, inkArea(outline), 1e-2 * inkArea(outline));
        EXPECT_GT(droplet.total.volume, 0.0);
        EXPECT_NEAR(enclosedVolume(droplet.surface), droplet.total.volume, 1e-6 * droplet.total.volume);
    }
}

TEST(WholeFont, SansIsAsRendered)
{
    expectAsRendered(kSans, 20);
}

TEST(WholeFont, SerifIsAsRendered)
{
    expectAsRendered(testing::kSerif, 20);
}

TEST(WholeFont, OverlappingContoursOfAVariableFontAreAsRendered)
{
    expectAsRendered(kVariable, 50);
}

TEST(WholeFont, OneFontServesSeveralThreads)
{
    const Font font = readFont(kSans);
    const auto work = [&](std::vector<double>& areas) {
        for (GlyphId glyph = 0; glyph < 400; glyph += 3) {
            areas.push_back(inkArea(glyphOutline(font, glyph)));
            areas.push_back(inkArea(layOutText(font, font.nameOf(glyph)).outline));
        }
    };
    std::vector<double> alone;
    work(alone);
    std::vector<std::vector<double>> results(4);
    std::vector<std::thread> threads;
    for (std::vector<double>& result : results) {
        threads.emplace_back([&] { work(result); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const std::vector<double>& result : results) {
        EXPECT_EQ(result, alone);
    }
}

TEST(VariableFont, AxesChangeTheShapes)
{
    double last = 0.0;
    for (const double weight : {100.0, 250.5, 400.0, 650.0, 900.0}) {
        const Font font = readFont(kVariable, {0, {{"wght", weight}}});
        const double area = inkArea(glyphOf(font, 'H'));
        EXPECT_GT(area, last) << weight;
        last = area;
    }
    EXPECT_EQ(inkArea(glyphOf(readFont(kVariable, {0, {{"wght", 400}}}), 'H')),
              inkArea(glyphOf(readFont(kVariable), 'H')));
    // Letters are wider, and text uses the new widths.
    const auto width = [](double weight) {
        return layOutText(readFont(kVariable, {0, {{"wght", weight}}}), "mm").outline.extent.x;
    };
    EXPECT_GT(width(900), 1.05 * width(400));
}

TEST(GlyphOptions, AreChecked)
{
    const Font font = readFont(kSans);
    const auto refused = [&](const GlyphOptions& options, const char* words) {
        try {
            glyphOutline(font, 36, options);
            ADD_FAILURE() << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    };
    refused({0.0, {}, 0.0}, "em is 0");
    refused({INFINITY, {}, 0.0}, "em is inf");
    refused({1.0, 0.0, 0.0}, "tolerance is 0");
    refused({1.0, {}, -1.0}, "speck_size is -1");
    EXPECT_THROW(glyphOutline(font, 6253), Error);
    TextOptions spacing;
    spacing.line_spacing = 0.0;
    EXPECT_THROW(layOutText(font, "a", spacing), Error);
}

// Text.

Outline textOf(const Font& font, const char* text)
{
    TextOptions options;
    options.glyph = inEms();
    return layOutText(font, text, options).outline;
}

/// Checks that the loops of one outline are those of another, shifted along x and y.
void expectMoved(const Outline& a, const Outline& b)
{
    ASSERT_EQ(a.loops.size(), b.loops.size());
    const Vec2 by = b.loops[0].points[0] - a.loops[0].points[0];
    for (std::size_t k = 0; k < a.loops.size(); ++k) {
        ASSERT_EQ(a.loops[k].points.size(), b.loops[k].points.size());
        for (std::size_t i = 0; i < a.loops[k].points.size(); ++i) {
            EXPECT_LT(length(a.loops[k].points[i] + by - b.loops[k].points[i]), 1e-7);
        }
    }
}

TEST(Text, OfOneLetterEqualsItsGlyph)
{
    const Font font = readFont(kSans);
    for (const char* letter : {"g", "B", "%"}) {
        const Outline glyph = glyphOf(font, static_cast<char32_t>(letter[0]));
        const Outline text = textOf(font, letter);
        expectMoved(glyph, text);
        EXPECT_EQ(text.loops[0].points[0], glyph.loops[0].points[0]) << "in the same box";
        EXPECT_NEAR(text.extent.x, glyph.extent.x, 1e-12);
        EXPECT_NEAR(text.extent.y, glyph.extent.y, 1e-12);
    }
}

TEST(Text, IsKerned)
{
    const Font font = readFont(kSans);
    const auto width = [&](const char* text) { return textOf(font, text).extent.x; };
    EXPECT_NEAR(width("HH"), 2 * width("H"), 1e-12);
    EXPECT_LT(width("AV"), width("A") + width("V") - 0.03);
    EXPECT_LT(width("To"), width("T") + width("o") - 0.03);
}

TEST(Text, HasLigaturesAndJoinedMarks)
{
    const Font font = readFont(kSans);
    expectMoved(textOf(font, "fi"), glyphOf(font, U'ﬁ'));
    expectMoved(textOf(font, "e\u0301"), glyphOf(font, U'é'));
    // A mark without a combined letter is placed above the middle of its base.
    const Outline marked = textOf(font, "x\u0301");
    ASSERT_EQ(marked.loops.size(), 2U);
    const Box x = boxOf(marked.loops[0]);
    const Box acute = boxOf(marked.loops[1]);
    EXPECT_GT(acute.low.y, x.high.y);
    EXPECT_GT(acute.low.x, x.low.x);
    EXPECT_LT(acute.high.x, x.high.x);
}

TEST(Text, RunsFromRightToLeftIfItsScriptDoes)
{
    const Font font = readFont(kSans);
    // Alef, with two pieces; then bet to its left, with one.
    const Outline hebrew = textOf(font, "אן");
    ASSERT_EQ(hebrew.loops.size(), 2U);
    const Outline nun = glyphOf(font, U'ן');
    EXPECT_NEAR(signedArea(hebrew.loops[0]), signedArea(nun.loops[0]), 1e-6) << "the last letter is leftmost";
    // Arabic letters join: beh beh is one body over two dots, not two bodies.
    const Outline joined = textOf(font, "بب");
    EXPECT_EQ(joined.loops.size(), 3U);
    EXPECT_EQ(textOf(font, "ب ب").loops.size(), 4U);
}

TEST(Text, OfBothDirectionsIsOrdered)
{
    const Font font = readFont(kSans);
    // From left to right: l, final nun, alef, H.
    const Outline mixed = textOf(font, "l אן H");
    ASSERT_EQ(mixed.loops.size(), 4U);
    EXPECT_NEAR(signedArea(mixed.loops[0]), signedArea(glyphOf(font, 'l').loops[0]), 1e-6);
    EXPECT_NEAR(signedArea(mixed.loops[1]), signedArea(glyphOf(font, U'ן').loops[0]), 1e-6);
    EXPECT_NEAR(signedArea(mixed.loops[2]), signedArea(glyphOf(font, U'א').loops[0]), 1e-6);
    EXPECT_NEAR(signedArea(mixed.loops[3]), signedArea(glyphOf(font, 'H').loops[0]), 1e-6);
    // Numbers among right-to-left letters run from left to right.
    const Outline number = textOf(font, "א17");
    ASSERT_EQ(number.loops.size(), 3U);
    EXPECT_NEAR(signedArea(number.loops[0]), signedArea(glyphOf(font, '1').loops[0]), 1e-6);
    EXPECT_NEAR(signedArea(number.loops[1]), signedArea(glyphOf(font, '7').loops[0]), 1e-6);
}

TEST(Text, MayHaveSeveralLines)
{
    const Font font = readFont(kSans);
    TextOptions options;
    options.glyph = inEms();
    const auto set = [&](const char* text) { return layOutText(font, text, options); };
    const TextLayout two = set("HHH\nl");
    EXPECT_EQ(two.lines, 2U);
    const double pitch = 2384.0 / 2048.0;
    EXPECT_NEAR(two.outline.extent.y, 2 * pitch, 1e-9);
    EXPECT_NEAR(two.outline.extent.x, set("HHH").outline.extent.x, 1e-12);
    // The bar of l, found by its area, and its place for every alignment.
    const auto bar = [&](const TextLayout& text) {
        const double area = signedArea(glyphOf(font, 'l').loops[0]);
        for (const Loop& loop : text.outline.loops) {
            if (std::abs(signedArea(loop) - area) < 1e-6) {
                return boxOf(loop).low;
            }
        }
        return Vec2{NAN, NAN};
    };
    const double width = two.outline.extent.x;
    const double advance = 569.0 / 2048.0;
    const double bearing = 193.0 / 2048.0;
    EXPECT_NEAR(bar(two).x, -0.5 * width + bearing, 1e-7);
    EXPECT_NEAR(bar(two).y, -pitch + 483.0 / 2048.0, 1e-7);
    options.align = TextAlign::Centre;
    EXPECT_NEAR(bar(set("HHH\nl")).x, -0.5 * advance + bearing, 1e-7);
    options.align = TextAlign::End;
    EXPECT_NEAR(bar(set("HHH\nl")).x, 0.5 * width - advance + bearing, 1e-7);
    options.align = TextAlign::Start;
    EXPECT_NEAR(bar(set("HHH\nl")).x, bar(set("HHH\r\nl")).x, 0.0);
    options.line_spacing = 2.0;
    EXPECT_NEAR(set("H\nH").outline.extent.y, 3 * pitch, 1e-9);
    EXPECT_EQ(set("\n\nH\n").lines, 4U);
}

TEST(Text, TrackingIsBetweenLetters)
{
    const Font font = readFont(kSans);
    TextOptions options;
    options.glyph = inEms();
    const auto width = [&](const char* text) { return layOutText(font, text, options).outline.extent.x; };
    const double tight = width("HHHH");
    const double alone = width("H");
    const double arabic = width("ببب");
    options.tracking = 0.25;
    EXPECT_NEAR(width("HHHH"), tight + 3 * 0.25, 1e-12);
    EXPECT_NEAR(width("H"), alone, 1e-12);
    EXPECT_NEAR(width("ببب"), arabic, 1e-12) << "letters that join stay joined";
    EXPECT_EQ(layOutText(font, "fi", options).outline.loops.size(), 3U) << "no ligature: f, i and its dot";
    options.tracking = 11.0;
    EXPECT_THROW(width("H"), Error);
}

TEST(Text, BreaksAtSpaces)
{
    const Font font = readFont(kSans);
    TextOptions options;
    options.glyph = inEms();
    const auto set = [&](const char* text) { return layOutText(font, text, options); };
    const TextLayout by_hand = set("one two\nthree\nfour");
    options.measure = 1.01 * by_hand.outline.extent.x;
    const TextLayout wrapped = set("one two three four");
    EXPECT_EQ(wrapped.lines, 3U);
    expectMoved(wrapped.outline, by_hand.outline);
    EXPECT_EQ(set("one two\n\nthree").lines, 3U) << "empty lines stay";
    options.measure = 0.1;
    EXPECT_EQ(set("one two three").lines, 3U) << "a word stays whole";
    options.measure = 1e3;
    EXPECT_EQ(set("one two three four").lines, 1U);
    options.measure = 0.0;
    EXPECT_THROW(set("one"), Error);
}

// Letters turn about the circle's centre; the middle one is upright, at the top or at the bottom.
TEST(Text, StandsAroundACircle)
{
    const Font font = readFont(kSans);
    TextOptions options;
    options.glyph = inEms();
    const double letter = signedArea(glyphOf(font, 'H').loops[0]);
    for (const double radius : {5.0, -5.0}) {
        options.arc = radius;
        const TextLayout text = layOutText(font, "HHHHH", options);
        ASSERT_EQ(text.outline.loops.size(), 5U);
        std::vector<Vec2> middles;
        for (const Loop& loop : text.outline.loops) {
            EXPECT_NEAR(signedArea(loop), letter, 1e-6);
            const auto box = boxOf(loop);
            middles.push_back(0.5 * (box.low + box.high));
        }
        std::sort(middles.begin(), middles.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
        EXPECT_NEAR(middles[0].y, middles[4].y, 1e-6);
        EXPECT_NEAR(middles[1].y, middles[3].y, 1e-6);
        EXPECT_GT((middles[2].y - middles[1].y) * radius, 0.0);
        const double height = 0.5 * 1493.0 / 2048.0;  // of half an H above the base line
        const Vec2 centre{middles[2].x, middles[2].y - height - radius};
        for (const Vec2 p : middles) {
            EXPECT_NEAR(length(p - centre), std::abs(radius + height), 2e-3) << "of boxes of turned letters";
        }
    }
    // A huge circle is a line.
    options.arc = 1e6;
    const TextLayout almost = layOutText(font, "Hug\nto", options);
    options.arc.reset();
    const TextLayout straight = layOutText(font, "Hug\nto", options);
    EXPECT_NEAR(almost.outline.extent.x, straight.outline.extent.x, 1e-4);
    EXPECT_NEAR(almost.outline.extent.y, straight.outline.extent.y, 1e-4);
    EXPECT_EQ(almost.outline.loops.size(), straight.outline.loops.size());
    for (const double small : {0.3, -0.3, 0.0}) {
        options.arc = small;
        EXPECT_THROW(layOutText(font, "HHHHH", options), Error);
    }
    options.arc = 1.0;
    EXPECT_THROW(layOutText(font, "H\nH", options), Error) << "the second line is beyond the centre";
}

TEST(Text, LinesFromRightToLeftStartOnTheRight)
{
    const Font font = readFont(kSans);
    const Outline outline = textOf(font, "HHHH\nן");
    const Loop& first = outline.loops.front();
    EXPECT_NEAR(boxOf(first).low.x, inkOf(outline).low.x, 1e-12);
    const double nun = signedArea(glyphOf(font, U'ן').loops[0]);
    const auto found = std::find_if(outline.loops.begin(), outline.loops.end(),
                                    [&](const Loop& loop) { return std::abs(signedArea(loop) - nun) < 1e-6; });
    ASSERT_NE(found, outline.loops.end());
    EXPECT_GT(boxOf(*found).low.x, 0.3 * outline.extent.x);
}

TEST(Text, MissingCharactersAreLeftOutAndReported)
{
    const Font font = readFont(kSans);
    TextOptions options;
    options.glyph = inEms();
    const TextLayout text = layOutText(font, "H水H火水", options);
    EXPECT_THAT(text.missing, ElementsAre(U'水', U'火'));
    expectMoved(text.outline, textOf(font, "HH"));
    EXPECT_NEAR(text.outline.extent.x, textOf(font, "HH").extent.x, 1e-12);
    EXPECT_TRUE(layOutText(font, "水").outline.loops.empty());
    EXPECT_TRUE(layOutText(font, "").outline.loops.empty());
    EXPECT_TRUE(layOutText(font, " \t\n").missing.empty());
    EXPECT_THROW(layOutText(font, "a\xff"), Error);
}

TEST(Text, OverlappingLettersAreJoined)
{
    // O with an overlapping slash: one body, two holes.
    const Font font = readFont(kSans);
    const Outline struck = textOf(font, "O\u0338");
    EXPECT_EQ(struck.loops.size(), 3U);
    EXPECT_GT(testing::minGap([&] {
                  std::vector<std::vector<Vec2>> loops;
                  for (const Loop& loop : struck.loops) {
                      loops.push_back(loop.points);
                  }
                  return loops;
              }()),
              0.0);
    EXPECT_LT(inkArea(struck), inkArea(glyphOf(font, 'O')) + inkArea(glyphOf(font, U'\u0338')));
}

TEST(Text, IsOneSurface)
{
    const Font font = readFont(kSans);
    DropletOptions options;
    options.mesh.triangles = 3000;
    const Droplet droplet = makeDroplet(layOutText(font, "Water").outline, options);
    const Topology shape = topology(droplet.surface);
    EXPECT_TRUE(shape.closed);
    EXPECT_EQ(shape.components, 5U);
    EXPECT_EQ(shape.euler, 2 * 5 - 2 * 2) << "the holes of a and e";
    // Without gravity the same letters in twice the size have eight times the volume.
    options.solve.gravity = 0.0;
    TextOptions large;
    large.glyph.em *= 2.0;
    const double small_volume = makeDroplet(layOutText(font, "Water").outline, options).total.volume;
    const double large_volume = makeDroplet(layOutText(font, "Water", large).outline, options).total.volume;
    EXPECT_NEAR(large_volume, 8.0 * small_volume, 1e-6 * large_volume);
}

}  // namespace
}  // namespace droplet
