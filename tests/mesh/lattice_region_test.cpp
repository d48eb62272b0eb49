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
#include "mesh/lattice_grid.h"
#include "mesh/lattice_triangles.h"

namespace droplet {
namespace {

using Points = std::set<std::pair<std::int32_t, std::int32_t>>;  // row, column
using Polygons = std::vector<std::vector<Vec2>>;

Points pointsOf(const LatticeRegion& region)
{
    Points points;
    for (const Site& site : region.sites()) {
        points.emplace(site.row, site.column);
    }
    return points;
}

bool holds(const Points& points, Site site)
{
    return points.contains({site.row, site.column});
}

/// Whether intervals are not empty, ascending, and have gaps between them.
bool isNormal(const LatticeRegion& region)
{
    const std::vector<RowInterval>& intervals = region.intervals();
    for (std::size_t k = 0; k < intervals.size(); ++k) {
        const RowInterval& i = intervals[k];
        const RowInterval& last = intervals[k == 0 ? 0 : k - 1];
        if (i.begin >= i.end || (k > 0 && (i.row < last.row || (i.row == last.row && i.begin <= last.end)))) {
            return false;
        }
    }
    return true;
}

/// Random points around zero with a different density in every row, so that gaps of one point, full rows and empty rows
/// occur.
LatticeRegion randomRegion(std::mt19937& random)
{
    const auto first = std::uniform_int_distribution<std::int32_t>(-6, 3)(random);
    const auto end = first + std::uniform_int_distribution<std::int32_t>(0, 8)(random);
    std::vector<RowInterval> points;
    for (std::int32_t r = first; r < end; ++r) {
        std::bernoulli_distribution there(std::uniform_real_distribution<double>(0.0, 1.0)(random));
        for (std::int32_t c = -9; c < 10; ++c) {
            if (there(random)) {
                points.push_back({r, c, c + 1});
            }
        }
    }
    return LatticeRegion(std::move(points));
}

TEST(LatticeRegion, ObeysTheAlgebraOfSets)
{
    std::mt19937 random(1);
    for (int round = 0; round < 1000; ++round) {
        const LatticeRegion first = randomRegion(random);
        const LatticeRegion second = randomRegion(random);
        const Points a = pointsOf(first);
        const Points b = pointsOf(second);
        Points difference;
        std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(difference, difference.end()));
        Points intersection;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::inserter(intersection, intersection.end()));
        const LatticeRegion less = without(first, second);
        const LatticeRegion both = common(first, second);
        ASSERT_EQ(pointsOf(less), difference);
        ASSERT_EQ(pointsOf(both), intersection);
        ASSERT_TRUE(isNormal(less) && isNormal(both));
        for (const LatticeStep step : kLatticeSteps) {
            Points further;
            for (const auto& [r, c] : a) {
                const Site site = neighbour({r, c}, step);
                further.emplace(site.row, site.column);
            }
            ASSERT_EQ(pointsOf(moved(first, step)), further);
        }
    }
}

