// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/lattice_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "mesh/lattice_core.h"
#include "mesh/lattice_grid.h"

namespace droplet {

// Beside the types, where comparisons in standard containers find it.
static bool operator==(const Site& a, const Site& b)
{
    return a.row == b.row && a.column == b.column;
}

namespace {

using Row = LatticeRegion::Row;
using Columns = std::set<std::int32_t>;
using Points = std::set<std::pair<std::int32_t, std::int32_t>>;  // row, column
using Polygons = std::vector<std::vector<Vec2>>;

Columns columnsOf(const Row& row)
{
    Columns columns;
    for (const ColumnInterval& i : row) {
        for (std::int32_t c = i.begin; c < i.end; ++c) {
            columns.insert(c);
        }
    }
    return columns;
}

Row rowOf(const Columns& columns)
{
    Row row;
    for (const std::int32_t c : columns) {
        if (row.empty() || row.back().end != c) {
            row.push_back({c, c});
        }
        row.back().end = c + 1;
    }
    return row;
}

Points pointsOf(const LatticeRegion& region)
{
    Points points;
    for (std::int32_t r = region.firstRow(); r < region.endRow(); ++r) {
        for (const std::int32_t c : columnsOf(region.row(r))) {
            points.emplace(r, c);
        }
    }
    return points;
}

/// Intervals not empty, ascending, with gaps between.
bool isNormal(const Row& row)
{
    for (std::size_t k = 0; k < row.size(); ++k) {
        if (row[k].begin >= row[k].end || (k > 0 && row[k].begin <= row[k - 1].end)) {
            return false;
        }
    }
    return true;
}

/// Columns around zero, each there with a probability of its own kind: gaps of one, full rows and empty ones occur.
Columns randomColumns(std::mt19937& random)
{
    std::bernoulli_distribution there(std::uniform_real_distribution<double>(0.0, 1.0)(random));
    Columns columns;
    for (std::int32_t c = -9; c < 10; ++c) {
        if (there(random)) {
            columns.insert(c);
        }
    }
    return columns;
}

LatticeRegion randomRegion(std::mt19937& random)
{
    const auto first = std::uniform_int_distribution<std::int32_t>(-6, 3)(random);
    std::vector<Row> rows;
    for (int k = std::uniform_int_distribution<int>(0, 8)(random); k > 0; --k) {
        rows.push_back(rowOf(randomColumns(random)));
    }
    return {first, std::move(rows)};
}

TEST(LatticeRegion, RowsObeyTheAlgebraOfSets)
{
    std::mt19937 random(1);
    for (int round = 0; round < 2000; ++round) {
        const Columns a = randomColumns(random);
        const Columns b = randomColumns(random);
        Columns difference;
        std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(difference, difference.end()));
        Columns intersection;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::inserter(intersection, intersection.end()));
        const Row less = minus(rowOf(a), rowOf(b));
        const Row both = common(rowOf(a), rowOf(b));
        ASSERT_EQ(columnsOf(less), difference);
        ASSERT_EQ(columnsOf(both), intersection);
        ASSERT_TRUE(isNormal(less) && isNormal(both));

        const std::int32_t by = std::uniform_int_distribution<std::int32_t>(-5, 5)(random);
        const std::int32_t shorter = std::uniform_int_distribution<std::int32_t>(0, 3)(random);
        Columns moved;
        for (const std::int32_t c : a) {
            bool stays = true;
            for (std::int32_t k = 1; k <= shorter; ++k) {
                stays = stays && a.contains(c + k);
            }
            if (stays) {
                moved.insert(c + by);
            }
        }
        const Row found = shifted(rowOf(a), by, shorter);
        ASSERT_EQ(columnsOf(found), moved);
        ASSERT_TRUE(isNormal(found));
    }
}

TEST(LatticeRegion, UnitedIntervalsMayOverlapTouchAndComeInAnyOrder)
{
    std::mt19937 random(2);
    for (int round = 0; round < 2000; ++round) {
        Row intervals;
        Columns all;
        for (int k = std::uniform_int_distribution<int>(0, 6)(random); k > 0; --k) {
            const std::int32_t begin = std::uniform_int_distribution<std::int32_t>(-20, 20)(random);
            const std::int32_t end = begin + std::uniform_int_distribution<std::int32_t>(1, 8)(random);
            intervals.push_back({begin, end});
            all.merge(columnsOf({{begin, end}}));
        }
        const Row found = united(intervals);
        ASSERT_EQ(columnsOf(found), all);
        ASSERT_TRUE(isNormal(found));
    }
}

TEST(LatticeRegion, KnowsItsPoints)
{
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round) {
        const LatticeRegion region = randomRegion(random);
        const Points points = pointsOf(region);
        ASSERT_EQ(region.size(), points.size());
        for (std::int32_t r = region.firstRow() - 2; r < region.endRow() + 2; ++r) {
            for (std::int32_t c = -12; c < 13; ++c) {
                ASSERT_EQ(region.contains(r, c), points.contains({r, c}));
            }
        }
        EXPECT_TRUE(region.row(region.firstRow() - 1).empty());
        EXPECT_TRUE(region.row(region.endRow()).empty());
    }
}

