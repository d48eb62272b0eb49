// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/morph/morph_targets.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "droplet/error.h"
#include "liquid2d/near_points.h"
#include "liquid2d/region.h"

namespace {

using droplet::assignTargets;
using droplet::Region;
using droplet::sampleRegion;
using droplet::Vec2;
using testing::HasSubstr;
using testing::ThrowsMessage;

Region ring()
{
    Region region = droplet::circle({0.5, 0.5}, 0.5);
    region.loops.push_back(droplet::circle({0.5, 0.5}, 0.2).loops[0]);
    return region;
}

/// Two bars and a thin bridge.
Region letter()
{
    return {{{{2, 0},
              {2.3, 0},
              {2.3, 0.45},
              {2.7, 0.45},
              {2.7, 0},
              {3, 0},
              {3, 1},
              {2.7, 1},
              {2.7, 0.55},
              {2.3, 0.55},
              {2.3, 1},
              {2, 1}}}};
}

double cost(const std::vector<Vec2>& sources, const std::vector<Vec2>& targets,
            const std::vector<std::uint32_t>& partner)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const Vec2 way = targets[partner[i]] - sources[i];
        sum += droplet::dot(way, way);
    }
    return sum;
}

/// Least cost, by the Hungarian method with potentials.
double leastCost(const std::vector<Vec2>& sources, const std::vector<Vec2>& targets)
{
    const std::size_t n = sources.size();
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::vector<double> u(n + 1);
    std::vector<double> v(n + 1);
    std::vector<std::size_t> match(n + 1);
    std::vector<std::size_t> way(n + 1);
    for (std::size_t i = 1; i <= n; ++i) {
        match[0] = i;
        std::size_t column = 0;
        std::vector<double> least(n + 1, kFar);
        std::vector<bool> used(n + 1);
        do {
            used[column] = true;
            const std::size_t row = match[column];
            double delta = kFar;
            std::size_t next = 0;
            for (std::size_t j = 1; j <= n; ++j) {
                if (used[j]) {
                    continue;
                }
                const Vec2 d = targets[j - 1] - sources[row - 1];
                const double reduced = droplet::dot(d, d) - u[row] - v[j];
                if (reduced < least[j]) {
                    least[j] = reduced;
                    way[j] = column;
                }
                if (least[j] < delta) {
                    delta = least[j];
                    next = j;
                }
            }
            for (std::size_t j = 0; j <= n; ++j) {
                if (used[j]) {
                    u[match[j]] += delta;
                    v[j] -= delta;
                } else {
                    least[j] -= delta;
                }
            }
            column = next;
        } while (match[column] != 0);
        for (; column != 0; column = way[column]) {
            match[column] = match[way[column]];
        }
    }
    return -v[0];
}

void expectPermutation(std::vector<std::uint32_t> partner)
{
    std::sort(partner.begin(), partner.end());
    for (std::size_t i = 0; i < partner.size(); ++i) {
        ASSERT_EQ(partner[i], i);
    }
}

TEST(SampleRegion, GivesExactlySoManySpreadPointsInside)
{
    for (const Region& region : {ring(), letter(), droplet::rectangle({0, 0}, {10, 0.02})}) {
        for (const std::size_t count : {1U, 2U, 7U, 500U, 3001U}) {
            const std::vector<Vec2> points = sampleRegion(region, count);
            ASSERT_EQ(points.size(), count);
            EXPECT_TRUE(
                std::all_of(points.begin(), points.end(), [&](Vec2 p) { return droplet::contains(region, p); }));
            EXPECT_EQ(points, sampleRegion(region, count));
        }
    }
    const std::vector<Vec2> points = sampleRegion(ring(), 2000);
    const double spacing = std::sqrt(droplet::momentsOf(ring()).area / 2000.0);
    const droplet::NearPoints near(points);
    for (const Vec2 point : points) {
        const double distance = std::sqrt(near.nearest(point, 2)[1].squared);
        EXPECT_GT(distance, 0.6 * spacing);
        EXPECT_LT(distance, 1.4 * spacing);
    }
    EXPECT_THAT([] { sampleRegion({}, 4); }, ThrowsMessage<droplet::Error>(HasSubstr("region.area is 0")));
}

TEST(AssignTargets, IsNearTheLeastCost)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<Vec2> scattered(200);
    for (Vec2& point : scattered) {
        point = {uniform(random), uniform(random)};
    }
    const std::vector<std::vector<Vec2>> sets{sampleRegion(ring(), 200), sampleRegion(letter(), 200), scattered,
                                              sampleRegion(droplet::rectangle({0, 0}, {2, 0.3}), 200)};
    for (std::size_t a = 0; a < sets.size(); ++a) {
        for (std::size_t b = 0; b < sets.size(); ++b) {
            if (a == b) {
                continue;
            }
            const auto partner = assignTargets(sets[a], sets[b]);
            expectPermutation(partner);
            // A common shift costs the same for all pairs, so it is left out of the comparison.
            const auto centred = [](std::vector<Vec2> points) {
                Vec2 sum;
                for (const Vec2 p : points) {
                    sum = sum + p;
                }
                for (Vec2& p : points) {
                    p = p - 1.0 / static_cast<double>(points.size()) * sum;
                }
                return points;
            };
            const auto from = centred(sets[a]);
            const auto to = centred(sets[b]);
            const double ratio = cost(from, to, partner) / std::max(leastCost(from, to), 1e-12);
            EXPECT_LT(ratio, 1.05) << a << " to " << b;
        }
    }
}

TEST(AssignTargets, FindsATranslationExactly)
{
    for (const Region& region : {ring(), letter(), droplet::rectangle({0, 0}, {1, 1})}) {
        const std::vector<Vec2> sources = sampleRegion(region, 4000);
        std::vector<std::uint32_t> shuffled(sources.size());
        std::iota(shuffled.begin(), shuffled.end(), 0U);
        std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(3));
        std::vector<Vec2> targets(sources.size());
        for (std::size_t i = 0; i < sources.size(); ++i) {
            targets[shuffled[i]] = sources[i] + Vec2{3.7, -1.9};
        }
        EXPECT_EQ(assignTargets(sources, targets), shuffled);
    }
}

TEST(AssignTargets, TakesOddInputs)
{
    EXPECT_TRUE(assignTargets({}, {}).empty());
    EXPECT_EQ(assignTargets({{1, 2}}, {{3, 4}}), std::vector<std::uint32_t>{0});
    expectPermutation(assignTargets(std::vector<Vec2>(1000), std::vector<Vec2>(1000, {1, 1})));
    EXPECT_THAT([] { assignTargets({{1, 2}}, {}); }, ThrowsMessage<droplet::Error>(HasSubstr("targets.size() is 0")));
}

TEST(AssignTargets, IsTheSameAtAnyNumberOfThreads)
{
    const std::vector<Vec2> sources = sampleRegion(ring(), 8000);
    const std::vector<Vec2> targets = sampleRegion(letter(), 8000);
    const auto partner = assignTargets(sources, targets);
    expectPermutation(partner);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(assignTargets(sources, targets), partner);
}

}  // namespace