TEST(LatticeRegion, IntervalsMayOverlapTouchAndComeInAnyOrder)
{
    std::mt19937 random(2);
    for (int round = 0; round < 2000; ++round) {
        std::vector<RowInterval> intervals;
        Points all;
        for (int k = std::uniform_int_distribution<int>(0, 9)(random); k > 0; --k) {
            const std::int32_t row = std::uniform_int_distribution<std::int32_t>(-2, 1)(random);
            const std::int32_t begin = std::uniform_int_distribution<std::int32_t>(-20, 20)(random);
            const std::int32_t end = begin + std::uniform_int_distribution<std::int32_t>(-1, 8)(random);
            intervals.push_back({row, begin, end});
            for (std::int32_t c = begin; c < end; ++c) {
                all.emplace(row, c);
            }
        }
        const LatticeRegion found(intervals);
        ASSERT_EQ(pointsOf(found), all);
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
        ASSERT_EQ(region.empty(), points.empty());
        for (std::int32_t r = -10; r < 15; ++r) {
            std::size_t in_row = 0;
            for (const RowInterval& i : region.row(r)) {
                EXPECT_EQ(i.row, r);
                in_row += i.size();
            }
            for (std::int32_t c = -12; c < 13; ++c) {
                ASSERT_EQ(region.contains({r, c}), points.contains({r, c}));
                if (region.contains({r, c})) {
                    --in_row;
                    const RowInterval& i = region.intervals()[region.intervalOf({r, c})];
                    EXPECT_TRUE(i.row == r && i.begin <= c && c < i.end);
                }
            }
            EXPECT_EQ(in_row, 0U);
        }
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
            if (std::all_of(around.begin(), around.end(), [&](Site s) { return holds(points, s); })) {
                wanted.emplace(r, c);
            }
        }
        const LatticeRegion found = eroded(region);
        ASSERT_EQ(pointsOf(found), wanted);
        ASSERT_TRUE(isNormal(found));
        left += wanted.size();
    }
    EXPECT_GT(left, 500U);
}

TEST(LatticeRegion, EverySecondPointIsOnTheCoarserLattice)
{
    std::mt19937 random(8);
    for (int round = 0; round < 500; ++round) {
        const LatticeRegion region = randomRegion(random);
        Points wanted;
        for (std::int32_t r = -9; r < 10; ++r) {
            for (std::int32_t c = -9; c < 10; ++c) {
                if (region.contains(toFiner({r, c}))) {
                    wanted.emplace(r, c);
                }
            }
        }
        ASSERT_EQ(pointsOf(everySecond(region)), wanted);
    }
}

TEST(LatticeTriangles, AreTriplesOfNeighbours)
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
                    const Vec2 side = latticePoint(1.0, around[i]) - latticePoint(1.0, around[j]);
                    corners += length(side) < 1.01 && holds(points, around[i]) && holds(points, around[j]) ? 1 : 0;
                }
            }
        }
        const LatticeTriangles triangles = trianglesOf(region);
        ASSERT_EQ(3 * triangles.size(), corners);

        const LatticeGrid grid(region, 3);
        std::vector<Triangle> found;
        append(found, triangles, grid);
        ASSERT_EQ(found.size(), triangles.size());
        ASSERT_EQ(std::set<Triangle>(found.begin(), found.end()).size(), found.size());
        for (const Triangle& t : found) {
            const Vec2 a = latticePoint(1.0, grid.siteOf(t[0]));
            const Vec2 b = latticePoint(1.0, grid.siteOf(t[1]));
            const Vec2 c = latticePoint(1.0, grid.siteOf(t[2]));
            ASSERT_NEAR(cross(b - a, c - a), 0.5 * std::numbers::sqrt3, 1e-12);  // equilateral, counter-clockwise
        }
        EXPECT_EQ(without(triangles, triangles).size(), 0U);
        EXPECT_EQ(without(triangles, trianglesOf(eroded(region))).size(),
                  triangles.size() - trianglesOf(eroded(region)).size());
    }
}

double distanceTo(Vec2 p, Vec2 a, Vec2 b)
{
    const Vec2 ab = b - a;
    return length(p - (a + std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0) * ab));
}

