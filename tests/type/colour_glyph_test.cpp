// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/type/colour_glyph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/type/glyph.h"
#include "support/colour_footprints.h"
#include "support/fonts.h"

namespace droplet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::outerEdges;

constexpr double kUnits = 1024.0 * 1024.0;  // per em²

Font colourFont(std::size_t palette = 0)
{
    return readFont(testing::colourFont(), {0, {}, palette});
}

GlyphOptions inEms()
{
    GlyphOptions options;
    options.em = 1.0;
    return options;
}

ColourLayout coloursOf(char32_t character, std::size_t palette = 0)
{
    const Font font = colourFont(palette);
    return glyphColours(font, font.glyphOf(character).value(), inEms());
}

/// Areas by colour [units of the font].
std::map<std::string, double> areasOf(const ColourLayout& layout)
{
    std::map<std::string, double> areas;
    for (const ColourArea& each : layout.drawing.areas) {
        areas[text(each.colour)] = kUnits * area(each);
    }
    return areas;
}

using Areas = std::map<std::string, double>;

void expectAreas(const ColourLayout& layout, const Areas& expected, double tolerance = 0.01)
{
    const Areas areas = areasOf(layout);
    ASSERT_EQ(areas.size(), expected.size()) << ::testing::PrintToString(areas);
    for (const auto& [colour, size] : expected) {
        ASSERT_EQ(areas.count(colour), 1U) << ::testing::PrintToString(areas);
        EXPECT_NEAR(areas.at(colour), size, tolerance) << colour;
    }
}

// Squares of 512 and 256 units, which share 128 × 256.
constexpr double kSquare = 512.0 * 512.0;
constexpr double kCorner = 256.0 * 256.0;
constexpr double kShared = 128.0 * 256.0;

TEST(ColourGlyph, UpperLayersCoverLowerOnes)
{
    const ColourLayout layout = coloursOf('O');
    EXPECT_TRUE(layout.has_layers);
    expectAreas(layout, {{"#ff0000", kSquare - kShared}, {"#0066cc", kCorner}});
    expectAreas(coloursOf('H'), {{"#ff0000", kSquare}});
}

TEST(ColourGlyph, CurvesHaveTheirAreas)
{
    const double disc = 4.0 * 200.0 * 200.0 * 5.0 / 6.0;  // a sixth is cut off by the parabolas
    expectAreas(coloursOf('C'), {{"#ff0000", disc}, {"#ffcc00", kSquare - disc}}, 1e-3 * disc);
}

TEST(ColourGlyph, ColoursAreThoseOfThePalette)
{
    expectAreas(coloursOf('O', 1), {{"#009933", kSquare - kShared}, {"#666666", kCorner}});
    const auto refused = [](std::size_t palette, const char* path) {
        try {
            readFont(path, {0, {}, palette});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            return std::string(error.what());
        }
        return std::string("nothing was thrown");
    };
    EXPECT_THAT(refused(2, testing::colourFont().c_str()),
                HasSubstr("palette 2 does not exist: the font has palettes 0 to 1"));
    EXPECT_THAT(refused(1, testing::kSans), HasSubstr("palette 1 does not exist: the font has no palettes"));
}

TEST(ColourGlyph, TranslucentLayerBlendsWithWhatIsBelow)
{
    // Half transparent blue on white, the colour of the text, and on nothing.
    expectAreas(coloursOf('T'), {{"#ffffff", kSquare - kShared}, {"#7fb2e5", kShared}, {"#0066cc", kCorner - kShared}});
    const Font font = colourFont();
    GlyphOptions options = inEms();
    options.text_colour = {0, 0, 0};
    expectAreas(glyphColours(font, font.glyphOf('T').value(), options),
                {{"#000000", kSquare - kShared}, {"#003366", kShared}, {"#0066cc", kCorner - kShared}});
}

// The upper layer begins two units within the lower one.
TEST(ColourGlyph, HairlineBelongsToTheUpperLayer)
{
    expectAreas(coloursOf('L'), {{"#0066cc", kSquare}});
}

TEST(ColourGlyph, LayersOfOneColourAreOneArea)
{
    expectAreas(coloursOf('S'), {{"#ff0000", kSquare + kCorner}});
}

