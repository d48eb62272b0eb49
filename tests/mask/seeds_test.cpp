// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mask/seeds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <queue>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/mask/mask.h"
#include "support/paths.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using testing::inSource;

/// Grey picture as a file.
std::string greymapOf(int side, const std::function<double(double x, double y)>& level)
{
    std::string bytes = "P5 " + std::to_string(side) + " " + std::to_string(side) + " 255\n";
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            bytes += static_cast<char>(std::lround(std::clamp(level(x + 0.5, y + 0.5), 0.0, 255.0)));
        }
    }
    return bytes;
}

std::span<const std::byte> bytesOf(const std::string& text)
{
    return std::as_bytes(std::span(text));
}

Seeds seedsOf(int side, const std::function<Seed(int x, int y)>& seed)
{
    Seeds seeds{side, side, {}};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            seeds.pixels.push_back(seed(x, y));
        }
    }
    return seeds;
}

double areaOf(const Mask& mask)
{
    double sum = 0.0;
    for (const std::uint16_t level : mask.coverage) {
        sum += static_cast<double>(level) / 65535.0;
    }
    return sum;
}

// A clear droplet: the ground's brightness, but for a thin dark line at its rim, on uneven ground. The dot is off its
// middle and small. No other method finds anything in it.
TEST(Seeds, FindTheRimOfAClearDroplet)
{
    constexpr int kSide = 240;
    constexpr double kRadius = 60.0;
    const std::string photo = greymapOf(kSide, [](double x, double y) {
        const double from_rim = std::hypot(x - 120.0, y - 120.0) - kRadius;
        return 120.0 + 0.2 * x + 5.0 * std::sin(0.3 * x) * std::sin(0.2 * y) -
               60.0 * std::exp(-0.5 * from_rim * from_rim);
    });
    MaskOptions options;
    options.seeds = seedsOf(kSide, [](int x, int y) {
        return std::hypot(x - 105, y - 130) < 6.0 ? Seed::Liquid
               : x == 12 || x == 228 || y == 12   ? Seed::Dry
                                                  : Seed::Open;
    });
    const Mask mask = decodeMask(bytesOf(photo), options);
    EXPECT_EQ(mask.segment, Segmentation::Seeds);
    // The rim is somewhere in the line, which is two pixels wide on either side of its middle.
    const double disc = std::numbers::pi * kRadius * kRadius;
    EXPECT_NEAR(areaOf(mask) / disc, 1.0, 2.0 * 2.0 / kRadius);
    EXPECT_EQ(mask.at(120, 120), 65535);
    EXPECT_EQ(mask.at(20, 20), 0);
    options.seeds.reset();
    EXPECT_GT(std::abs(areaOf(decodeMask(bytesOf(photo), options)) / disc - 1.0), 0.5) << "its line alone";
}

/// Pixels of the region of a mask that a place is in.
std::set<int> regionAt(const Mask& mask, int x, int y)
{
    std::set<int> region;
    std::queue<int> open;
    const auto take = [&](int i, int j) {
        if (i >= 0 && j >= 0 && i < mask.width && j < mask.height && mask.at(i, j) >= 32768 &&
            region.insert(j * mask.width + i).second) {
            open.push(j * mask.width + i);
        }
    };
    for (take(x, y); !open.empty(); open.pop()) {
        const int i = open.front() % mask.width;
        const int j = open.front() / mask.width;
        take(i + 1, j);
        take(i - 1, j);
        take(i, j + 1);
        take(i, j - 1);
    }
    return region;
}

// Drops on a leaf, which the automatic way refuses, beside a mask that was made for this photograph by its colours.
TEST(Seeds, FindDropsOnALeaf)
{
    MaskOptions options;
    options.seeds = readSeeds(inSource("data/raindrops_seeds.png"));
    const Mask found = readMask(inSource("data/raindrops.jpg"), options);
    const Mask known = readMask(inSource("data/raindrops.png"), {});
    double sum = 0.0;
    int count = 0;
    for (const auto& [x, y] : {std::pair{136, 258},
                               {423, 281},
                               {591, 432},
                               {507, 438},
                               {430, 375},
                               {402, 442},
                               {187, 708},
                               {453, 719},
                               {509, 379}}) {
        const std::set<int> a = regionAt(found, x, y);
        const std::set<int> b = regionAt(known, x, y);
        const auto both =
            static_cast<double>(std::count_if(a.begin(), a.end(), [&](int pixel) { return b.find(pixel) != b.end(); }));
        const double share = both / (static_cast<double>(a.size() + b.size()) - both);
        EXPECT_GT(share, 0.4) << x << ' ' << y;
        sum += share;
        ++count;
    }
    EXPECT_GT(sum / count, 0.65) << "common area over that of both";
    EXPECT_EQ(found.at(360, 480), 0) << "the leaf between them";
}

TEST(Seeds, AreLightAndDarkStrokes)
{
    const Seeds grey = decodeSeeds(bytesOf("P5 5 1 255\n" + std::string{'\0', '\x30', '\x7f', '\xc8', '\xff'}));
    EXPECT_EQ(grey.width, 5);
    EXPECT_THAT(grey.pixels, ::testing::ElementsAre(Seed::Dry, Seed::Dry, Seed::Open, Seed::Liquid, Seed::Liquid));
}

TEST(Seeds, RefuseWhatDoesNotFit)
{
    const std::string photo = greymapOf(32, [](double x, double /*y*/) { return 8.0 * x; });
    const auto refused = [&](const Seeds& seeds, const char* reason) {
        MaskOptions options;
        options.seeds = seeds;
        try {
            decodeMask(bytesOf(photo), options);
            ADD_FAILURE() << reason;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            EXPECT_THAT(error.what(), HasSubstr(reason));
        }
    };
    refused(seedsOf(31, [](int, int) { return Seed::Dry; }), "31 x 31 pixels, must be 32 x 32");
    refused(seedsOf(32, [](int, int) { return Seed::Dry; }), "light stroke");
    refused(seedsOf(32, [](int, int) { return Seed::Liquid; }), "dark stroke");
    EXPECT_LT(readSeeds(inSource("data/raindrops_seeds.png")).varied, 0.01);
    for (const char* const photograph : {"data/raindrops.jpg", "data/handprint.jpg", "data/shamrock.webp"}) {
        EXPECT_GT(readSeeds(inSource(photograph)).varied, kVariedSeeds) << photograph;
    }
    EXPECT_EQ(decodeSeeds(bytesOf(greymapOf(32, [](double, double) { return 128.0; }))).varied, 0.0);
    // Strokes everywhere leave nothing to find.
    MaskOptions options;
    options.seeds = seedsOf(32, [](int x, int) { return x < 10 ? Seed::Liquid : Seed::Dry; });
    EXPECT_NEAR(areaOf(decodeMask(bytesOf(photo), options)), 320.0, 1.0);
}

}  // namespace
}  // namespace droplet