/// Distance from the polygons; negative outside.
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
        // Flat sides on a lattice row, and a spike thinner than any clearance
        {{{0, 0}, {1, 0}, {1, 0.01}, {2, 0.02}, {1, 0.03}, {1, 1}, {0, 1}}}};
    std::size_t found = 0;
    std::size_t undecided = 0;
    for (const Polygons& polygons : shapes) {
        for (const double edge : {3.0, 0.4, 0.11, 0.037}) {
            for (const double clearance : {0.0, 0.3, 0.65, 1.7}) {
                const LatticeRegion region = pointsInside(polygons, edge, clearance * edge);
                ASSERT_TRUE(isNormal(region));
                const double height = 0.5 * std::numbers::sqrt3 * edge;
                std::size_t count = 0;
                const auto [low, high] = std::minmax_element(polygons[0].begin(), polygons[0].end(),
                                                             [](Vec2 a, Vec2 b) { return a.y < b.y; });
                const auto [left, right] = std::minmax_element(polygons[0].begin(), polygons[0].end(),
                                                               [](Vec2 a, Vec2 b) { return a.x < b.x; });
                for (auto r = static_cast<std::int32_t>(low->y / height) - 2; r * height < high->y + edge; ++r) {
                    for (auto c = static_cast<std::int32_t>(left->x / edge) - 2; c * edge < right->x + edge; ++c) {
                        const double deep = depth(polygons, latticePoint(edge, {r, c}));
                        count += region.contains({r, c}) ? 1 : 0;
                        if (std::abs(deep - clearance * edge) < 1e-12) {
                            ++undecided;  // too close to decide
                            continue;
                        }
                        ASSERT_EQ(region.contains({r, c}), deep > clearance * edge) << edge << " " << r << " " << c;
                    }
                }
                EXPECT_EQ(count, region.size());
                found += count;
            }
        }
    }
    EXPECT_GT(found, 10'000U);
    EXPECT_LT(undecided, found / 50);
}

// Rows and corners lie exactly on the lattice: a hexagon of n edges holds another of n − 1 edges, whose rim is √3/2
// edges away.
TEST(LatticeRegion, HexagonHoldsTheNextSmallerOne)
{
    for (const std::int32_t n : {1, 2, 3, 10, 33}) {
        std::vector<Vec2> hexagon;
        // The sides have n edges, so row n has n columns less than row 0.
        for (const Site s : {Site{0, n}, Site{n, (n + 1) / 2 - n % 2}, Site{n, (n + 1) / 2 - n % 2 - n}, Site{0, -n},
                             Site{-n, (n + 1) / 2 - n % 2 - n}, Site{-n, (n + 1) / 2 - n % 2}}) {
            hexagon.push_back(latticePoint(0.5, s));
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

TEST(LatticeGrid, MapsPointsToIndicesAndBack)
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
        EXPECT_EQ(grid.begin(), first);
        EXPECT_EQ(grid.end(), next);
    }
}

TEST(LatticeSite, NeighboursAreOneEdgeAway)
{
    for (std::int32_t r = -9; r < 10; ++r) {
        for (std::int32_t c = -9; c < 10; ++c) {
            Points distinct;
            for (const Site s : neighboursOf({r, c})) {
                EXPECT_NEAR(length(latticePoint(1.0, s) - latticePoint(1.0, {r, c})), 1.0, 1e-14);
                distinct.emplace(s.row, s.column);
            }
            EXPECT_EQ(distinct.size(), 6U);
        }
    }
}

TEST(LatticeSite, CoarserPointsAreFinerOnesAndAllOthersLieHalfWay)
{
    for (std::int32_t r = -17; r < 18; ++r) {
        for (std::int32_t c = -17; c < 18; ++c) {
            const Site finer = toFiner({r, c});
            EXPECT_NEAR(length(latticePoint(1.0, finer) - latticePoint(2.0, {r, c})), 0.0, 1e-14);
            for (const Site& back : toCoarser(finer)) {
                EXPECT_TRUE(back == (Site{r, c}));
            }
            const std::array<Site, 2> parents = toCoarser({r, c});
            const Vec2 a = latticePoint(2.0, parents[0]);
            const Vec2 b = latticePoint(2.0, parents[1]);
            EXPECT_NEAR(length(0.5 * (a + b) - latticePoint(1.0, {r, c})), 0.0, 1e-14) << r << " " << c;
            EXPECT_TRUE(length(b - a) == 0.0 || std::abs(length(b - a) - 2.0) < 1e-14) << r << " " << c;
        }
    }
}

}  // namespace
}  // namespace droplet
