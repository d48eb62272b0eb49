// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield/tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "windshield/segment.h"
#include "windshield/windshields.h"

namespace droplet {
namespace {

using testing::uniform;

constexpr Vec2 kSize{0.12, 0.08};

/// Tracks of all directions and lengths, some of them beyond the edges.
Tracks randomTracks(std::mt19937_64& bits, int count, double longest)
{
    Tracks tracks;
    for (int k = 0; k < count; ++k) {
        const Vec2 from{uniform(bits, 0.0, kSize.x), uniform(bits, 0.0, kSize.y)};
        const Vec2 way{uniform(bits, -longest, longest), uniform(bits, -longest, longest)};
        tracks.add(from, k % 5 == 0 ? from : from + way, uniform(bits, 0.2e-3, 3e-3));
    }
    return tracks;
}

TEST(TrackCells, FindTheFirstTrackThatIsTouched)
{
    std::mt19937_64 bits(7);
    for (const double longest : {1e-3, 5e-3, 40e-3}) {
        const Tracks tracks = randomTracks(bits, 200, longest);
        const TrackCells cells(tracks, kSize);
        int touched = 0;
        for (int trial = 0; trial < 2000; ++trial) {
            const Vec2 place{uniform(bits, 0.0, kSize.x), uniform(bits, 0.0, kSize.y)};
            const double reach = uniform(bits, 0.1e-3, 2e-3);
            std::optional<std::uint32_t> first;
            for (std::uint32_t i = 0; i < tracks.count() && !first; ++i) {
                const double touching = reach + tracks.reach[i];
                if (Segment(tracks.from[i], tracks.to[i]).squaredDistance(place) <= touching * touching) {
                    first = i;
                }
            }
            touched += first ? 1 : 0;
            ASSERT_EQ(cells.touchedBy(place, reach), first);
        }
        EXPECT_GT(touched, 100);
        EXPECT_LT(touched, 2000);
    }
}

TEST(TrackCells, FindAllPairsThatTouchOnTheGlass)
{
    std::mt19937_64 bits(8);
    for (const double longest : {1e-3, 5e-3, 40e-3}) {
        Tracks tracks = randomTracks(bits, 90, longest);
        for (Vec2& to : tracks.to) {
            to = {std::clamp(to.x, 0.0, kSize.x), std::clamp(to.y, 0.0, kSize.y)};
        }
        std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
        for (std::uint32_t a = 0; a < tracks.count(); ++a) {
            for (std::uint32_t b = a + 1; b < tracks.count(); ++b) {
                // The smallest distance at many times of the step, as an upper bound.
                double least = 1.0;
                for (int k = 0; k <= 1000; ++k) {
                    const double s = 1e-3 * k;
                    const Vec2 apart =
                        (1.0 - s) * (tracks.from[a] - tracks.from[b]) + s * (tracks.to[a] - tracks.to[b]);
                    least = std::min(least, length(apart));
                }
                if (least <= tracks.reach[a] + tracks.reach[b]) {
                    expected.emplace_back(a, b);
                }
            }
        }
        auto found = TrackCells(tracks, kSize).touchingPairs();
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
        // Others touch between those times, by next to nothing.
        EXPECT_LE(found.size(), expected.size() + 2);
        EXPECT_GT(expected.size(), 10U);
    }
}

}  // namespace
}  // namespace droplet
