// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/spring_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <vector>

namespace droplet {
namespace {

std::vector<Vec3> level(const SpringNetwork& network, const std::vector<Vec3>& points, std::size_t i)
{
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>((i - 1) * network.slices);
    return {begin, i > network.levels ? begin + 1 : begin + static_cast<std::ptrdiff_t>(network.slices)};
}

Vec3 centreOf(const std::vector<Vec3>& points)
{
    Vec3 sum;
    for (const Vec3 p : points) {
        sum = sum + p;
    }
    return (1.0 / static_cast<double>(points.size())) * sum;
}

/// Volume of the stack of levels over the basis: every prismoid between two levels exactly.
double stackVolume(const SpringNetwork& network, const std::vector<Vec3>& points)
{
    const auto areaOf = [](const std::vector<Vec3>& polygon) {
        double twice = 0.0;
        for (std::size_t j = 0; j < polygon.size(); ++j) {
            twice += cross(polygon[j], polygon[(j + 1) % polygon.size()]).z;
        }
        return 0.5 * twice;
    };
    double volume = 0.0;
    for (std::size_t i = 1; i <= network.levels; ++i) {
        const std::vector<Vec3> lower = level(network, points, i);
        std::vector<Vec3> upper = level(network, points, i + 1);
        upper.resize(lower.size(), upper.front());
        std::vector<Vec3> middle(lower.size());
        for (std::size_t j = 0; j < lower.size(); ++j) {
            middle[j] = 0.5 * (lower[j] + upper[j]);
        }
        volume += (upper[0].z - lower[0].z) / 6.0 * (areaOf(lower) + 4.0 * areaOf(middle) + areaOf(upper));
    }
    return volume;
}

/// Networks of several sizes under forces in several directions.
std::vector<SpringNetwork> networks()
{
    std::vector<SpringNetwork> all;
    for (const std::size_t slices : std::initializer_list<std::size_t>{3, 4, 7, 8}) {
        for (const std::size_t levels : std::initializer_list<std::size_t>{1, 2, 3, 5}) {
            for (const Vec3 force : {Vec3{}, Vec3{0.02, 0.0, 0.0}, Vec3{-0.01, 0.015, -0.01}}) {
                SpringNetwork network;
                network.slices = slices;
                network.levels = levels;
                network.radius = 1.3;
                network.volume = 2.1;
                network.longitudinal = 0.8;
                network.transverse = 6.0;
                network.force = force;
                all.push_back(network);
            }
        }
    }
    return all;
}

TEST(SpringBody, LevelsAreTheBasisScaledAndShifted)
{
    for (const SpringNetwork& network : networks()) {
        const std::vector<Vec3> points = balance(network).points;
        const std::vector<Vec3> basis = level(network, points, 1);
        for (std::size_t i = 2; i <= network.levels; ++i) {
            const std::vector<Vec3> one = level(network, points, i);
            const Vec3 shift = centreOf(one) - levelScale(network, i) * centreOf(basis);
            for (std::size_t j = 0; j < network.slices; ++j) {
                const Vec3 error = one[j] - levelScale(network, i) * basis[j] - shift;
                EXPECT_LE(length(error), 1e-9) << network.slices << " " << network.levels << " " << i;
            }
        }
    }
}

TEST(SpringBody, AllForcesBalance)
{
    // Springs by their definition, above the basis, where no force is a reaction.
    for (const SpringNetwork& network : networks()) {
        const SpringBalance balanced = balance(network);
        const auto at = [&](std::size_t i, std::size_t j) {
            return i > network.levels ? balanced.points.back()
                                      : balanced.points[(i - 1) * network.slices + j % network.slices];
        };
        const double side = 2.0 * network.radius * std::sin(std::numbers::pi / static_cast<double>(network.slices));
        const auto pull = [](Vec3 from, Vec3 to, double stiffness, double rest) {
            const double now = length(to - from);
            return stiffness * (now - rest) / now * (to - from);
        };
        const auto slices = static_cast<double>(network.slices);
        for (std::size_t i = 2; i <= network.levels; ++i) {
            const double size = levelScale(network, i);
            for (std::size_t j = 0; j < network.slices; ++j) {
                Vec3 sum = network.force + Vec3{0.0, 0.0, balanced.pressure * levelWeight(network, i) / slices};
                sum = sum + pull(at(i, j), at(i + 1, j), network.longitudinal, 0.0) +
                      pull(at(i, j), at(i - 1, j), network.longitudinal, 0.0) +
                      pull(at(i, j), at(i, j + 1), network.transverse * size, size * side) +
                      pull(at(i, j), at(i, j + network.slices - 1), network.transverse * size, size * side);
                EXPECT_LE(length(sum), 1e-10);
            }
        }
        Vec3 apex = network.force + Vec3{0.0, 0.0, balanced.pressure};
        for (std::size_t j = 0; j < network.slices; ++j) {
            apex = apex + pull(balanced.points.back(), at(network.levels, j), network.longitudinal, 0.0);
            EXPECT_NEAR(length(at(1, j + 1) - at(1, j)), side, 1e-11);
            EXPECT_EQ(at(1, j).z, 0.0);
            EXPECT_GT(balanced.rods[j], 0.0) << "the guide point pushes outward";
        }
        EXPECT_LE(length(apex), 1e-10);
    }
}

TEST(SpringBody, VolumeIsTheWeightedSumOfHeights)
{
    for (const SpringNetwork& network : networks()) {
        const std::vector<Vec3> points = balance(network).points;
        EXPECT_NEAR(stackVolume(network, points), network.volume, 1e-9);
    }
    // N = 1 is S h/3; N = 2 with a cone also.
    SpringNetwork network;
    network.levels = 1;
    EXPECT_EQ(levelWeight(network, 2), 1.0);
    network.levels = 2;
    EXPECT_EQ((levelWeight(network, 2) * 0.5 + levelWeight(network, 3)) / 12.0, 1.0 / 3.0);
}

TEST(SpringBody, WithoutForceHeightsFollowACubic)
{
    // Increments are as the solco weights above them: 1, 1 + 6, 1 + 6 + 12 … = i³ − (i − 1)³.
    SpringNetwork network;
    network.levels = 5;
    const std::vector<Vec3> points = balance(network).points;
    for (std::size_t i = 1; i <= network.levels; ++i) {
        const double s = levelScale(network, i);
        EXPECT_NEAR(level(network, points, i)[0].z, points.back().z * (1.0 - s * s * s), 1e-11);
    }
}

TEST(SpringBody, MoreLiquidIsMoreVolume)
{
    SpringNetwork network;
    double last = 0.0;
    for (const double volume : {0.5, 1.0, 2.0, 4.0}) {
        network.volume = volume;
        const double height = balance(network).points.back().z;
        EXPECT_GT(height, last);
        last = height;
    }
}

TEST(SpringBody, ThreeForcesOfThePaper)
{
    // Figure 6, N = 2 and M = 3: perpendicular, to the left, to the right.
    SpringNetwork network;
    network.slices = 3;
    network.levels = 2;
    network.force = {0.0, 0.0, -0.05};
    const std::vector<Vec3> pressed = balance(network).points;
    network.force = {0.0, -0.05, 0.0};
    const std::vector<Vec3> left = balance(network).points;
    network.force = {0.0, 0.05, 0.0};
    const std::vector<Vec3> right = balance(network).points;
    EXPECT_NEAR(pressed.back().x, 0.0, 1e-12);
    EXPECT_NEAR(pressed.back().y, 0.0, 1e-12);
    EXPECT_LT(left.back().y, -0.02);
    // Slices 1 and 2 are mirror images of each other.
    for (const std::size_t i : std::initializer_list<std::size_t>{0, 1}) {
        for (std::size_t j = 0; j < 3; ++j) {
            const Vec3 a = left[i * 3 + j];
            const Vec3 b = right[i * 3 + (3 - j) % 3];
            EXPECT_LE(length(Vec3{a.x, -a.y, a.z} - b), 1e-11);
        }
    }
    EXPECT_LE(length(Vec3{left.back().x, -left.back().y, left.back().z} - right.back()), 1e-11);
}

TEST(SpringBody, IsAffineInTheForce)
{
    SpringNetwork network;
    const std::vector<Vec3> rest = balance(network).points;
    network.force = {0.01, -0.02, 0.005};
    const std::vector<Vec3> once = balance(network).points;
    network.force = 2.0 * network.force;
    const std::vector<Vec3> twice = balance(network).points;
    for (std::size_t p = 0; p < rest.size(); ++p) {
        EXPECT_LE(length(twice[p] - 2.0 * once[p] + rest[p]), 1e-9);
    }
}

TEST(SpringBody, SkinIsSmooth)
{
    // A cubic spline of a regular polygon is nearly a circle; at the apex it is horizontal, so heights fall evenly.
    const SpringNetwork network;
    BodyGrid grid = skin(network, balance(network).points);
    close(grid);
    const double reach = std::hypot(grid.x[0][1], grid.y[0][1]);
    for (std::size_t j = 1; j <= kBodySlices; ++j) {
        EXPECT_NEAR(std::hypot(grid.x[0][j], grid.y[0][j]), reach, 0.02 * reach);
        EXPECT_NEAR(grid.z[kBodyRings - 1][j], grid.z[kBodyRings - 1][1], 1e-9);
        EXPECT_EQ(grid.z[0][j], 0.0);
        for (std::size_t k = 1; k < kBodyRings; ++k) {
            EXPECT_GT(grid.z[k][j], grid.z[k - 1][j]);
        }
    }
}

}  // namespace
}  // namespace droplet