TEST(LatticeRegion, ErodedPointsHaveAllTheirNeighbours)
{
    std::mt19937 random(4);
    std::size_t left = 0;
    for (int round = 0; round < 500; ++round) {
        const LatticeRegion region = randomRegion(random);
        const Points points = pointsOf(region);
        Points wanted;
        for (const auto& [r, c] : points) {
            const std::array<Site, 6> around = neighboursOf({r, c});
            if (std::all_of(around.begin(), around.end(), [&](Site s) { return points.contains({s.row, s.column}); })) {
                wanted.emplace(r, c);
            }
        }
        const LatticeRegion found = eroded(region);
        ASSERT_EQ(pointsOf(found), wanted);
        for (std::int32_t r = found.firstRow(); r < found.endRow(); ++r) {
            ASSERT_TRUE(isNormal(found.row(r)));
        }
        left += wanted.size();
    }
    EXPECT_GT(left, 500U);
}

TEST(LatticeRegion, TrianglesAreTriplesOfNeighbours)
{
    std::mt19937 random(5);
    for (int round = 0; round < 300; ++round) {
        const LatticeRegion region = randomRegion(random);
        const Points points = pointsOf(region);
        std::size_t corners = 0;
        for (const auto& [r, c] : points) {
            const std::array<Site, 6> around = neighboursOf({r, c});
            for (std::size_t i = 0; i < 6; ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    const Vec2 side = latticePoint(1.0, around[i].row, around[i].column) -
                                      latticePoint(1.0, around[j].row, around[j].column);
                    corners += length(side) < 1.01 && points.contains({around[i].row, around[i].column}) &&
                                       points.contains({around[j].row, around[j].column})
                                   ? 1
                                   : 0;
                }
            }
        }
        ASSERT_EQ(3 * countTriangles(region), corners);
    }
}

double distanceTo(Vec2 p, Vec2 a, Vec2 b)
{
    const Vec2 ab = b - a;
    return length(p - (a + std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0) * ab));
}

/// Distance from the polygons, negative outside.
double depth(const Polygons& polygons, Vec2 p)
{
    double distance = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (const std::vector<Vec2>& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec2 a = polygon[i];
            const Vec2 b = polygon[(i + 1) % polygon.size()];
            distance = std::min(distance, distanceTo(p, a, b));
            if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
                inside = !inside;
            }
        }
    }
    return inside ? distance : -distance;
}

/// Points at a radius that depends on the angle.
template <typename Radius>
std::vector<Vec2> around(Vec2 centre, int count, const Radius& radius)
{
    std::vector<Vec2> polygon;
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        polygon.push_back(centre + radius(k) * Vec2{std::cos(angle), std::sin(angle)});
    }
    return polygon;
}

