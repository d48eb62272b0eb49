// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield/still_droplets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "windshield/windshields.h"

namespace droplet {
namespace {

using testing::uniform;

constexpr Vec2 kSize{0.103, 0.058};  // not a whole number of cells

/// Droplets after rain and tracks: placed, joined, and some removed again.
StillCells weathered(std::mt19937_64& bits)
{
    const StillRules rules{1.2, 1e-10};
    StillCells still = StillCells::over(kSize);
    for (int k = 0; k < 1500; ++k) {
        const Vec2 place{uniform(bits, 0.0, kSize.x), uniform(bits, 0.0, kSize.y)};
        std::optional<StillDroplet> drop = StillDroplet{place, uniform(bits, 1e-12, 1e-11)};
        while (drop && drop->volume < rules.max) {
            drop = placeOrJoin(still, *drop, rules);
        }
        if (k % 20 == 0) {
            StillRemoval removal(still);
            const std::size_t cell = bits() % still.counts.size();
            for (std::uint8_t slot = 0; slot < still.counts[cell]; slot += 2) {
                removal.take({cell, slot});
            }
            removal.close();
        }
    }
    return still;
}

TEST(StillDroplets, AreInTheCellsOfTheirPositions)
{
    std::mt19937_64 bits(7);
    const StillCells still = weathered(bits);
    StillDroplets value;
    StillCells::of(value) = still;
    ASSERT_GT(value.count(), 200U);
    const double part = still.cell / kPlaces;
    for (std::size_t cell = 0; cell < still.counts.size(); ++cell) {
        for (std::size_t k = 0; k < StillCells::kMax; ++k) {
            const std::size_t slot = cell * StillCells::kMax + k;
            const StillDroplet& d = still.slots[slot];
            if (k >= still.counts[cell]) {
                EXPECT_EQ(d, StillDroplet{});
                EXPECT_EQ(still.places[slot], 0);
                continue;
            }
            const Vec2 corner{still.cell * static_cast<double>(cell % still.columns),
                              still.cell * static_cast<double>(cell / still.columns)};
            EXPECT_NEAR(d.position.x, corner.x + part * (still.places[slot] % kPlaces + 0.5), 0.5001 * part);
            EXPECT_NEAR(d.position.y, corner.y + part * (still.places[slot] / kPlaces + 0.5), 0.5001 * part);
        }
    }
}

TEST(StillDroplets, CopiesAreIndependent)
{
    std::mt19937_64 bits(3);
    StillDroplets still;
    EXPECT_EQ(still.count(), 0U);
    EXPECT_EQ(still, StillDroplets());
    StillCells::of(still) = weathered(bits);
    const std::vector<StillDroplet> all = still.all();
    EXPECT_EQ(all.size(), still.count());
    StillDroplets copy = still;
    EXPECT_EQ(copy, still);
    StillCells& cells = StillCells::of(copy);
    StillRemoval removal(cells);
    const auto first = std::find_if(cells.counts.begin(), cells.counts.end(), [](std::uint8_t n) { return n > 0; });
    EXPECT_EQ(removal.take({static_cast<std::size_t>(first - cells.counts.begin()), 0}), all.front().volume);
    removal.close();
    EXPECT_NE(copy, still);
    EXPECT_EQ(copy.all(), std::vector<StillDroplet>(all.begin() + 1, all.end()));
    EXPECT_EQ(still.all(), all) << "copies share nothing";
    still = std::move(copy);
    EXPECT_EQ(still.count() + 1, all.size());
}

TEST(StillDroplets, VisitNearVisitsAllNearASegmentOnce)
{
    std::mt19937_64 bits(11);
    const StillCells still = weathered(bits);
    std::size_t visited = 0;
    std::size_t near = 0;
    for (int k = 0; k < 400; ++k) {
        // Segments also begin and end off the glass; one in four is a point.
        const Vec2 a{uniform(bits, -0.01, kSize.x + 0.01), uniform(bits, -0.01, kSize.y + 0.01)};
        const Vec2 b =
            k % 4 == 0 ? a : a + Vec2{uniform(bits, -0.03, 0.03), k % 4 == 1 ? 0.0 : uniform(bits, -0.03, 0.03)};
        const double radius = uniform(bits, 0.0, 0.006);
        std::set<std::pair<std::size_t, int>> found;
        visitNear(still, a, b, radius, [&](StillSlot slot) {
            EXPECT_TRUE(found.insert({slot.cell, slot.slot}).second);
            EXPECT_LE(std::sqrt(Segment(a, b).squaredDistance(at(still, slot).position)),
                      radius + 1.5 * still.cell / kPlaces);
        });
        visited += found.size();
        for (std::size_t cell = 0; cell < still.counts.size(); ++cell) {
            for (int slot = 0; slot < still.counts[cell]; ++slot) {
                const Vec2 p = still.droplets(cell)[static_cast<std::size_t>(slot)].position;
                if (Segment(a, b).squaredDistance(p) <= radius * radius) {
                    ++near;
                    EXPECT_TRUE(found.contains({cell, slot}));
                }
            }
        }
    }
    EXPECT_GT(near, 2000U);
    EXPECT_LT(visited, near + near / 20);
}

}  // namespace
}  // namespace droplet
