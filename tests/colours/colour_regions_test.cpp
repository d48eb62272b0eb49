// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/colours/colour_regions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "support/colour_pictures.h"

namespace droplet {
namespace {

using testing::Colour;
using ::testing::HasSubstr;
using testing::kBlue;
using testing::kGold;
using testing::kRed;
using testing::kWhite;
using testing::pie;
using testing::pixmap;

ColourRegions regionsOf(const std::string& picture, const ColourOptions& options = {})
{
    return decodeColours(std::as_bytes(std::span(picture)), options);
}

std::set<std::string> paletteOf(const std::vector<PaletteColour>& palette)
{
    std::set<std::string> colours;
    for (const PaletteColour& entry : palette) {
        colours.insert(text(entry.colour));
    }
    return colours;
}

std::set<std::string> paletteOf(const ColourRegions& regions)
{
    return paletteOf(regions.palette);
}

TEST(ColourRegions, BlendsAtRimsAreNoColoursOfTheirOwn)
{
    const ColourRegions regions = regionsOf(pie(120, 50.0));
    EXPECT_EQ(paletteOf(regions), (std::set<std::string>{"#e30613", "#ffcc00", "#0062b8"}));
    ASSERT_TRUE(regions.background);
    EXPECT_EQ(text(*regions.background), "#ffffff");
    std::size_t wet = 0;
    for (const PaletteColour& entry : regions.palette) {
        wet += entry.pixels;
    }
    EXPECT_NEAR(static_cast<double>(wet), std::numbers::pi * 50.0 * 50.0, 40.0);
    EXPECT_EQ(static_cast<std::size_t>(std::count(regions.label.begin(), regions.label.end(), 0)), 120U * 120U - wet);
    EXPECT_TRUE(std::is_sorted(regions.palette.begin(), regions.palette.end(),
                               [](const auto& a, const auto& b) { return a.pixels > b.pixels; }));
}

TEST(ColourRegions, PaletteAloneHasTheSameColours)
{
    const std::string picture = pie(120, 50.0);
    const std::vector<PaletteColour> palette = decodePalette(std::as_bytes(std::span(picture)));
    const ColourRegions regions = regionsOf(picture);
    EXPECT_EQ(paletteOf(palette), paletteOf(regions.palette));
    std::size_t pixels = 0;
    for (const PaletteColour& entry : palette) {
        pixels += entry.pixels;
    }
    EXPECT_NEAR(static_cast<double>(pixels), std::numbers::pi * 50.0 * 50.0, 600.0) << "all but blends";
    const std::string white = pixmap(8, 8, [](Vec2) { return kWhite; });
    EXPECT_TRUE(decodePalette(std::as_bytes(std::span(white))).empty());
}

// The blend of black and white is grey; a grey stripe elsewhere must not claim it.
TEST(ColourRegions, BlendGoesToItsNeighboursThoughItsColourExists)
{
    const std::string picture = pixmap(90, 30, [](Vec2 at) {
        const int level = at.x < 30.5 ? 0 : at.x < 60.0 ? 255 : 128;
        return Colour{level, level, level};
    });
    const ColourRegions regions = regionsOf(picture);
    EXPECT_EQ(paletteOf(regions), (std::set<std::string>{"#000000", "#ffffff", "#808080"}));
    for (int x = 0; x < 90; ++x) {
        const CssColour colour = regions.palette[regions.label[15 * 90 + static_cast<std::size_t>(x)] - 1U].colour;
        const int level = x < 30 ? 0 : x > 30 && x < 60 ? 255 : 128;
        if (x != 30) {
            EXPECT_EQ(colour.red, level) << x;
        } else {
            EXPECT_NE(colour.red, 128);
        }
    }
}

TEST(ColourRegions, ThinLineIsNoBlend)
{
    const std::string picture = pixmap(60, 30, [](Vec2 at) { return at.y > 14.0 && at.y < 15.0 ? kBlue : kGold; });
    const ColourRegions regions = regionsOf(picture, {.channel = Channel::Alpha});
    EXPECT_EQ(paletteOf(regions), (std::set<std::string>{"#ffcc00", "#0062b8"}));
    EXPECT_EQ(regions.palette[1].pixels, 60U);
}

TEST(ColourRegions, BackgroundIsTheBordersColour)
{
    const std::string flag = pixmap(60, 40, [](Vec2 at) { return at.x < 20.0 ? kBlue : at.x < 40.0 ? kWhite : kRed; });
    EXPECT_EQ(regionsOf(flag).palette.size(), 3U) << "no colour has 95 % of its border";
    EXPECT_FALSE(regionsOf(flag).background);
    EXPECT_EQ(regionsOf(flag, {.channel = Channel::Luma}).palette.size(), 2U);
    EXPECT_EQ(regionsOf(pie(60, 25.0), {.channel = Channel::Alpha}).palette.size(), 4U);
}

TEST(ColourRegions, NumberOfColoursMergesTheNearest)
{
    const std::string picture = pixmap(80, 20, [](Vec2 at) {
        return at.x < 20.0 ? Colour{200, 0, 0} : at.x < 40.0 ? Colour{240, 0, 0} : at.x < 60.0 ? kBlue : kWhite;
    });
    const auto count = [&](std::size_t colours) { return regionsOf(picture, {.colours = colours}).palette.size(); };
    EXPECT_EQ(count(4), 4U);
    EXPECT_EQ(count(3), 3U);
    EXPECT_EQ(count(1), 1U);
    EXPECT_EQ(count(20), 4U) << "there are no more";
    const ColourRegions three = regionsOf(picture, {.colours = 3});
    EXPECT_EQ(three.palette.front().pixels, 800U) << "both reds";
}

TEST(ColourRegions, AreTheSameWithAnyNumberOfThreads)
{
    const std::string picture = pie(200, 80.0);
    const auto made = [&](int threads) {
        ColourRegions regions;
        tbb::task_arena(threads).execute([&] { regions = regionsOf(picture); });
        return regions;
    };
    const ColourRegions one = made(1);
    const ColourRegions four = made(4);
    EXPECT_EQ(one.label, four.label);
    EXPECT_EQ(one.is_blend, four.is_blend);
    EXPECT_EQ(paletteOf(one), paletteOf(four));
}

TEST(ColourRegions, RefusesWhatHasNoColours)
{
    EXPECT_THROW(regionsOf(pie(40, 15.0), {.colours = 0}), Error);
    EXPECT_THROW(regionsOf(pie(40, 15.0), {.colours = kMaxColours + 1}), Error);
    try {
        regionsOf(pixmap(20, 20, [](Vec2) { return kRed; }));
        ADD_FAILURE() << "one colour is all background";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_THAT(error.what(), HasSubstr("#e30613"));
    }
    EXPECT_THROW(regionsOf("no picture"), Error);
}

TEST(CssColour, LinearLightIsThatOfSrgb)
{
    EXPECT_EQ(linearLight({0, 255, 0}), (Vec3{0.0, 1.0, 0.0}));
    EXPECT_NEAR(linearLight({188, 0, 0}).x, 0.5, 0.005);
    EXPECT_EQ(fileName({255, 0, 0}), "red");
    EXPECT_EQ(fileName({0xe3, 0x06, 0x13}), "e30613");
}

}  // namespace
}  // namespace droplet
