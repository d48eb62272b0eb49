// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of tinted liquid: white ground below it has the colour that was asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "droplet/render/render.h"
#include "droplet/units.h"
#include "image/rgb.h"
#include "support/colour_difference.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using testing::colourDifference;

// Pairs 1, 7, 11, 17 and 25 of the paper's table 1.
TEST(ColourDifference, IsThatOfThePaper)
{
    EXPECT_NEAR(colourDifference({50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}), 2.0425, 1e-4);
    EXPECT_NEAR(colourDifference({50.0, 0.0, 0.0}, {50.0, -1.0, 2.0}), 2.3669, 1e-4);
    EXPECT_NEAR(colourDifference({50.0, 2.49, -0.001}, {50.0, -2.49, 0.0011}), 7.2195, 1e-4);
    EXPECT_NEAR(colourDifference({50.0, 2.5, 0.0}, {73.0, 25.0, -18.0}), 27.1492, 1e-4);
    EXPECT_NEAR(colourDifference({60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}), 1.2644, 1e-4);
}

// A gentle cap of 20 mm, as of a logo, whose mean height is half of its greatest.
Surface disc()
{
    return testing::roundDroplet({.outer = 10e-3, .height = 3e-3, .rings = 10, .segments = 40});
}

/// Median of every channel over the liquid's pixels: those that a picture of dark matter shows darker than the ground.
Rgb medianOf(const Picture& picture, const std::vector<bool>& is_liquid)
{
    std::array<std::vector<std::uint8_t>, 3> levels;
    for (std::size_t i = 0; i < is_liquid.size(); ++i) {
        for (std::size_t c = 0; c < 3 && is_liquid[i]; ++c) {
            levels[c].push_back(picture.rgb[3 * i + c]);
        }
    }
    Rgb median{};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto middle = levels[c].begin() + static_cast<std::ptrdiff_t>(levels[c].size() / 2);
        std::nth_element(levels[c].begin(), middle, levels[c].end());
        median[c] = *middle;
    }
    return median;
}

/// Pixels where the options show liquid and no ground.
std::vector<bool> pixelsOfLiquid(const Surface& surface, RenderOptions options)
{
    options.look = lookOf(Material::Plain);
    options.lighting = Lighting::Uniform;
    options.look.colour = {};
    const Picture black = render(surface, options);
    std::vector<bool> is_liquid;
    for (std::size_t i = 0; i < black.rgb.size(); i += 3) {
        is_liquid.push_back(black.rgb[i] < 128);
    }
    return is_liquid;
}

Look brandLook(const Rgb& colour)
{
    Look look = lookOf(Material::Water);
    look.colour = linearLight(vectorOf(colour));
    look.tinted = true;
    return look;
}

struct Brand {
    const char* name;
    Rgb colour;
};

constexpr std::array<Brand, 6> kBrands{{{"Telegram", {40, 164, 226}},
                                        {"Spotify", {30, 215, 96}},
                                        {"YouTube", {255, 0, 0}},
                                        {"Facebook", {24, 119, 242}},
                                        {"Twitch", {145, 70, 255}},
                                        {"McDonald's", {255, 199, 44}}}};

// Before, light was thought to pass the liquid once, and Telegram's blue became (3, 84, 192).
TEST(Tint, BrandColoursOnWhiteAreThoseThatWereAskedFor)
{
    const Surface surface = disc();
    for (const View view : {View::ThreeQuarter, View::Top}) {
        for (const bool on_white : {true, false}) {
            RenderOptions options;
            options.width = 48;
            options.height = 36;
            options.samples = 4;
            options.view = view;
            options.extent = {testing::kExtent, testing::kExtent};
            options.light_table = true;
            if (on_white) {
                options.ground = Picture{1, 1, {255, 255, 255}};
            }
            const std::vector<bool> is_liquid = pixelsOfLiquid(surface, options);
            ASSERT_GT(std::count(is_liquid.begin(), is_liquid.end(), true), 300);
            for (const Brand& brand : kBrands) {
                options.look = brandLook(brand.colour);
                const Rgb seen = medianOf(render(surface, options), is_liquid);
                EXPECT_LE(colourDifference(labOf(vectorOf(seen)), labOf(vectorOf(brand.colour))), 10.0)
                    << brand.name << (view == View::Top ? " from above" : "") << (on_white ? "" : " on the table")
                    << ": " << int{seen[0]} << ", " << int{seen[1]} << ", " << int{seen[2]};
            }
        }
    }
}

// A channel of 0 would absorb all light even where the liquid is thin.
TEST(Tint, NoChannelIsBlack)
{
    Look look = lookOf(Material::Water);
    look.colour = {0.0, 0.01, 0.5};
    const Attenuation attenuation = attenuationOf(look, 1e-3);
    EXPECT_EQ(attenuation.colour.x, 0.02);
    EXPECT_EQ(attenuation.colour.y, 0.02);
    EXPECT_EQ(attenuation.colour.z, 0.5);
    EXPECT_EQ(attenuation.distance, 2e-3);
}

}  // namespace
}  // namespace droplet