TEST(LatticeRegion, PointsInsideAreThoseClearOfThePolygons)
{
    const auto one = [](int) { return 1.0; };
    std::vector<Vec2> hole = around({-0.2, 0.1}, 30, [](int) { return 0.45; });
    std::reverse(hole.begin(), hole.end());
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform(0.3, 1.0);
    std::vector<double> radii(40);
    std::generate(radii.begin(), radii.end(), [&] { return uniform(random); });
    const std::vector<Polygons> shapes{
        {around({0.3, -0.2}, 97, one)},
        {around({-5.0, 7.0}, 10, [](int k) { return k % 2 == 0 ? 1.0 : 0.3; })},
        {around({0.0, 0.0}, 60, one), hole},
        {around({0.1, 0.0}, 40, [&](int k) { return radii[static_cast<std::size_t>(k)]; })},
        // Flat sides on a lattice row, and a spike thinner than any clearance.
        {{{0, 0}, {1, 0}, {1, 0.01}, {2, 0.02}, {1, 0.03}, {1, 1}, {0, 1}}}};
    std::size_t found = 0;
    std::size_t doubtful = 0;
    for (const Polygons& polygons : shapes) {
        for (const double edge : {3.0, 0.4, 0.11, 0.037}) {
            for (const double clearance : {0.0, 0.3, 0.65, 1.7}) {
                const LatticeRegion region = pointsInside(polygons, edge, clearance * edge);
                const double height = 0.5 * std::numbers::sqrt3 * edge;
                std::size_t count = 0;
                const auto [low, high] = std::minmax_element(polygons[0].begin(), polygons[0].end(),
                                                             [](Vec2 a, Vec2 b) { return a.y < b.y; });
                const auto [left, right] = std::minmax_element(polygons[0].begin(), polygons[0].end(),
                                                               [](Vec2 a, Vec2 b) { return a.x < b.x; });
                for (auto r = static_cast<std::int32_t>(low->y / height) - 2; r * height < high->y + edge; ++r) {
                    ASSERT_TRUE(isNormal(region.row(r)));
                    for (auto c = static_cast<std::int32_t>(left->x / edge) - 2; c * edge < right->x + edge; ++c) {
                        const double deep = depth(polygons, latticePoint(edge, r, c));
                        count += region.contains(r, c) ? 1 : 0;
                        if (std::abs(deep - clearance * edge) < 1e-12) {
                            ++doubtful;  // to the last bit either way
                            continue;
                        }
                        ASSERT_EQ(region.contains(r, c), deep > clearance * edge) << edge << " " << r << " " << c;
                    }
                }
                EXPECT_EQ(count, region.size());
                found += count;
            }
        }
    }
    EXPECT_GT(found, 10'000U);
    EXPECT_LT(doubtful, found / 50);
}

// Rows and corners exactly on the lattice: a hexagon of n edges holds another of n − 1, whose rim is √3/2 edges away.
TEST(LatticeRegion, HexagonHoldsTheNextSmallerOne)
{
    for (const std::int32_t n : {1, 2, 3, 10, 33}) {
        std::vector<Vec2> hexagon;
        // Sides of n edges: rows n have 2n columns less n.
        for (const Site s : {Site{0, n}, Site{n, (n + 1) / 2 - n % 2}, Site{n, (n + 1) / 2 - n % 2 - n}, Site{0, -n},
                             Site{-n, (n + 1) / 2 - n % 2 - n}, Site{-n, (n + 1) / 2 - n % 2}}) {
            hexagon.push_back(latticePoint(0.5, s.row, s.column));
        }
        for (std::size_t k = 0; k < 6; ++k) {
            ASSERT_NEAR(length(hexagon[(k + 1) % 6] - hexagon[k]), 0.5 * n, 1e-12);
        }
        const auto m = static_cast<std::size_t>(n - 1);
        EXPECT_EQ(pointsInside({hexagon}, 0.5, 0.65 * 0.5).size(), 3 * m * m + 3 * m + 1) << n;
        EXPECT_EQ(pointsInside({hexagon}, 0.5, 0.86 * 0.5).size(), 3 * m * m + 3 * m + 1) << n;
    }
}

TEST(LatticeRegion, ShapesBetweenRowsHoldNothing)
{
    const std::vector<Vec2> sliver{{0.1, 0.1}, {5.0, 0.1}, {5.0, 0.2}, {0.1, 0.2}};
    EXPECT_EQ(pointsInside({sliver}, 1.0, 0.65).size(), 0U);
    EXPECT_EQ(pointsInside({sliver}, 1.0, 0.0).size(), 0U);
}

TEST(LatticeGrid, GivesEveryPointAnIndexAndBack)
{
    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
        const LatticeRegion region = randomRegion(random);
        const std::uint32_t first = std::uniform_int_distribution<std::uint32_t>(0, 5)(random);
        const LatticeGrid grid(region, first);
        const LatticeGrid from_zero(region, 0);
        std::uint32_t next = first;
        for (const auto& [r, c] : pointsOf(region)) {
            ASSERT_EQ(grid.at({r, c}), next);
            ASSERT_EQ(from_zero.at({r, c}), next - first);
            ASSERT_TRUE(grid.siteOf(next) == (Site{r, c}));
            ++next;
        }
        EXPECT_EQ(grid.end(), next);
    }
}

TEST(LatticeGrid, NeighboursAreOneEdgeAway)
{
    for (std::int32_t r = -9; r < 10; ++r) {
        for (std::int32_t c = -9; c < 10; ++c) {
            Points distinct;
            for (const Site s : neighboursOf({r, c})) {
                EXPECT_NEAR(length(latticePoint(1.0, s.row, s.column) - latticePoint(1.0, r, c)), 1.0, 1e-14);
                distinct.emplace(s.row, s.column);
            }
            EXPECT_EQ(distinct.size(), 6U);
        }
    }
}

TEST(LatticeGrid, CoarserPointsAreFinerOnesAndAllOthersLieHalfWay)
{
    for (std::int32_t r = -17; r < 18; ++r) {
        for (std::int32_t c = -17; c < 18; ++c) {
            const Site finer = onFiner({r, c});
            EXPECT_NEAR(length(latticePoint(1.0, finer.row, finer.column) - latticePoint(2.0, r, c)), 0.0, 1e-14);
            for (const Site& back : onCoarser(finer)) {
                EXPECT_TRUE(back == (Site{r, c}));
            }
            const std::array<Site, 2> parents = onCoarser({r, c});
            const Vec2 a = latticePoint(2.0, parents[0].row, parents[0].column);
            const Vec2 b = latticePoint(2.0, parents[1].row, parents[1].column);
            EXPECT_NEAR(length(0.5 * (a + b) - latticePoint(1.0, r, c)), 0.0, 1e-14) << r << " " << c;
            EXPECT_TRUE(length(b - a) == 0.0 || std::abs(length(b - a) - 2.0) < 1e-14) << r << " " << c;
        }
    }
}

}  // namespace
}  // namespace droplet
