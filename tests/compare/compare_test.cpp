// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/compare/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "support/compare.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using testing::roundDroplet;
using testing::RoundDroplet;
using testing::together;

/// Surface of triangles with flat normals: three vertices each, welded where they meet.
Surface faceted(const std::vector<std::array<Vec3, 3>>& facets)
{
    Surface surface;
    for (const auto& [a, b, c] : facets) {
        const Vec3 normal = cross(b - a, c - a);
        const double size = length(normal);
        for (const Vec3 p : {a, b, c}) {
            const auto index = static_cast<std::uint32_t>(surface.vertices.size());
            const auto first = std::find(surface.vertices.begin(), surface.vertices.end(), p);
            surface.weld.push_back(static_cast<std::uint32_t>(first - surface.vertices.begin()));
            surface.vertices.push_back(p);
            surface.normals.push_back(size > 0.0 ? (1.0 / size) * normal : Vec3{0.0, 0.0, 1.0});
            surface.uvs.emplace_back();
            if (index % 3 == 2) {
                surface.triangles.push_back({index - 2, index - 1, index});
            }
        }
    }
    return surface;
}

using Facets = std::vector<std::array<Vec3, 3>>;

/// Box with n by n squares of two triangles on every face, and all diagonals in one of two directions.
Facets boxFacets(Vec3 low, Vec3 high, int n = 1, bool other_diagonal = false)
{
    Facets facets;
    const auto face = [&](Vec3 origin, Vec3 u, Vec3 v) {
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const auto at = [&](int di, int dj) {
                    return origin + (static_cast<double>(i + di) / n) * u + (static_cast<double>(j + dj) / n) * v;
                };
                if (other_diagonal) {
                    facets.push_back({at(0, 0), at(1, 0), at(0, 1)});
                    facets.push_back({at(1, 0), at(1, 1), at(0, 1)});
                } else {
                    facets.push_back({at(0, 0), at(1, 0), at(1, 1)});
                    facets.push_back({at(0, 0), at(1, 1), at(0, 1)});
                }
            }
        }
    };
    const Vec3 x{high.x - low.x, 0.0, 0.0};
    const Vec3 y{0.0, high.y - low.y, 0.0};
    const Vec3 z{0.0, 0.0, high.z - low.z};
    face(low, y, x);
    face(low, x, z);
    face(low, z, y);
    face(low + z, x, y);
    face(low + y, z, x);
    face(low + x, y, z);
    return facets;
}

/// Octahedron whose faces are cut into n² triangles and projected to a sphere.
Facets sphereFacets(double radius, int n)
{
    Facets facets;
    for (const double sx : {1.0, -1.0}) {
        for (const double sy : {1.0, -1.0}) {
            for (const double sz : {1.0, -1.0}) {
                const auto at = [&](int i, int j) {
                    const Vec3 p{sx * i, sy * j, sz * (n - i - j)};
                    return (radius / length(p)) * p;
                };
                const auto add = [&](Vec3 a, Vec3 b, Vec3 c) {
                    facets.push_back(sx * sy * sz > 0.0 ? std::array{a, b, c} : std::array{a, c, b});
                };
                for (int i = 0; i < n; ++i) {
                    for (int j = 0; i + j < n; ++j) {
                        add(at(i, j), at(i + 1, j), at(i, j + 1));
                        if (i + j + 2 <= n) {
                            add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                        }
                    }
                }
            }
        }
    }
    return facets;
}

Surface moved(Surface surface, const std::function<Vec3(Vec3)>& place, const std::function<Vec3(Vec3)>& turn)
{
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
        surface.vertices[v] = place(surface.vertices[v]);
        surface.normals[v] = turn(surface.normals[v]);
    }
    return surface;
}

Surface shifted(const Surface& surface, Vec3 by)
{
    return moved(
        surface, [by](Vec3 p) { return p + by; }, [](Vec3 n) { return n; });
}

Surface scaled(const Surface& surface, double factor)
{
    return moved(
        surface, [factor](Vec3 p) { return factor * p; }, [](Vec3 n) { return n; });
}

