// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/streak_ribbons.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "droplet/error.h"

namespace droplet {
namespace {

constexpr double kWidth = 4e-3;

/// A level strip along x that bends down at x = 0.1 by an angle.
FlowSurface roof(double angle)
{
    const double x = 0.1 + 0.1 * std::cos(angle);
    const double z = -0.1 * std::sin(angle);
    return flowSurface(
        {{0.0, -0.1, 0.0}, {0.1, -0.1, 0.0}, {0.1, 0.1, 0.0}, {0.0, 0.1, 0.0}, {x, -0.1, z}, {x, 0.1, z}},
        {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}});
}

/// Face of a roof whose triangle in the mesh has a number.
std::uint32_t faceOf(const FlowSurface& surface, std::uint32_t source)
{
    std::uint32_t face = 0;
    while (surface.faces[face].source != source) {
        ++face;
    }
    return face;
}

/// A droplet that runs over the level half of a roof at 0.1 m/s, in pieces.
std::vector<FlowTrack> levelRun(const FlowSurface& surface, int pieces, std::uint64_t id = 1)
{
    std::vector<FlowTrack> tracks;
    for (int k = 0; k < pieces; ++k) {
        const double from = 0.01 + 0.09 * k / pieces;
        const double to = 0.01 + 0.09 * (k + 1) / pieces;
        tracks.push_back({id, faceOf(surface, 0), {from, -0.05, 0.0}, {to, -0.05, 0.0}, kWidth, (to - 0.01) / 0.1});
    }
    return tracks;
}

double areaOf(const Surface& surface)
{
    double area = 0.0;
    for (const auto& [a, b, c] : surface.triangles) {
        const Vec3 twice = cross(surface.vertices[b] - surface.vertices[a], surface.vertices[c] - surface.vertices[a]);
        area += 0.5 * length(twice);
        EXPECT_GE(dot(twice, surface.normals[a]), -1e-18) << "wound outward";
    }
    return area;
}

TEST(StreakRibbons, CoverThePathOfADroplet)
{
    const FlowSurface surface = roof(0.5);
    StreakRibbons ribbons({.thickness = 1e-5});
    ribbons.add(levelRun(surface, 200), surface);
    const Surface made = ribbons.mesh(0.9).surface;
    made.validate();
    EXPECT_EQ(topology(made).components, 1U);
    const double exact = kWidth * (0.09 - kWidth) + 0.25 * std::numbers::pi * kWidth * kWidth;
    EXPECT_NEAR(areaOf(made) / exact, 1.0, 0.01);
    EXPECT_LT(made.triangles.size(), 400U) << "straight paths need few points";
    for (std::size_t i = 0; i < made.vertices.size(); ++i) {
        EXPECT_GT(made.vertices[i].z, 0.0);
        EXPECT_LE(made.vertices[i].z, 1e-5);
        EXPECT_LE(std::abs(made.vertices[i].y + 0.05), 0.5 * kWidth + 1e-12);
        EXPECT_GE(made.uvs[i].x, 0.0);
        EXPECT_LE(made.uvs[i].x, 1.0);
        EXPECT_NEAR(made.normals[i].z, 1.0, 1e-3);
    }
    // The ends are points, so nothing looks cut off.
    EXPECT_EQ(made.vertices[0].y, made.vertices[2].y);
}

TEST(StreakRibbons, JoinPiecesOverAnEdgeButNotOverAFlight)
{
    const double angle = 0.5;
    const FlowSurface surface = roof(angle);
    const Vec3 down{std::cos(angle), 0.0, -std::sin(angle)};
    const Vec3 edge{0.1, -0.05, 0.0};
    StreakRibbons ribbons;
    ribbons.add(levelRun(surface, 20), surface);
    ribbons.add(std::vector<FlowTrack>{{1, faceOf(surface, 2), edge, edge + 0.05 * down, kWidth, 1.2}}, surface);
    const Surface joined = ribbons.mesh(1.2).surface;
    EXPECT_EQ(topology(joined).components, 1U);
    areaOf(joined);
    ribbons.add(std::vector<FlowTrack>{{1, faceOf(surface, 2), edge + 0.06 * down, edge + 0.09 * down, kWidth, 1.5},
                                       {2, faceOf(surface, 2), edge, edge + 0.0001 * down, kWidth, 1.5}},
                surface);
    EXPECT_EQ(topology(ribbons.mesh(1.5).surface).components, 2U) << "the second droplet hardly moved";
}

TEST(StreakRibbons, StayWholeWhereDropletsMerge)
{
    const FlowSurface surface = roof(0.5);
    std::vector<FlowTrack> tracks = levelRun(surface, 90);
    for (std::size_t i = 45; i < tracks.size(); ++i) {
        tracks[i].from.y += 0.3 * kWidth;
        tracks[i].to.y += 0.3 * kWidth;
    }
    StreakRibbons ribbons;
    ribbons.add(tracks, surface);
    EXPECT_EQ(topology(ribbons.mesh(0.9).surface).components, 1U);
}

TEST(StreakRibbons, DryFromTheirBegin)
{
    const FlowSurface surface = roof(0.5);
    StreakRibbons ribbons({.drying = 0.3});
    ribbons.add(levelRun(surface, 90), surface);
    const auto shortest = [&](double time) {
        const Surface made = ribbons.mesh(time).surface;
        double x = 1.0;
        for (const Vec3& p : made.vertices) {
            x = std::min(x, p.x);
        }
        return x;
    };
    EXPECT_NEAR(shortest(0.9), 0.01 + 0.1 * 0.6, 1e-3);
    EXPECT_NEAR(shortest(1.0), 0.01 + 0.1 * 0.7, 1e-3);
    EXPECT_TRUE(ribbons.mesh(1.3).surface.triangles.empty());
    EXPECT_TRUE(ribbons.mesh(1.3).surface.vertices.empty());
}

TEST(StreakRibbons, RejectOptionsOutOfRange)
{
    EXPECT_THROW(StreakRibbons({.drying = 0.0}), Error);
    EXPECT_THROW(StreakRibbons({.thickness = -1.0}), Error);
}

}  // namespace
}  // namespace droplet
