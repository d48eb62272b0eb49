// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of ponds: they are closed, have the exact volume, and end where the level meets the ground.
#include "flow_io/pond_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "droplet/flow/flow_terrain.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/flow_io/flow_points.h"
#include "droplet/units.h"
#include "flow/hollow.h"
#include "support/objects.h"

namespace droplet {
namespace {

constexpr Vec3 kUp{0.0, 0.0, 1.0};
constexpr double kPuddle = 4e-3;

/// Ground of 12 cm with a height over every place.
FlowTerrain ground(const std::function<double(Vec2)>& height, std::uint32_t cells = 120)
{
    testing::Sheet sheet;
    sheet.columns = cells;
    sheet.rows = cells;
    sheet.turned = true;
    sheet.place = [&](Vec2 uv) {
        const Vec2 p{0.12 * (uv.x - 0.5), 0.12 * (uv.y - 0.5)};
        return Vec3{p.x, p.y, height(p)};
    };
    const TexturedMesh mesh = testing::meshOf(sheet);
    return FlowTerrain(flowSurface(mesh.vertices, mesh.triangles));
}

std::optional<Pond> pondAt(const FlowTerrain& terrain, Vec3 place, double volume, Vec3 up = kUp)
{
    const FlowTerrain::Point point = terrain.nearest(place);
    constexpr double kAngle = 90.0 * kDegree;
    const double radius = std::cbrt(1.5 * volume / std::numbers::pi);
    const auto filled = pondAround(terrain.surface(), up, {point.face, point.place, volume, radius, kAngle, kPuddle});
    return filled ? std::optional(filled->pond) : std::nullopt;
}

/// The mesh as a surface of its own.
Surface surfaceOf(const PondSurface& pond)
{
    Surface surface;
    surface.vertices = pond.vertices;
    surface.normals = pond.normals;
    surface.triangles = pond.triangles;
    surface.weld = pond.weld;
    surface.uvs.resize(surface.vertices.size());
    surface.contact_angle.resize(surface.vertices.size());
    return surface;
}

/// Whether the mesh is one closed pond of a volume that ends on the ground.
Topology checked(const FlowTerrain& terrain, const Pond& pond, double volume)
{
    const PondSurface made = pondSurface(terrain.surface(), pond);
    const Surface surface = surfaceOf(made);
    surface.validate();
    EXPECT_TRUE(isClosed(surface));
    EXPECT_NEAR(enclosedVolume(surface) / volume, 1.0, 1e-9);
    for (std::size_t v = 0; v < made.after.size(); ++v) {
        const Vec3 p = made.vertices[v];
        if (!pond.front) {
            EXPECT_NEAR(dot(pond.up, p), pond.level, 1e-9);
        }
        EXPECT_LT(length(terrain.nearest(p).place - p), 1e-9) << "the rim is on the ground";
    }
    for (std::size_t v = made.level_vertices; v < made.vertices.size(); ++v) {
        EXPECT_LT(length(terrain.nearest(made.vertices[v]).place - made.vertices[v]), 1e-9);
    }
    const Topology result = topology(surface);
    EXPECT_EQ(result.components, 1U);
    return result;
}

double distanceFrom(Vec2 p, Vec2 a, Vec2 b)
{
    const double share = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
    return length(p - a - share * (b - a));
}

/// A trench of 16 mm width and 10 mm depth along an L.
double trench(Vec2 p)
{
    const double away =
        std::min(distanceFrom(p, {-0.04, -0.04}, {-0.04, 0.04}), distanceFrom(p, {-0.04, -0.04}, {0.04, -0.04}));
    return std::clamp(2.0 * (away - 8e-3), 0.0, 10e-3);
}

// z = x²/(2 R) holds π R h² up to the height h, and its level has the area 2 π R h.
TEST(PondSurface, OfABowlIsLevel)
{
    constexpr double kRound = 40e-3;
    const FlowTerrain bowl = ground([](Vec2 p) { return dot(p, p) / (2.0 * kRound); });
    for (const double height : {8e-3, 15e-3}) {
        const double volume = std::numbers::pi * kRound * height * height;
        const auto pond = pondAt(bowl, {0.002, 0.001, 0.0}, volume);
        ASSERT_TRUE(pond);
        EXPECT_NEAR(pond->level / height, 1.0, 2e-3) << "chords of the mesh are over the bowl";
        EXPECT_NEAR(pond->area / (2.0 * std::numbers::pi * kRound * height), 1.0, 2e-3);
        EXPECT_EQ(pond->dome, 0.0);
        EXPECT_EQ(checked(bowl, *pond, volume).euler, 2);
    }
}

// A paraboloid cut by a slanted plane holds as much as by a level one as high over its lowest place, with its normal.
TEST(PondSurface, OfASloshingBowlIsNormalToWhatItFeels)
{
    constexpr double kRound = 40e-3;
    const FlowTerrain bowl = ground([](Vec2 p) { return dot(p, p) / (2.0 * kRound); });
    const double slope = std::tan(10.0 * kDegree);
    const Vec3 up = std::cos(10.0 * kDegree) * Vec3{-slope, 0.0, 1.0};
    const double height = 8e-3;  // along z over the place where the bowl has this slope
    const double volume = std::numbers::pi * kRound * height * height;
    const auto pond = pondAt(bowl, {slope * kRound, 0.0, 0.0}, volume, up);
    ASSERT_TRUE(pond);
    const Vec3 lowest{slope * kRound, 0.0, 0.5 * slope * slope * kRound};
    EXPECT_NEAR(pond->level, dot(up, lowest + height * kUp), 2e-3 * height);
    checked(bowl, *pond, volume);
}

TEST(PondSurface, OfATrenchGoesRoundTheCorner)
{
    const FlowTerrain terrain = ground(trench);
    for (const double volume : {14e-6, 18e-6}) {
        const auto pond = pondAt(terrain, {-0.04, 0.03, 0.0}, volume);
        ASSERT_TRUE(pond);
        EXPECT_FALSE(pond->front) << "it fills the trench";
        EXPECT_EQ(checked(terrain, *pond, volume).euler, 2);
        const PondSurface made = pondSurface(terrain.surface(), *pond);
        for (const Vec3 end : {Vec3{-0.04, 0.04, 0.0}, Vec3{0.04, -0.04, 0.0}, Vec3{-0.04, -0.04, 0.0}}) {
            const auto nearest = std::min_element(made.vertices.begin(), made.vertices.end(),
                                                  [&](Vec3 a, Vec3 b) { return length(a - end) < length(b - end); });
            EXPECT_LT(length(*nearest - end), 2e-3) << "no part is missing";
        }
    }
}

TEST(PondSurface, GoesAroundAnIsland)
{
    // A moat around a hill: its mesh has a hole.
    const auto moat = [](Vec2 p) { return std::min(2.0 * std::abs(length(p) - 0.03), 15e-3); };
    const FlowTerrain terrain = ground(moat);
    for (const double volume : {8e-6, 12e-6}) {
        const auto pond = pondAt(terrain, {0.03, 0.0, 0.0}, volume);
        ASSERT_TRUE(pond);
        EXPECT_EQ(checked(terrain, *pond, volume).euler, 0) << "a ring";
    }
}

TEST(PondSurface, GoesOverBumpsOfTheBottom)
{
    const auto bumpy = [](Vec2 p) {
        return std::max(std::abs(p.x), std::abs(p.y)) > 0.04 ? 20e-3
                                                             : 1.5e-3 * std::sin(300.0 * p.x) * std::sin(300.0 * p.y);
    };
    const FlowTerrain terrain = ground(bumpy);
    constexpr double kVolume = 60e-6;
    const auto pond = pondAt(terrain, {0.011, 0.01, 0.0}, kVolume);
    ASSERT_TRUE(pond);
    EXPECT_GT(pond->area, 0.9 * 0.08 * 0.08);
    checked(terrain, *pond, kVolume);
}

TEST(PondSurface, StandsOverItsBrimAsADome)
{
    // A pit of 20 mm width in a table: what it does not hold stands over it.
    const auto pit = [](Vec2 p) { return length(p) < 10e-3 ? -6e-3 : 0.0; };
    const FlowTerrain terrain = ground(pit);
    const auto full = pondAt(terrain, {0.0, 0.0, -6e-3}, 2.5e-6);
    ASSERT_TRUE(full);
    EXPECT_GT(full->dome, 0.0);
    EXPECT_NEAR(full->level, 0.0, 1e-12);
    checked(terrain, *full, 2.5e-6);
    const PondSurface made = pondSurface(terrain.surface(), *full);
    double highest = 0.0;
    for (std::size_t v = 0; v < made.level_vertices; ++v) {
        highest = std::max(highest, made.vertices[v].z);
        EXPECT_GE(made.vertices[v].z, -1e-12);
    }
    EXPECT_GT(highest, full->dome / full->area) << "it is highest in the middle";
    EXPECT_LT(highest, 3.0 * full->dome / full->area);
}

// A round flask with a neck: its widest place is below the level.
TEST(PondSurface, StaysInAFlask)
{
    constexpr std::uint32_t kSides = 48;
    constexpr double kRadius = 25e-3;
    std::vector<Vec3> vertices{{0.0, 0.0, -kRadius}};
    std::vector<Triangle> triangles;
    constexpr std::uint32_t kRings = 20;
    for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
        const double tilt = 0.85 * std::numbers::pi * ring / kRings;
        for (std::uint32_t k = 0; k < kSides; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / kSides;
            vertices.push_back(
                kRadius * Vec3{std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), -std::cos(tilt)});
        }
    }
    for (std::uint32_t k = 0; k < kSides; ++k) {
        const std::uint32_t next = (k + 1) % kSides;
        triangles.push_back({0, 1 + k, 1 + next});
        for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
            const std::uint32_t from = 1 + ring * kSides;
            triangles.push_back({from + k, from + kSides + k, from + kSides + next});
            triangles.push_back({from + k, from + kSides + next, from + next});
        }
    }
    const FlowTerrain flask(flowSurface(vertices, triangles));
    const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3);
    const double volume = 0.8 * ball;
    const auto pond = pondAt(flask, {0.0, 0.0, -kRadius}, volume);
    ASSERT_TRUE(pond);
    EXPECT_GT(pond->level, 0.2 * kRadius);
    checked(flask, *pond, volume);
    const PondSurface made = pondSurface(flask.surface(), *pond);
    for (const Vec3 p : made.vertices) {
        EXPECT_LE(length(p), kRadius * (1.0 + 1e-9));
    }
}

