// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "drawing/lettering.h"
#include "droplet/error.h"

namespace droplet {
namespace {

Picture plain(int width, int height, std::array<std::uint8_t, 3> colour)
{
    Picture picture{width, height, {}};
    for (int i = 0; i < width * height; ++i) {
        picture.rgb.insert(picture.rgb.end(), colour.begin(), colour.end());
    }
    return picture;
}

std::size_t pixelsOf(const Picture& picture, std::array<std::uint8_t, 3> colour)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
        count += std::equal(colour.begin(), colour.end(), picture.rgb.begin() + static_cast<std::ptrdiff_t>(i)) ? 1 : 0;
    }
    return count;
}

constexpr std::array<std::uint8_t, 3> kRed = {200, 30, 40};
constexpr std::array<std::uint8_t, 3> kBlue = {20, 60, 210};

TEST(ContactSheet, ShowsEveryTileWhole)
{
    const ContactSheetOptions options{.columns = 2, .tile_width = 80, .tile_height = 60};
    const Picture sheet = contactSheet({{plain(80, 60, kRed), "one"}, {plain(40, 20, kBlue), "two"}}, options);
    sheet.validate();
    EXPECT_EQ(pixelsOf(sheet, kRed), 80U * 60U);
    EXPECT_EQ(pixelsOf(sheet, kBlue), 40U * 20U) << "small pictures are not enlarged";
    // Large pictures keep their aspect, and a plain colour does not change.
    EXPECT_EQ(pixelsOf(contactSheet({{plain(333, 111, kRed), ""}}, options), kRed), 80U * 27U);
}

TEST(ContactSheet, PicturesOfTileSizeAreNotShrunk)
{
    for (const int max : {8192, 300}) {
        const ContactSheetOptions options{.tile_width = 100, .tile_height = 75, .max_side = max};
        constexpr std::size_t kTiles = 12;
        const TileSize size = tileSize(kTiles, options);
        EXPECT_EQ(size.width == 100, max == 8192);
        const Picture sheet =
            contactSheet(std::vector<Tile>(kTiles, {plain(size.width, size.height, kRed), ""}), options);
        EXPECT_EQ(pixelsOf(sheet, kRed), kTiles * static_cast<std::size_t>(size.width * size.height));
    }
}

TEST(ContactSheet, FillsRowsInTheOrderGiven)
{
    const ContactSheetOptions options{.columns = 1, .tile_width = 32, .tile_height = 32};
    const Picture sheet = contactSheet({{plain(32, 32, kRed), ""}, {plain(32, 32, kBlue), ""}}, options);
    const auto first = [&](std::array<std::uint8_t, 3> colour) {
        return std::search(sheet.rgb.begin(), sheet.rgb.end(), colour.begin(), colour.end());
    };
    EXPECT_LT(first(kRed), first(kBlue));
}

TEST(ContactSheet, CaptionsAreDrawn)
{
    const auto sheet = [](const std::string& caption) { return contactSheet({{plain(100, 80, kRed), caption}}); };
    EXPECT_NE(sheet("a"), sheet("b"));
    EXPECT_EQ(sheet("a"), sheet("a"));
    EXPECT_EQ(sheet("a").width, sheet(std::string(3000, 'w')).width);
    EXPECT_EQ(sheet("\u4e00"), sheet("?")) << "what cannot be drawn";
    EXPECT_EQ(sheet("\xff"), sheet("?")) << "what is no UTF-8";
}

TEST(ContactSheet, StaysWithinItsSize)
{
    const std::vector<Tile> many(6000, {plain(20, 16, kRed), "x"});
    const Picture sheet = contactSheet(many);
    EXPECT_LE(std::max(sheet.width, sheet.height), 8192);
    EXPECT_NEAR(static_cast<double>(sheet.width) / sheet.height, 4.0 / 3.0, 0.1);
    EXPECT_THROW(contactSheet(many, {.max_side = 256}), Error);
    EXPECT_LE(contactSheet({many.begin(), many.begin() + 50}, {.max_side = 300}).height, 300);
}

TEST(ContactSheet, RefusesImpossibleLayouts)
{
    EXPECT_THROW(contactSheet({}), Error);
    EXPECT_THROW(contactSheet({{Picture{}, ""}}), Error);
    const std::vector<Tile> one = {{plain(4, 4, kRed), ""}};
    for (const ContactSheetOptions& wrong :
         {ContactSheetOptions{.columns = 0}, {.tile_width = 15}, {.tile_height = 5000}, {.max_side = 100}}) {
        EXPECT_THROW(contactSheet(one, wrong), Error);
    }
}

TEST(Lettering, WidthsAddUpAndScale)
{
    EXPECT_EQ(textWidth("", 12.0), 0.0);
    EXPECT_GT(textWidth("mm", 12.0), 2.0 * textWidth("m", 12.0));
    EXPECT_DOUBLE_EQ(textWidth("0.5 mm", 24.0), 2.0 * textWidth("0.5 mm", 12.0));
    EXPECT_EQ(fitted("abc", 12.0, 1000.0), "abc");
    EXPECT_LE(textWidth(fitted("a long caption", 12.0, 60.0), 12.0), 60.0);
    EXPECT_EQ(fitted("abc", 12.0, 1.0), "");
    EXPECT_EQ(fitted("abcdef", 12.0, textWidth("abc...", 12.0)), "abc...");
    EXPECT_EQ(fitted("\u00b0\u00b0\u00b0\u00b0\u00b0", 12.0, textWidth("\u00b0...", 12.0)), "\u00b0...");
}

// Every printable character leaves ink, all differ, and none draws beyond the picture.
TEST(Lettering, CharactersDiffer)
{
    std::vector<Picture> drawn;
    for (char c = '!'; c <= '~'; ++c) {
        Picture picture = plain(24, 32, {255, 255, 255});
        drawText(picture, std::string(1, c), {4.0, 24.0}, {.size = 16.0});
        EXPECT_LT(pixelsOf(picture, {255, 255, 255}), 24U * 32U) << c;
        for (const Picture& other : drawn) {
            EXPECT_NE(picture, other) << c;
        }
        drawn.push_back(std::move(picture));
    }
    Picture tiny = plain(3, 3, kRed);
    for (const Vec2 at : {Vec2{-500.0, -500.0}, Vec2{-5.0, 2.0}, Vec2{1.0, 1.0}, Vec2{500.0, 3.0}, Vec2{1.0, 900.0}}) {
        drawText(tiny, "Water 40°", at, {.size = 40.0});
    }
    tiny.validate();
}

}  // namespace
}  // namespace droplet
