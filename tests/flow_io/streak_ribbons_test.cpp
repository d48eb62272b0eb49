// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/streak_ribbons.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "droplet/error.h"
#include "droplet/flow/flow_shapes.h"

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
        tracks.push_back(
            {id, faceOf(surface, 0), {from, -0.05, 0.0}, {to, -0.05, 0.0}, kWidth, (to - 0.01) / 0.1, 0.1});
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

/// A film that does not drain.
constexpr TrailFilm kLasting{.thickness = 1e-5, .kinematic_viscosity = 1e3};

// Where a way turns on less than its width, as around the neck of a flask, cross-sections must not cross.
TEST(StreakRibbons, HaveNoFoldsInTurns)
{
    const FlowSurface surface = roof(0.5);
    for (const double turn : {0.3, 0.7, 1.2, 2.0}) {
        std::vector<FlowTrack> tracks;
        Vec3 at{0.03, -0.05, 0.0};
        double direction = 0.0;
        for (int k = 0; k < 40; ++k) {
            // A bow to the left, one to the right, and zigzags.
            direction += k < 16 ? turn : k < 32 ? -turn : (k % 2 == 0 ? turn : -turn);
            const Vec3 to = at + 0.3 * kWidth * Vec3{std::cos(direction), std::sin(direction), 0.0};
            tracks.push_back({1, faceOf(surface, 0), at, to, kWidth, 0.02 * (k + 1), 0.0});
            at = to;
        }
        StreakRibbons ribbons(kLasting);
        ribbons.add(tracks, surface);
        const Surface made = ribbons.mesh(0.9).surface;
        made.validate();
        ASSERT_GT(made.triangles.size(), 100U);
        for (const auto& [a, b, c] : made.triangles) {
            const Vec3 across = cross(made.vertices[b] - made.vertices[a], made.vertices[c] - made.vertices[a]);
            EXPECT_GE(across.z, -1e-15) << "turn " << turn;
        }
    }
}

TEST(StreakRibbons, CoverThePathOfADropletThatStandsStill)
{
    const FlowSurface surface = roof(0.5);
    std::vector<FlowTrack> tracks = levelRun(surface, 200);
    for (FlowTrack& track : tracks) {
        track.speed = 0.0;
    }
    StreakRibbons ribbons(kLasting);
    ribbons.add(tracks, surface);
    const Surface made = ribbons.mesh(0.9).surface;
    made.validate();
    EXPECT_EQ(topology(made).components, 1U);
    const double exact = kWidth * (0.09 - kWidth) + 0.25 * std::numbers::pi * kWidth * kWidth;
    EXPECT_NEAR(areaOf(made) / exact, 1.0, 0.01);
    double volume = 0.0;
    for (const auto& [a, b, c] : made.triangles) {
        const Vec3& p = made.vertices[a];
        const Vec3 across = cross(made.vertices[b] - p, made.vertices[c] - p);
        volume += 0.5 * across.z * (p.z + made.vertices[b].z + made.vertices[c].z) / 3.0;
    }
    EXPECT_NEAR(volume / (1e-5 * exact), 1.0, 0.06) << "a tenth of its height is under its sides, too";
    for (std::size_t i = 0; i < made.vertices.size(); ++i) {
        EXPECT_GT(made.vertices[i].z, 0.0);
        EXPECT_LE(made.vertices[i].z, 1.5e-5 * (1.0 + 1e-9));
        EXPECT_LE(std::abs(made.vertices[i].y + 0.05), 0.5 * kWidth + 1e-12);
        EXPECT_GE(made.uvs[i].x, 0.0);
        EXPECT_LE(made.uvs[i].x, 1.0);
        EXPECT_NEAR(made.normals[i].z, 1.0, 1e-3);
    }
    // The ends are points, so nothing looks cut off.
    EXPECT_EQ(made.vertices[0].y, made.vertices[4].y);
}

TEST(StreakRibbons, NarrowAndBreakUpBehindTheDroplet)
{
    const FlowSurface surface = roof(0.5);
    StreakRibbons ribbons(kLasting);
    ribbons.add(levelRun(surface, 200), surface);
    const Surface made = ribbons.mesh(0.9).surface;
    made.validate();
    areaOf(made);
    const auto widest = [&](double from, double to) {
        double half = 0.0;
        for (const Vec3& p : made.vertices) {
            half = p.x > from && p.x < to ? std::max(half, std::abs(p.y + 0.05)) : half;
        }
        return 2.0 * half;
    };
    EXPECT_GT(widest(0.096, 0.099), 0.65 * kWidth);
    EXPECT_LT(widest(0.083, 0.092), 0.65 * kWidth);
    EXPECT_LT(widest(0.0, 0.08), 0.6 * kWidth);
    EXPECT_GT(topology(made).components, 1U);
    // With beads, nothing else is left far behind.
    TrailFilm film = kLasting;
    film.becomes_beads = true;
    StreakRibbons tail(film);
    tail.add(levelRun(surface, 200), surface);
    for (const Vec3& p : tail.mesh(0.9).surface.vertices) {
        EXPECT_GT(p.x, 0.1 - 7.0 * kWidth);
    }
    EXPECT_TRUE(tail.mesh(2.0).surface.triangles.empty());
}

