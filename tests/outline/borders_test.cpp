// SPDX-License-Identifier: GPL-3.0-or-later
#include "outline/borders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "support/masks.h"

namespace droplet {
namespace {

constexpr std::uint16_t kLevel = 32768;

/// Random mask with a given share of liquid pixels, grey levels on both sides of the level, and some levels equal to
/// it. std engines are specified by the standard, its distributions are not.
Mask noise(int width, int height, double density, std::uint32_t seed)
{
    std::mt19937 engine(seed);
    const auto word = [&engine] { return static_cast<double>(engine()) / 4294967296.0; };
    Mask mask;
    mask.width = width;
    mask.height = height;
    for (int i = 0; i < width * height; ++i) {
        const bool liquid = word() < density;
        const double depth = word() < 0.2 ? 0.0 : word();
        mask.coverage.push_back(static_cast<std::uint16_t>(liquid ? kLevel + depth * 32767 : 32767 - depth * 32767));
    }
    return mask;
}

bool isLiquid(const Mask& mask, int x, int y)
{
    return x >= 0 && y >= 0 && x < mask.width && y < mask.height && mask.at(x, y) >= kLevel;
}

/// Masks of sizes near the blocks in which rows are read, and masks one pixel wide or high.
std::vector<Mask> awkwardMasks()
{
    std::vector<Mask> masks;
    std::uint32_t seed = 0;
    for (const auto& [width, height] :
         {std::pair{1, 1}, {1, 90}, {90, 1}, {2, 2}, {127, 33}, {128, 32}, {129, 31}, {40, 65}, {256, 20}, {300, 70}}) {
        for (const double density : {0.0, 0.02, 0.3, 0.5, 0.6, 0.98, 1.0}) {
            masks.push_back(noise(width, height, density, ++seed));
        }
    }
    return masks;
}

TEST(Borders, VisitEveryCrossingOnce)
{
    for (const Mask& mask : awkwardMasks()) {
        std::vector<std::array<int, 3>> expected;
        for (int y = 0; y < mask.height; ++y) {
            for (int x = 0; x < mask.width; ++x) {
                for (int direction = 0; direction < 4; ++direction) {
                    const Step d = kSteps[static_cast<std::size_t>(direction)];
                    if (isLiquid(mask, x, y) && !isLiquid(mask, x + d.x, y + d.y)) {
                        expected.push_back({x, y, direction});
                    }
                }
            }
        }
        std::vector<std::array<int, 3>> found;
        for (const Border& border : followBorders(mask, kLevel)) {
            for (const Crossing& at : border) {
                found.push_back({at.x, at.y, at.direction});
            }
        }
        std::sort(expected.begin(), expected.end());
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, expected) << mask.width << " x " << mask.height;
    }
}

TEST(Borders, AreClosedWithLiquidOnTheLeft)
{
    // End of a crossing with its dry pixel on the right: the pixel corner, in half pixels.
    const auto end = [](const Crossing& at, int sign) {
        const Step d = at.toward();
        const Step along = kSteps[static_cast<std::size_t>((at.direction + 1) % 4)];
        return std::pair{2 * at.x + d.x + sign * along.x, 2 * at.y + d.y + sign * along.y};
    };
    for (const Mask& mask : awkwardMasks()) {
        for (const Border& border : followBorders(mask, kLevel)) {
            for (std::size_t i = 0; i < border.size(); ++i) {
                EXPECT_EQ(end(border[i], +1), end(border[(i + 1) % border.size()], -1));
            }
        }
    }
}

// A border begins at its first end of a run of liquid.
TEST(Borders, ComeInReadingOrder)
{
    const auto before = [](const Crossing& a, const Crossing& b) { return std::pair{a.y, a.x} < std::pair{b.y, b.x}; };
    for (const Mask& mask : awkwardMasks()) {
        const std::vector<Border> borders = followBorders(mask, kLevel);
        EXPECT_TRUE(std::is_sorted(borders.begin(), borders.end(),
                                   [&](const Border& a, const Border& b) { return before(a.front(), b.front()); }));
        for (const Border& border : borders) {
            for (const Crossing& at : border) {
                EXPECT_FALSE(at.direction % 2 == 0 && before(at, border.front()));
            }
        }
    }
}

TEST(Borders, AreFoundAroundAPixelAndAHole)
{
    const Mask pixel = testing::drawnMask("...\n.#.\n...");
    EXPECT_EQ(followBorders(pixel, kLevel), (std::vector<Border>{{{1, 1, 2}, {1, 1, 3}, {1, 1, 0}, {1, 1, 1}}}));
    const Mask hole = testing::drawnMask("##\n##");
    EXPECT_EQ(followBorders(hole, kLevel).size(), 1U);
    const std::vector<Border> ring = followBorders(testing::drawnMask("###\n#.#\n###"), kLevel);
    ASSERT_EQ(ring.size(), 2U);
    EXPECT_EQ(ring[1], (Border{{0, 1, 0}, {1, 0, 3}, {2, 1, 2}, {1, 2, 1}}));
}

}  // namespace
}  // namespace droplet