/// Rotation around a general axis.
Vec3 turned(Vec3 p)
{
    const Vec3 axis = (1.0 / std::sqrt(14.0)) * Vec3{1.0, -2.0, 3.0};
    const double angle = 0.7;
    return std::cos(angle) * p + std::sin(angle) * cross(axis, p) + ((1.0 - std::cos(angle)) * dot(axis, p)) * axis;
}

/// The same surface with vertices and triangles in another order.
Surface shuffled(const Surface& surface)
{
    std::mt19937 random(5);
    std::vector<std::uint32_t> new_place(surface.vertices.size());
    for (std::uint32_t v = 0; v < new_place.size(); ++v) {
        new_place[v] = v;
    }
    for (std::size_t v = new_place.size(); v > 1; --v) {
        std::swap(new_place[v - 1], new_place[random() % v]);
    }
    Surface result = surface;
    for (std::size_t v = 0; v < new_place.size(); ++v) {
        result.vertices[new_place[v]] = surface.vertices[v];
        result.normals[new_place[v]] = surface.normals[v];
        result.uvs[new_place[v]] = surface.uvs[v];
    }
    std::vector<std::uint32_t> first(new_place.size(), std::numeric_limits<std::uint32_t>::max());
    for (std::size_t v = 0; v < new_place.size(); ++v) {
        std::uint32_t& group = first[surface.weld[v]];
        group = std::min(group, new_place[v]);
    }
    for (std::size_t v = 0; v < new_place.size(); ++v) {
        result.weld[new_place[v]] = first[surface.weld[v]];
    }
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const Triangle& from = surface.triangles[surface.triangles.size() - 1 - t];
        result.triangles[t] = {new_place[from[1]], new_place[from[2]], new_place[from[0]]};
    }
    return result;
}

void expectEqual(Vec3 a, Vec3 b)
{
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.y, b.y);
    EXPECT_EQ(a.z, b.z);
}

void expectEqual(const SurfaceDistance& a, const SurfaceDistance& b)
{
    EXPECT_EQ(a.lower, b.lower);
    EXPECT_EQ(a.upper, b.upper);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.rms, b.rms);
    expectEqual(a.at, b.at);
    expectEqual(a.nearest, b.nearest);
}

/// Checks that the truth lies between the bounds, and that they are near enough to each other.
void expectBrackets(const SurfaceDistance& found, double truth, double share = CompareOptions().share)
{
    EXPECT_LE(found.lower, truth * (1.0 + 1e-12));
    EXPECT_GE(found.upper, truth * (1.0 - 1e-12));
    EXPECT_LE(found.upper - found.lower, share * found.upper + 1e-15);
    EXPECT_LE(found.mean, found.rms * (1.0 + 1e-12));
    EXPECT_LE(found.rms, found.upper * (1.0 + 1e-12));
    EXPECT_NEAR(length(found.at - found.nearest), found.lower, 1e-12 * truth + 1e-15);
}

Surface box(Vec3 low = {0.0, 0.0, 0.0}, Vec3 high = {1.0, 1.0, 1.0}, int n = 1)
{
    return faceted(boxFacets(low, high, n));
}

TEST(Compare, TranslatedBoxHasTheDistanceOfItsShift)
{
    const Comparison found = compare(box(), shifted(box(), {0.125, 0.0, 0.0}));
    expectBrackets(found.symmetric, 0.125);
    expectBrackets(found.from_a, 0.125);
    EXPECT_NEAR(found.a.area, 6.0, 1e-12);
    EXPECT_NEAR(found.b.volume, 1.0, 1e-12);
    EXPECT_NEAR(found.relativeVolume().value(), 0.0, 1e-12);
    expectEqual(found.b.lowest, {0.125, 0.0, 0.0});
    expectEqual(found.b.highest, {1.125, 1.0, 1.0});
    EXPECT_TRUE(found.same_topology);
    // The left face of the first box has the distance of the shift. Four faces have a strip outside the other box,
    // where the distance falls to zero. The right face lies inside the other box.
    const double strips = 4.0 * 0.125 * 0.125 / 2.0;
    const double right = 0.125 / 3.0 * (1.0 + 0.75 * 0.75 + 0.75);
    EXPECT_NEAR(found.from_a.mean, (0.125 + right + strips) / 6.0, 1e-5);
    EXPECT_NEAR(found.symmetric.mean, found.from_a.mean, 1e-12);
}