TEST(StreakRibbons, GrowUncutAtFrames)
{
    const FlowSurface surface = roof(0.5);
    TrailFilm film = kLasting;
    film.becomes_beads = true;
    StreakRibbons ribbons(film);
    ribbons.add(levelRun(surface, 20), surface);
    const StreakMesh made = ribbons.growing(0.1);
    ASSERT_EQ(made.wetted.size(), made.surface.triangles.size());
    ASSERT_EQ(made.gone.size(), made.surface.triangles.size());
    for (std::size_t i = 0; i < made.wetted.size(); ++i) {
        double least = 1.0;
        double most = 0.0;
        for (const std::uint32_t v : made.surface.triangles[i]) {
            const double time = (made.surface.vertices[v].x - 0.01) / 0.1;
            least = std::min(least, time);
            most = std::max(most, time);
        }
        EXPECT_LE(std::ceil(most / 0.1 - 1e-9), std::floor(least / 0.1 + 1e-9) + 1.0);
        EXPECT_NEAR(made.wetted[i], most, 1e-9);
        const double shown = (made.gone[i] - made.wetted[i]) / (6.0 * kWidth / 0.1);
        EXPECT_GE(shown, 1.0);
        EXPECT_LE(shown, std::sqrt(2.0));
    }
}

TEST(StreakRibbons, JoinPiecesOverAnEdgeButNotOverAFlight)
{
    const double angle = 0.5;
    const FlowSurface surface = roof(angle);
    const Vec3 down{std::cos(angle), 0.0, -std::sin(angle)};
    const Vec3 edge{0.1, -0.05, 0.0};
    StreakRibbons ribbons(kLasting);
    std::vector<FlowTrack> level = levelRun(surface, 20);
    for (FlowTrack& track : level) {
        track.speed = 0.0;
    }
    ribbons.add(level, surface);
    ribbons.add(std::vector<FlowTrack>{{1, faceOf(surface, 2), edge, edge + 0.05 * down, kWidth, 1.2, 0.0}}, surface);
    const Surface joined = ribbons.mesh(1.2).surface;
    EXPECT_EQ(topology(joined).components, 1U);
    areaOf(joined);
    ribbons.add(
        std::vector<FlowTrack>{{1, faceOf(surface, 2), edge + 0.06 * down, edge + 0.09 * down, kWidth, 1.5, 0.0},
                               {2, faceOf(surface, 2), edge, edge + 0.0001 * down, kWidth, 1.5, 0.0}},
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
    for (FlowTrack& track : tracks) {
        track.speed = 0.0;
    }
    StreakRibbons ribbons(kLasting);
    ribbons.add(tracks, surface);
    EXPECT_EQ(topology(ribbons.mesh(0.9).surface).components, 1U);
}

TEST(StreakRibbons, DryFromTheirBegin)
{
    const FlowSurface surface = roof(0.5);
    StreakRibbons ribbons({.drying = 0.3});
    std::vector<FlowTrack> tracks = levelRun(surface, 90);
    for (FlowTrack& track : tracks) {
        track.speed = 0.0;
    }
    ribbons.add(tracks, surface);
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
    EXPECT_THROW(StreakRibbons({.kinematic_viscosity = 0.0}), Error);
}

TEST(StreakRibbons, GoWithTheSurface)
{
    const std::vector<Vec3> vertices{{0.0, -0.1, 0.0}, {0.1, -0.1, 0.0}, {0.1, 0.1, 0.0}, {0.0, 0.1, 0.0}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
    const auto upright = [](Vec3 p) { return Vec3{p.x + 0.1, -p.z, p.y + 0.3}; };
    std::vector<Vec3> moved;
    for (const Vec3 p : vertices) {
        moved.push_back(upright(p));
    }
    FlowShapes shapes(flowSurface(vertices, triangles), triangles, {vertices, moved}, 24.0);
    const FlowSurface& surface = shapes.first().surface();
    StreakRibbons ribbons;
    ribbons.add(levelRun(surface, 20), surface);
    const Surface flat = ribbons.mesh(1.2).surface;
    const Surface made = ribbons.mesh(1.2, &shapes.at(1)->surface()).surface;
    ASSERT_EQ(made.triangles, flat.triangles) << "it breaks up at the same places";
    ASSERT_GT(flat.triangles.size(), 100U);
    for (std::size_t v = 0; v < flat.vertices.size(); ++v) {
        EXPECT_LT(length(made.vertices[v] - upright(flat.vertices[v])), 1e-12);
    }
}

}  // namespace
}  // namespace droplet