TEST(PondSurface, DropletsOnWideGroundAreNoPonds)
{
    const FlowTerrain bowl = ground([](Vec2 p) { return dot(p, p) / (2.0 * 0.2); });
    EXPECT_FALSE(pondAt(bowl, {0.0, 0.0, 0.0}, 20e-9)) << "a droplet on a gentle bend";
    const FlowTerrain tray = ground([](Vec2 p) { return std::max(std::abs(p.x), std::abs(p.y)) > 0.04 ? 10e-3 : 0.0; });
    EXPECT_FALSE(pondAt(tray, {0.0, 0.0, 0.0}, 1e-6)) << "a puddle in a tray";
    EXPECT_FALSE(pondAt(tray, {0.0, 0.0, 0.0}, 1e-3)) << "a flood";
    EXPECT_TRUE(pondAt(tray, {0.0, 0.0, 0.0}, 50e-6));
}

// Liquid that does not cover the floor of a trench lies between its walls, and not as a disc through them.
TEST(PondSurface, OfAPuddleLiesBetweenWalls)
{
    const FlowTerrain terrain = ground(trench);
    for (const double volume : {1.8e-6, 3e-6, 6e-6, 9e-6}) {
        const auto pond = pondAt(terrain, {-0.04, 0.02, 0.0}, volume);
        ASSERT_TRUE(pond);
        ASSERT_TRUE(pond->front);
        EXPECT_EQ(checked(terrain, *pond, volume).euler, 2);
        EXPECT_LE(pond->level, kPuddle * (1.0 + 1e-9));
        const PondSurface made = pondSurface(terrain.surface(), *pond);
        double highest = 0.0;
        double longest = 0.0;
        for (std::size_t v = 0; v < made.level_vertices; ++v) {
            const Vec3 p = made.vertices[v];
            EXPECT_LT(trench({p.x, p.y}), p.z + 1e-3) << "not in the walls";
            highest = std::max(highest, p.z);
            longest = std::max(longest, 0.02 - p.y + std::max(p.x + 0.04, 0.0));
        }
        EXPECT_LT(highest, 1.35 * kPuddle);
        // A strip of this width and height, and its bends.
        EXPECT_GT(longest, 0.4 * volume / (16e-3 * kPuddle));
    }
    EXPECT_FALSE(pondAt(terrain, {-0.04, 0.02, 0.0}, 0.1e-6)) << "it touches no wall";
}