TEST(Compare, ParallelSheetsHaveOneDistance)
{
    // Different squares and diagonals, and distances far below the length of edges.
    const auto sheet = [](double z, int n, bool other_diagonal) {
        Facets facets = boxFacets({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, n, other_diagonal);
        std::erase_if(facets, [](const auto& f) { return f[0].z + f[1].z + f[2].z > 0.0; });
        return shifted(faceted(facets), {0.0, 0.0, z});
    };
    for (const double distance : {0.5, 1e-3, 1e-6, 1e-9}) {
        const Comparison found = compare(sheet(0.0, 7, false), sheet(distance, 9, true));
        for (const SurfaceDistance& way : {found.from_a, found.from_b, found.symmetric}) {
            expectBrackets(way, distance);
            EXPECT_NEAR(way.mean, distance, 1e-12 * distance + 1e-15);
            EXPECT_NEAR(way.rms, distance, 1e-12 * distance + 1e-15);
        }
        EXPECT_LT(found.normals.largest, 1e-7);
        EXPECT_EQ(found.a.topology.boundary_loops, 1U);
        EXPECT_FALSE(found.a.topology.closed);
    }
}

TEST(Compare, SpheresOfTwoSizesHaveTheirDifferenceInRadius)
{
    // Vertices of a are on the sphere of radius 1, and chords of b reach 1.25 cos inward; the truth lies between them.
    const Surface a = faceted(sphereFacets(1.0, 6));
    const Surface b = faceted(sphereFacets(1.25, 12));
    CompareOptions options;
    options.share = 1e-4;
    const Comparison found = compare(a, b, options);
    EXPECT_LE(found.from_a.upper - found.from_a.lower, 1e-4 * found.from_a.upper);
    EXPECT_LE(found.from_b.upper - found.from_b.lower, 1e-4 * found.from_b.upper);
    // The farthest points of b are its vertices above the middles of a's facets; no point of b has a larger radius.
    double min_radius = 1.0;
    for (const auto& [p, q, r] : sphereFacets(1.0, 6)) {
        min_radius = std::min(min_radius, std::abs(dot(p, cross(q - p, r - p))) / length(cross(q - p, r - p)));
    }
    EXPECT_LE(found.from_b.lower, 1.25 - min_radius);
    EXPECT_GE(found.from_b.upper, 0.25);
    EXPECT_GT(found.from_b.lower, 0.25 + 0.25 * (1.0 - min_radius));
    EXPECT_EQ(found.a.topology.euler, 2);
    EXPECT_TRUE(found.same_topology);
}

TEST(Compare, BoundsContainTheDistancesOfManySamples)
{
    const Surface a = roundDroplet({.height = 1.1e-3, .rings = 7, .segments = 17});
    const Surface b = roundDroplet({.outer = 4.03e-3, .rings = 5, .segments = 13, .centre = {2e-5, -1e-5}});
    CompareOptions options;
    options.share = 1e-3;
    const Comparison found = compare(a, b, options);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    double largest = 0.0;
    double sum = 0.0;
    double area = 0.0;
    for (const auto& [i, j, k] : a.triangles) {
        const Vec3 p = a.vertices[i];
        const Vec3 u = a.vertices[j] - p;
        const Vec3 v = a.vertices[k] - p;
        double mean = 0.0;
        constexpr int kSamples = 60;
        for (int s = 0; s < kSamples; ++s) {
            double x = uniform(random);
            double y = uniform(random);
            if (x + y > 1.0) {
                x = 1.0 - x;
                y = 1.0 - y;
            }
            const Vec3 at = p + x * u + y * v;
            double min = std::numeric_limits<double>::infinity();
            for (const auto& [l, m, n] : b.triangles) {
                min = std::min(min, testing::distance(at, b.vertices[l], b.vertices[m], b.vertices[n]));
            }
            largest = std::max(largest, min);
            mean += min / kSamples;
        }
        const double size = 0.5 * length(cross(u, v));
        sum += size * mean;
        area += size;
    }
    EXPECT_GE(found.from_a.upper, largest);
    EXPECT_LT(found.from_a.lower, 1.1 * largest);
    EXPECT_LE(found.from_a.upper - found.from_a.lower, 1e-3 * found.from_a.upper);
    EXPECT_NEAR(found.from_a.mean, sum / area, 0.02 * sum / area);
    EXPECT_NEAR(found.a.area, area, 1e-12 * area);
}

TEST(Compare, NeedlesAreComparedWithFineTriangles)
{
    // Three needles as long as a droplet, above thousands of its triangles, which cut them into polygons of many
    // corners.
    const Surface fine = roundDroplet({.height = 1e-9, .rings = 24, .segments = 96, .open = true});
    const Surface coarse = moved(
        roundDroplet({.height = 1e-9, .rings = 1, .segments = 3, .open = true}),
        [](Vec3 p) {
            return Vec3{0.3 * p.x, 0.02 * p.y, p.z + 1e-5};
        },
        [](Vec3 n) { return n; });
    const Comparison found = compare(coarse, fine);
    // It is flat to 1e-9, and inside the outline of the other.
    EXPECT_NEAR(found.from_a.lower, 1e-5, 2e-9);
    EXPECT_NEAR(found.from_a.upper, 1e-5, 1e-5 * CompareOptions().share + 2e-9);
    EXPECT_NEAR(found.from_a.mean, 1e-5, 2e-9);
    EXPECT_GT(found.from_b.lower, 3e-3) << "the rim of the disc is far from the needles";
    EXPECT_LE(found.from_b.upper - found.from_b.lower, CompareOptions().share * found.from_b.upper);
}

TEST(Compare, FindsSpikesThinnerThanAnySampling)
{
    // A needle above the middle of one facet of a box of 12 triangles, with a foot 1e-7 wide.
    Facets facets = boxFacets({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    const Vec3 foot{0.61, 0.33, 1.0};
    const double w = 1e-7;
    const Vec3 tip = foot + Vec3{0.0, 0.0, 0.3};
    facets.push_back({foot, foot + Vec3{w, 0.0, 0.0}, tip});
    const Surface with = faceted(facets);
    const Comparison found = compare(box(), with);
    expectBrackets(found.from_b, 0.3);
    EXPECT_NEAR(found.from_a.upper, 0.0, 1e-12) << "the box is part of the other surface";
    expectBrackets(found.symmetric, 0.3);
    expectEqual(found.symmetric.at, tip);
    EXPECT_LT(found.symmetric.rms, 1e-3) << "the needle has almost no area";
    EXPECT_FALSE(found.same_topology);
}

TEST(Compare, DentBetweenVerticesIsFoundFromBothSides)
{
    // A pyramid with its tip below the middle of a square; all vertices of the square agree.
    const Vec3 tip{0.5, 0.5, -0.2};
    const Surface flat =
        faceted({{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}}, {Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}});
    const Surface dented = faceted({{Vec3{0, 0, 0}, Vec3{1, 0, 0}, tip},
                                    {Vec3{1, 0, 0}, Vec3{1, 1, 0}, tip},
                                    {Vec3{1, 1, 0}, Vec3{0, 1, 0}, tip},
                                    {Vec3{0, 1, 0}, Vec3{0, 0, 0}, tip}});
    CompareOptions options;
    options.share = 1e-6;
    const Comparison found = compare(flat, dented, options);
    // The nearest points to the middle are on the four facets.
    expectBrackets(found.from_a, 0.2 * 0.5 / std::hypot(0.2, 0.5), 1e-6);
    expectBrackets(found.from_b, 0.2, 1e-6);
    // The distance of a facet from the plane is linear; its mean is a third of the largest, its mean square a sixth.
    EXPECT_NEAR(found.from_b.mean, 0.2 / 3.0, 1e-12);
    EXPECT_NEAR(found.from_b.rms, 0.2 / std::sqrt(6.0), 1e-12);
    EXPECT_NEAR(found.normals.largest, std::atan(0.4), 1e-12);
    EXPECT_NEAR(found.normals.rms, std::atan(0.4), 1e-6);
}

TEST(Compare, SurfaceHasNoDistanceFromItself)
{
    for (const Surface& surface :
         {roundDroplet(), roundDroplet({.inner = 1e-3}), box(), roundDroplet({.open = true})}) {
        for (const Surface& other : {surface, shuffled(surface)}) {
            const Comparison found = compare(surface, other);
            EXPECT_LE(found.symmetric.upper, 1e-17) << "a hundred times less than a coordinate's round-off";
            EXPECT_LE(found.symmetric.rms, 1e-17);
            EXPECT_LT(found.normals.largest, 1e-7);
            EXPECT_TRUE(found.same_topology);
            EXPECT_NEAR(found.relativeVolume().value(), 0.0, 1e-14);
        }
    }
}

TEST(Compare, ExchangedSurfacesGiveTheExchangedResult)
{
    const Surface a = roundDroplet({.rings = 7, .segments = 17});
    const Surface b = roundDroplet({.height = 1.1e-3, .rings = 4, .segments = 23});
    const Comparison there = compare(a, b);
    const Comparison back = compare(b, a);
    expectEqual(there.from_a, back.from_b);
    expectEqual(there.from_b, back.from_a);
    expectEqual(there.symmetric, back.symmetric);
    EXPECT_GT(there.symmetric.lower, 0.0);
    EXPECT_EQ(there.normals_of_a.largest, back.normals_of_b.largest);
    EXPECT_EQ(there.normals.rms, back.normals.rms);
    EXPECT_EQ(there.a.volume, back.b.volume);
    EXPECT_NEAR(*there.relativeVolume(), (there.b.volume - there.a.volume) / there.a.volume, 1e-15);
}

TEST(Compare, RmsOfBothIsWeightedByArea)
{
    const Comparison found = compare(roundDroplet(), roundDroplet({.height = 1.3e-3, .rings = 6}));
    const double area = found.a.area + found.b.area;
    const double mean = (found.a.area * found.from_a.mean + found.b.area * found.from_b.mean) / area;
    const double square =
        (found.a.area * found.from_a.rms * found.from_a.rms + found.b.area * found.from_b.rms * found.from_b.rms) /
        area;
    EXPECT_NEAR(found.symmetric.mean, mean, 1e-12 * mean);
    EXPECT_NEAR(found.symmetric.rms, std::sqrt(square), 1e-12 * std::sqrt(square));
    EXPECT_EQ(found.symmetric.upper, std::max(found.from_a.upper, found.from_b.upper));
    EXPECT_EQ(found.symmetric.lower, std::max(found.from_a.lower, found.from_b.lower));
}

TEST(Compare, LengthsScaleAndAnglesDoNot)
{
    const Surface a = roundDroplet();
    const Surface b = roundDroplet({.height = 1.2e-3, .rings = 5, .segments = 15});
    const Comparison one = compare(a, b);
    for (const double factor : {std::ldexp(1.0, -30), std::ldexp(1.0, 30), 1e-8, 1e8}) {
        const Comparison found = compare(scaled(a, factor), scaled(b, factor));
        const double exact = std::log2(factor) == std::round(std::log2(factor)) ? 0.0 : 1e-9;
        const auto expect_times = [&](double big, double small, double power) {
            EXPECT_NEAR(big / small, std::pow(factor, power), exact * std::pow(factor, power)) << factor;
        };
        expect_times(found.symmetric.rms, one.symmetric.rms, 1.0);
        expect_times(found.symmetric.mean, one.symmetric.mean, 1.0);
        expect_times(found.from_a.lower, one.from_a.lower, 1.0);
        expect_times(found.from_b.upper, one.from_b.upper, 1.0);
        expect_times(found.a.area, one.a.area, 2.0);
        expect_times(found.b.volume, one.b.volume, 3.0);
        EXPECT_NEAR(found.normals.largest, one.normals.largest, 1e-9);
        EXPECT_NEAR(found.normals.rms, one.normals.rms, 1e-9);
    }
}

TEST(Compare, RigidMotionOfBothChangesNothing)
{
    const Surface a = roundDroplet();
    const Surface b = roundDroplet({.height = 1.2e-3, .rings = 5, .segments = 15});
    CompareOptions options;
    options.share = 1e-6;
    const Comparison one = compare(a, b, options);
    for (const double far : {0.0, 1e-2, 1e3}) {  // the last is a million times their size, with a round-off of 1e-13 m
        const auto place = [far](Vec3 p) { return turned(p) + Vec3{far, -2.0 * far, 0.5 * far}; };
        const Comparison found = compare(moved(a, place, turned), moved(b, place, turned), options);
        const double rounding = 1e-16 + 1e-15 * far;
        EXPECT_NEAR(found.symmetric.lower, one.symmetric.lower, 1e-6 * one.symmetric.upper + rounding);
        EXPECT_NEAR(found.symmetric.upper, one.symmetric.upper, 1e-6 * one.symmetric.upper + rounding);
        EXPECT_NEAR(found.symmetric.rms, one.symmetric.rms, rounding + 1e-4 * one.symmetric.rms);
        EXPECT_NEAR(found.normals.rms, one.normals.rms, 1e-4 * one.normals.rms + 1e-8 * far);
        EXPECT_TRUE(found.same_topology);
    }
}

TEST(Compare, BoundsAreNarrowedToDecideAboutTheTolerance)
{
    // The largest distance is 0.2. With this share alone, the tolerance would lie between the bounds.
    const Surface flat = box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 2);
    const Surface dented = faceted([] {
        Facets facets = boxFacets({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 8);
        for (auto& facet : facets) {
            for (Vec3& p : facet) {
                p.z -= p.z == 1.0 ? 0.4 * std::max(0.0, 0.5 - std::max(std::abs(p.x - 0.5), std::abs(p.y - 0.5))) : 0.0;
            }
        }
        return facets;
    }());
    for (const double tolerance : {0.199, 0.1999999, 0.2000001, 0.201}) {
        CompareOptions options;
        options.share = 0.9;
        options.tolerance = tolerance;
        const SurfaceDistance found = compare(flat, dented, options).from_b;
        EXPECT_EQ(found.lower > tolerance, tolerance < 0.2) << tolerance;
        EXPECT_EQ(found.upper <= tolerance, tolerance > 0.2) << tolerance;
    }
}

TEST(Compare, BoundsHoldIfTheWorkIsLimited)
{
    // A hard case: a small sphere near the centre of another one, which is equally far from all its points.
    const Surface a = faceted(sphereFacets(1.0, 9));
    const Surface b = shifted(faceted(sphereFacets(0.01, 2)), {1e-3, 2e-3, 3e-3});
    CompareOptions options;
    options.share = 1e-9;
    const Comparison exact = compare(a, b, options);
    options.max_pieces = 1;
    const Comparison coarse = compare(a, b, options);
    for (const auto& [wide, narrow] : {std::pair(coarse.from_a, exact.from_a), {coarse.from_b, exact.from_b}}) {
        EXPECT_LE(wide.lower, narrow.upper);
        EXPECT_GE(wide.upper, narrow.lower);
        EXPECT_LE(narrow.upper - narrow.lower, 2e-9 * narrow.upper);
    }
    EXPECT_GT(coarse.from_b.upper - coarse.from_b.lower, 1e-6) << "the limit had no effect";
}

TEST(Compare, ManyLargeIntersectingTrianglesTakeLimitedWork)
{
    // As in a damaged file. Cut as finely as others, they would be a hundred thousand pieces.
    const auto wild = [](double turn) {
        Facets facets;
        for (int k = 0; k < 40; ++k) {
            const auto corner = [&](double j) {
                const double angle = 2.4 * k + 2.1 * j + turn;
                return Vec3{std::cos(angle), std::sin(angle), std::sin(1.7 * k + 3.0 * j)};
            };
            facets.push_back({corner(0.0), corner(1.0), corner(2.0)});
        }
        return faceted(facets);
    };
    const Comparison found = compare(wild(0.0), wild(0.1));
    EXPECT_GT(found.symmetric.lower, 0.0);
    EXPECT_GE(found.symmetric.upper, found.symmetric.lower);
    EXPECT_GT(found.symmetric.mean, 0.0);
    EXPECT_LE(found.symmetric.mean, found.symmetric.upper);
}

TEST(Compare, TrianglesWithoutAreaOnlyAddTheirPoints)
{
    Facets facets = boxFacets({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    facets.push_back({Vec3{0.2, 0.2, 1.0}, Vec3{0.4, 0.4, 1.0}, Vec3{0.7, 0.7, 1.0}});
    facets.push_back({Vec3{0.5, 0.5, 0.0}, Vec3{0.5, 0.5, 0.0}, Vec3{0.5, 0.5, 0.0}});
    const Comparison same = compare(box(), faceted(facets));
    EXPECT_LE(same.symmetric.upper, 1e-15);
    EXPECT_EQ(same.a.area, same.b.area);
    EXPECT_LT(same.normals.largest, 1e-7);
    facets.push_back({Vec3{0.3, 0.3, 1.0}, Vec3{0.3, 0.3, 1.25}, Vec3{0.3, 0.3, 1.5}});
    const Comparison whisker = compare(box(), faceted(facets));
    expectBrackets(whisker.from_b, 0.5);
    EXPECT_LE(whisker.from_a.upper, 1e-15);
    EXPECT_LE(whisker.symmetric.rms, 1e-15);

    const Surface point = faceted({{Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 0, 0}}});
    const Comparison points = compare(point, shifted(point, {0.0, 3.0, 4.0}));
    expectBrackets(points.symmetric, 5.0);
    EXPECT_EQ(points.symmetric.rms, 0.0);
    EXPECT_FALSE(points.relativeVolume());
    EXPECT_EQ(compare(point, point).symmetric.upper, 0.0);
}

TEST(Compare, ReportsDifferentTopologyCountsAndVolume)
{
    const Surface closed = roundDroplet();
    const Surface open = roundDroplet({.open = true});
    const Surface ring = roundDroplet({.inner = 1e-3});
    const Surface two = together(closed, shifted(closed, {20e-3, 0.0, 0.0}));
    EXPECT_FALSE(compare(closed, open).same_topology);
    EXPECT_FALSE(compare(closed, ring).same_topology);
    EXPECT_FALSE(compare(closed, two).same_topology);
    const Comparison found = compare(closed, two);
    EXPECT_EQ(found.b.topology.components, 2U);
    EXPECT_EQ(found.b.vertices, 2 * found.a.vertices);
    EXPECT_EQ(found.b.triangles, 2 * found.a.triangles);
    EXPECT_NEAR(*found.relativeVolume(), 1.0, 1e-12);
    // The farthest point of the second droplet is its far end; the nearest one is the near end of the first.
    expectBrackets(found.from_b, 20e-3);
    EXPECT_LE(found.from_a.upper, 1e-15);
    EXPECT_TRUE(compare(open, roundDroplet({.rings = 6, .open = true})).same_topology);
}

TEST(Compare, NormalsAtARimAreNotComparedAcrossTheEdge)
{
    // The same droplet, slightly smaller: its rim lies inside the other's base, whose normal differs by 153 degrees
    // from that of the liquid.
    const Surface a = roundDroplet({.rings = 16, .segments = 64});
    const Surface b = scaled(a, 0.999);
    const Comparison found = compare(a, b);
    EXPECT_LT(found.normals.largest, 2e-3);
    EXPECT_LT(found.normals.rms, found.normals.largest);
    EXPECT_GT(found.normals.largest, 0.0);
    // On a surface turned inside out every normal differs by 180 degrees.
    Surface inside_out = a;
    for (std::size_t v = 0; v < a.normals.size(); ++v) {
        inside_out.normals[v] = -1.0 * a.normals[v];
    }
    for (Triangle& t : inside_out.triangles) {
        std::swap(t[1], t[2]);
    }
    const Comparison turned_over = compare(a, inside_out);
    EXPECT_LE(turned_over.symmetric.upper, 1e-15);
    EXPECT_GT(turned_over.normals.largest, 0.99 * std::numbers::pi);
    EXPECT_NEAR(turned_over.b.volume, -turned_over.a.volume, 1e-20);
}

TEST(Compare, ContactAnglesAreWeightedByLength)
{
    const Surface plain = roundDroplet({.segments = 12});
    EXPECT_FALSE(compare(plain, plain).a.contact_angle);
    const Surface with = testing::withContactAngles(plain);  // 0.31, 0.32 … along edges of equal length
    const Comparison found = compare(with, plain);
    ASSERT_TRUE(found.a.contact_angle);
    EXPECT_NEAR(found.a.contact_angle->min, 0.31, 1e-6);
    EXPECT_NEAR(found.a.contact_angle->max, 0.42, 1e-6);
    EXPECT_NEAR(found.a.contact_angle->mean, 0.365, 1e-6);
    EXPECT_FALSE(found.b.contact_angle);
}

TEST(Compare, SameBitsAtAnyNumberOfThreads)
{
    const Surface a = faceted(sphereFacets(1.0, 16));
    const Surface b = moved(faceted(sphereFacets(1.001, 13)), turned, turned);
    const auto run = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        CompareOptions options;
        options.share = 1e-4;
        return std::pair(compare(a, b, options), signedDistances(a, b));
    };
    const auto [one, signed_one] = run(1);
    const auto [many, signed_many] = run(7);
    expectEqual(one.from_a, many.from_a);
    expectEqual(one.from_b, many.from_b);
    expectEqual(one.symmetric, many.symmetric);
    expectEqual(one.normals.at, many.normals.at);
    EXPECT_EQ(one.normals.rms, many.normals.rms);
    EXPECT_EQ(signed_one, signed_many);
}

TEST(Compare, SignedDistancesAreNegativeInside)
{
    const Surface unit = box();
    // Points near faces, edges and corners, where the normal of a single facet can have the wrong sign.
    const std::vector<Vec3> outside = {{1.5, 0.5, 0.5}, {1.1, 1.3, 0.5}, {1.1, 1.01, 1.4}, {-0.2, 0.3, -0.001}};
    const std::vector<Vec3> inside = {{0.9, 0.5, 0.5}, {0.99, 0.98, 0.5}, {0.97, 0.98, 0.99}, {0.001, 0.5, 0.9}};
    const auto at = [](const std::vector<Vec3>& points) {
        Surface surface = testing::soup({{0, 1, 2}, {1, 2, 3}}, points.size());
        surface.vertices = points;
        return surface;
    };
    const std::vector<double> out = signedDistances(at(outside), unit);
    EXPECT_NEAR(out[0], 0.5, 1e-12);
    EXPECT_NEAR(out[1], std::hypot(0.1, 0.3), 1e-12);
    EXPECT_NEAR(out[2], std::hypot(0.1, 0.01, 0.4), 1e-12);
    EXPECT_NEAR(out[3], std::hypot(0.2, 0.001), 1e-12);
    const std::vector<double> in = signedDistances(at(inside), unit);
    EXPECT_NEAR(in[0], -0.1, 1e-12);
    EXPECT_NEAR(in[1], -0.01, 1e-12);
    EXPECT_NEAR(in[2], -0.01, 1e-12);
    EXPECT_NEAR(in[3], -0.001, 1e-12);
    // At the sharp edge of a dent the nearest triangles disagree.
    const std::vector<double> self = signedDistances(unit, unit);
    EXPECT_THAT(self, ::testing::Each(::testing::DoubleNear(0.0, 1e-15)));
}

TEST(Compare, RefusesInvalidSurfaces)
{
    const Surface sound = roundDroplet();
    const auto expect_refused = [&](const Surface& a, const Surface& b, const CompareOptions& options,
                                    const std::string& words) {
        try {
            (void)compare(a, b, options);
            ADD_FAILURE() << "was compared; expected the error: " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    };
    Surface broken = sound;
    broken.vertices[3].y = std::numeric_limits<double>::quiet_NaN();
    expect_refused(broken, sound, {}, "vertices[3] must be finite");
    expect_refused(sound, broken, {}, "vertices[3] must be finite");
    EXPECT_THROW((void)signedDistances(sound, broken), Error);
    broken = sound;
    broken.triangles[0][1] = 100000;
    expect_refused(sound, broken, {}, "names vertex 100000");
    broken = sound;
    broken.triangles.clear();
    expect_refused(sound, broken, {}, "triangles is empty");
    for (const double share : {0.0, 1.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        expect_refused(sound, sound, {.share = share}, "share");
    }
    for (const double tolerance : {-1e-9, std::numeric_limits<double>::infinity()}) {
        expect_refused(sound, sound, {.tolerance = tolerance}, "tolerance");
    }
    expect_refused(scaled(sound, 1e200), sound, {}, "too large");
}

}  // namespace
}  // namespace droplet