TEST(ColourGlyph, GlyphWithoutLayersHasTheColourOfTheText)
{
    const Font font = colourFont();
    const GlyphId plain = font.glyphOf('P').value();
    EXPECT_FALSE(hasColourLayers(font, plain));
    const ColourLayout layout = glyphColours(font, plain, inEms());
    EXPECT_FALSE(layout.has_layers);
    const Outline outline = glyphOutline(font, plain, inEms());
    expectAreas(layout, {{"#ffffff", kUnits * signedArea(outline.loops.at(0))}});
    EXPECT_EQ(layout.drawing.extent, outline.extent);
    EXPECT_TRUE(coloursOf('0').has_layers);
    EXPECT_TRUE(coloursOf('0').drawing.areas.empty());
}

TEST(ColourGlyph, ExtentIsThatOfTheOutline)
{
    const Font font = colourFont();
    for (const char* line : {"O", "OPC", "C\nO"}) {
        TextOptions options;
        const ColourLayout colours = layOutColours(font, line, options);
        EXPECT_EQ(colours.drawing.extent, layOutText(font, line, options).outline.extent) << line;
    }
}

TEST(ColourGlyph, TextHasTheAreasOfItsGlyphs)
{
    const Font font = colourFont();
    const ColourLayout layout = layOutColours(font, "OO\nOx", {inEms()});
    EXPECT_EQ(layout.lines, 2U);
    EXPECT_EQ(layout.missing, std::vector<char32_t>{'x'});
    expectAreas(layout, {{"#ff0000", 3.0 * (kSquare - kShared)}, {"#0066cc", 3.0 * kCorner}});
}

TEST(ColourGlyph, RefusesGraphsOfPaintsByName)
{
    const Font font = colourFont();
    try {
        hasColourLayers(font, font.glyphOf('1').value());
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_THAT(error.what(), AllOf(HasSubstr("('gradient')"), HasSubstr("COLR version 1")));
    }
}

TEST(ColourGlyph, FontTellsWhereItsColoursAre)
{
    EXPECT_TRUE(colourFont().hasColourLayers());
    EXPECT_EQ(colourFont().otherColours(), "");
    EXPECT_FALSE(readFont(testing::kSans).hasColourLayers());
}

// From the font to droplets: areas, common boundaries, volumes.
TEST(ColourGlyph, DropletsHaveTheAreasOfTheLayersAndCommonBoundaries)
{
    const Font font = colourFont();
    GlyphOptions options;
    const ColourLayout layout = glyphColours(font, font.glyphOf('O').value(), options);
    const ColourRegions regions = drawColours(layout.drawing);
    ColourDomain traced = testing::tracedAt(regions, *regions.physical_width, 3e-4);
    ASSERT_EQ(traced.domain.droplets.size(), 2U);
    const double unit = options.em * options.em / kUnits;
    EXPECT_NEAR(area(traced.domain.droplets[0]), unit * (kSquare - kShared), 1e-4 * unit * kSquare);
    EXPECT_NEAR(area(traced.domain.droplets[1]), unit * kCorner, 1e-4 * unit * kCorner);

    double shared = rimLength(traced.domain.droplets[0]) + rimLength(traced.domain.droplets[1]);
    for (const auto& [ax, ay, bx, by] : outerEdges(traced)) {
        shared -= length(Vec2{bx - ax, by - ay});
    }
    const double boundary = (128.0 + 256.0) / 1024.0 * options.em;
    EXPECT_NEAR(shared, 2.0 * boundary, 0.01 * boundary) << "the boundary is in both rims, bit for bit";

    DropletOptions droplet_options;
    droplet_options.mesh.triangles = 3000;
    const Droplet droplet = makeDroplet(std::move(traced.domain), droplet_options);
    double volume = 0.0;
    for (const ShapeFigures& figures : droplet.figures) {
        volume += figures.volume;
    }
    EXPECT_NEAR(volume, droplet.total.volume, 1e-12 * volume);
    EXPECT_TRUE(topology(droplet.surface).closed);
    EXPECT_EQ(topology(droplet.surface).components, 2U);
}

}  // namespace
}  // namespace droplet