// Two faces of the floor that meet in a corner are left out: the rim touches itself there, below the liquid.
TEST(PondSurface, OfAPuddleWhoseRimTouchesItselfIsValid)
{
    const FlowTerrain terrain = ground(trench);
    auto pond = pondAt(terrain, {-0.04, 0.02, 0.0}, 6e-6);
    ASSERT_TRUE(pond && pond->front);
    const auto& faces = terrain.surface().faces;
    const auto common = [&](std::uint32_t a, std::uint32_t b) {
        std::size_t count = 0;
        for (const Vec3 p : faces[a].corners) {
            count += static_cast<std::size_t>(std::count(faces[b].corners.begin(), faces[b].corners.end(), p));
        }
        return count;
    };
    const std::uint32_t middle = terrain.nearest({-0.04, 0.02, 0.0}).face;
    const auto leave_out = [&](std::uint32_t face) {
        const auto at = std::find(pond->faces.begin(), pond->faces.end(), face);
        ASSERT_NE(at, pond->faces.end());
        pond->front->sources.erase(pond->front->sources.begin() + (at - pond->faces.begin()));
        pond->faces.erase(at);
    };
    const auto opposite = std::find_if(pond->faces.begin(), pond->faces.end(),
                                       [&](std::uint32_t face) { return common(face, middle) == 1; });
    ASSERT_NE(opposite, pond->faces.end());
    leave_out(*opposite);
    leave_out(middle);
    const Surface surface = surfaceOf(pondSurface(terrain.surface(), *pond));
    EXPECT_NO_THROW(surface.validate());
}

TEST(PondSurface, InACornerIsASectorAsThickAsOnFlatGround)
{
    const FlowTerrain tray = ground([](Vec2 p) { return std::max(std::abs(p.x), std::abs(p.y)) > 0.04 ? 10e-3 : 0.0; });
    const double volume = 12e-6;
    const auto pond = pondAt(tray, {0.039, 0.039, 0.0}, volume);
    ASSERT_TRUE(pond);
    ASSERT_TRUE(pond->front);
    EXPECT_EQ(checked(tray, *pond, volume).euler, 2);
    // The bend along its front takes a third of its width from a sector.
    const PondFront& front = *pond->front;
    const double sector = 0.25 * std::numbers::pi * std::pow(front.way - front.bend / 3.0, 2);
    EXPECT_NEAR(kPuddle * sector / volume, 1.0, 0.12);
    const PondSurface made = pondSurface(tray.surface(), *pond);
    for (std::size_t v = 0; v < made.after.size(); ++v) {
        const Vec3 p = made.vertices[v];
        if (std::max(p.x, p.y) < 0.0395) {
            EXPECT_NEAR(std::hypot(p.x - 0.039, p.y - 0.039) / front.way, 1.0, 0.01) << "its front is round";
        }
    }
}

// From a droplet in a trench to a full one: volume, level and area go on without a jump.
TEST(PondSurface, GrowsWithoutAJump)
{
    const FlowTerrain terrain = ground(trench);
    double last_area = 0.0;
    double last_level = 0.0;
    bool was_puddle = false;
    bool was_full = false;
    constexpr double kStep = 1.02;
    for (double volume = 1.8e-6; volume < 20e-6; volume *= kStep) {
        const auto pond = pondAt(terrain, {-0.04, 0.02, 0.0}, volume);
        ASSERT_TRUE(pond) << volume;
        EXPECT_FALSE(was_full && pond->front);
        was_puddle = was_puddle || pond->front;
        was_full = was_full || !pond->front;
        if (last_area > 0.0) {
            // Where the front comes to a wall, the area grows as the square root.
            EXPECT_LT(std::abs(pond->area / last_area - 1.0), 0.06) << volume;
            EXPECT_LT(std::abs(pond->level - last_level), 0.03 * kPuddle) << volume;
        }
        last_area = pond->area;
        last_level = pond->level;
    }
    EXPECT_TRUE(was_puddle && was_full);
}

// The arms of a U are near each other, but water goes around the bend: as far as the way is, not as the crow flies.
TEST(PondSurface, FollowsTheWayAroundWalls)
{
    const auto u = [](Vec2 p) {
        const double away =
            std::min({distanceFrom(p, {-0.012, -0.03}, {-0.012, 0.04}), distanceFrom(p, {0.012, -0.03}, {0.012, 0.04}),
                      distanceFrom(p, {-0.012, -0.03}, {0.012, -0.03})});
        return std::clamp(4.0 * (away - 7e-3), 0.0, 10e-3);
    };
    const FlowTerrain terrain = ground(u, 160);
    const auto pond = pondAt(terrain, {-0.012, 0.03, 0.0}, 3e-6);
    ASSERT_TRUE(pond);
    ASSERT_TRUE(pond->front);
    checked(terrain, *pond, 3e-6);
    const PondSurface made = pondSurface(terrain.surface(), *pond);
    for (const Vec3 p : made.vertices) {
        EXPECT_LT(p.x, 0.0) << "the other arm is dry";
    }
}

TEST(PondSurface, IsAmongSeatedDropletsAndPoints)
{
    const FlowTerrain terrain = ground(trench);
    const DropletBodies bodies(BodyShape::Capillary);
    const Vec3 gravity{0.0, 0.0, -kStandardGravity};
    FlowSample sample;
    sample.contact = FlowContact::Still;
    sample.normal = kUp;
    const FlowTerrain::Point bottom = terrain.nearest({-0.04, 0.03, 0.0});
    sample.face = bottom.face;
    sample.place = bottom.place;
    sample.volume = 12e-6;
    sample.pond = pondAt(terrain, sample.place, sample.volume);
    ASSERT_TRUE(sample.pond);
    FlowSample droplet = sample;
    droplet.pond.reset();
    droplet.volume = 10e-9;
    droplet.place = {0.03, 0.03, 10e-3};
    droplet.face = terrain.nearest(droplet.place).face;
    const std::vector<FlowSample> samples{sample, droplet};
    const SeatedDroplets seated = seatedDroplets(terrain, samples, {bodies, gravity});
    seated.surface.validate();
    EXPECT_TRUE(isClosed(seated.surface));
    EXPECT_EQ(topology(seated.surface).components, 2U);
    EXPECT_NEAR(seated.volumes[0] / sample.volume, 1.0, 1e-9);
    EXPECT_NEAR(seated.volumes[1] / droplet.volume, 1.0, 0.01);
    const std::vector<FlowPoint> points = flowPoints(samples, terrain, bodies, gravity);
    EXPECT_NEAR(std::numbers::pi * points[0].radius * points[0].radius / sample.pond->area, 1.0, 1e-12);
    EXPECT_EQ(points[0].elongation, 1.0);
    EXPECT_LT(points[1].radius, 3e-3);
}

}  // namespace
}  // namespace droplet
