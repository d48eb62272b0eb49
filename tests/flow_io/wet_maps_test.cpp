// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/wet_maps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "droplet/error.h"
#include "droplet/flow/flow_shapes.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/units.h"

namespace droplet {
namespace {

constexpr double kSide = 40e-3;  ///< of the sheet [m]
constexpr int kSize = 200;       ///< of its maps [px]
const Vec3 kGravity{0.0, 0.0, -kStandardGravity};

const DropletBodies& bodies()
{
    static const DropletBodies made(BodyShape::Capillary);
    return made;
}

/// A level square sheet around the origin: two islands of uv, the left half on the right of the texture.
FlowObject sheet()
{
    FlowObject object;
    for (const double half : {0.0, 1.0}) {
        for (const double y : {0.5, -0.5}) {
            for (const double x : {0.0, 0.5}) {
                object.vertices.push_back({kSide * (x + 0.5 * half - 0.5), kSide * y, 0.0});
                object.normals.push_back({0.0, 0.0, 1.0});
                object.uvs.push_back({x + 0.5 * (1.0 - half), 0.5 - y});
            }
        }
    }
    object.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 6, 7}, {4, 7, 5}};
    return object;
}

FlowTerrain sceneOf(const FlowObject& object)
{
    return FlowTerrain(flowSurface(object.vertices, object.triangles));
}

FlowSample restingAt(const FlowTerrain& scene, Vec3 place, double volume = 20e-9)
{
    FlowSample sample;
    sample.contact = FlowContact::Still;
    sample.place = place;
    sample.face = scene.nearest(place).face;
    sample.normal = {0.0, 0.0, 1.0};
    sample.volume = volume;
    return sample;
}

/// Value of a map at a place on the sheet.
double at(const FloatPicture& map, double x, double y, int channel = 0)
{
    const double u = x / kSide + (x < 0.0 ? 1.0 : 0.0);
    const auto column = static_cast<std::size_t>(u * kSize);
    const auto row = static_cast<std::size_t>((0.5 - y / kSide) * kSize);
    return static_cast<double>(map.values[(row * kSize + column) * static_cast<std::size_t>(map.channels) +
                                          static_cast<std::size_t>(channel)]);
}

double volumeIn(const FloatPicture& map)
{
    double sum = 0.0;
    for (const float thickness : map.values) {
        sum += static_cast<double>(thickness);
    }
    return sum * kSide * kSide / (kSize * kSize);
}

WetFloatMaps mapsOf(WetMapper& mapper, double time, const std::vector<FlowSample>& samples)
{
    return mapper.floatMaps(time, samples, dropletSurfaces(samples, {bodies(), kGravity}));
}

TEST(WetMaps, DropletsHaveTheirVolumeAlsoOverASeam)
{
    const FlowObject object = sheet();
    const FlowTerrain scene = sceneOf(object);
    // The second lies on the seam of the islands, the third is smaller than a texel.
    const std::vector<FlowSample> samples{restingAt(scene, {8e-3, 1e-3, 0.0}), restingAt(scene, {0.2e-3, -9e-3, 0.0}),
                                          restingAt(scene, {-15.1e-3, 15.05e-3, 0.0}, 1e-14)};
    WetMapper mapper(object, scene, {.width = kSize, .height = kSize});
    const WetFloatMaps maps = mapsOf(mapper, 1.0, samples);
    EXPECT_NEAR(volumeIn(maps.thickness), 40e-9 + 1e-14, 1e-14);
    for (const double x : {-0.6e-3, 0.6e-3}) {
        EXPECT_GT(at(maps.thickness, x, -9e-3), 0.5e-3) << "on both sides of the seam";
        EXPECT_EQ(at(maps.age, x, -9e-3), 0.0);
    }
    EXPECT_GT(at(maps.thickness, -15.1e-3, 15.05e-3), 0.0);
    EXPECT_EQ(at(maps.thickness, 0.0, 15e-3), 0.0);
    EXPECT_EQ(at(maps.age, 0.0, 15e-3), 10.0) << "never wet";
    EXPECT_EQ(at(maps.wet, 0.0, 15e-3), 0.0);
    EXPECT_EQ(at(maps.wet, 8e-3, 1e-3), 1.0);
    // The normal leans outward all around the droplet, with +Y up.
    EXPECT_GT(at(maps.normal, 9e-3, 1e-3, 0), 0.1);
    EXPECT_LT(at(maps.normal, 7e-3, 1e-3, 0), -0.1);
    EXPECT_GT(at(maps.normal, 8e-3, 2e-3, 1), 0.1);
    EXPECT_EQ(at(maps.normal, 0.0, 15e-3, 2), 1.0);

    const WetMaps deep = mapper.maps(1.0, samples, dropletSurfaces(samples, {bodies(), kGravity}));
    EXPECT_EQ(deep.normal.levels[0], 32768);
    EXPECT_EQ(deep.normal.levels[2], 65535);
    EXPECT_EQ(deep.age.levels[0], 65535);
    EXPECT_THAT(deep.thickness.levels, ::testing::Contains(::testing::Gt(5000)));
}

TEST(WetMaps, FilmsCrossSeamsAgeAndDry)
{
    const FlowObject object = sheet();
    const FlowTerrain scene = sceneOf(object);
    // Of a liquid that does not drain.
    const TrailFilm film{.thickness = 50e-6, .drying = 4.0, .kinematic_viscosity = 1e3};
    WetMapper mapper(object, scene, {.width = kSize, .height = kSize, .film = film});
    // Beside the seam, 3 mm wide: it wets a strip of the other island too. It stands still at its end.
    const Vec3 from{1e-3, 15e-3, 0.0};
    const Vec3 to{1e-3, 5e-3, 0.0};
    mapper.add(std::vector<FlowTrack>{{1, scene.nearest(to).face, from, to, 3e-3, 1.0, 0.0}});
    const WetFloatMaps fresh = mapsOf(mapper, 1.0, {});
    // A parabola whose mean is the film's thickness.
    for (const double aside : {-1.3e-3, 0.0, 1.3e-3}) {
        EXPECT_NEAR(at(fresh.thickness, 1e-3 + aside, 10e-3), 75e-6 * (1.0 - aside * aside / 2.25e-6), 6e-6) << aside;
    }
    EXPECT_EQ(at(fresh.thickness, -0.9e-3, 10e-3), 0.0);
    EXPECT_EQ(at(fresh.thickness, 1e-3, 3e-3), 0.0);
    EXPECT_NEAR(volumeIn(fresh.thickness), 50e-6 * 3e-3 * 10e-3 + 75e-6 * 0.5 * 2.25e-6 * 3.14159, 2e-11);
    // Its sides slope by 4 h / w, away from the middle.
    EXPECT_NEAR(at(fresh.normal, 2e-3, 10e-3, 0), 2.0 * 75e-6 * 1e-3 / 2.25e-6, 0.01);
    EXPECT_NEAR(at(fresh.normal, 0.2e-3, 10e-3, 0), -2.0 * 75e-6 * 0.8e-3 / 2.25e-6, 0.01);
    EXPECT_NEAR(at(fresh.normal, 2e-3, 10e-3, 1), 0.0, 1e-3);
    const WetFloatMaps later = mapsOf(mapper, 3.0, {});
    EXPECT_NEAR(at(later.thickness, 1e-3, 10e-3) / at(fresh.thickness, 1e-3, 10e-3), 0.5, 1e-6);
    EXPECT_NEAR(at(later.age, 1e-3, 10e-3), 2.0, 1e-6);
    EXPECT_EQ(at(fresh.wet, 1e-3, 10e-3), 1.0);
    EXPECT_NEAR(at(later.wet, 1e-3, 10e-3), 0.75, 0.01);
    EXPECT_EQ(at(later.wet, 1e-3, 3e-3), 0.0);
    EXPECT_EQ(at(mapsOf(mapper, 5.5, {}).thickness, 1e-3, 10e-3), 0.0);
}

TEST(WetMaps, FilmsDrawTogetherAndDropletsTakeThemAlong)
{
    const FlowObject object = sheet();
    const FlowTerrain scene = sceneOf(object);
    const TrailFilm film{.thickness = 20e-6, .kinematic_viscosity = 1e3};
    WetMapper mapper(object, scene, {.width = kSize, .height = kSize, .film = film});
    const auto run = [&](std::uint64_t id, Vec3 from, Vec3 to, double time) {
        mapper.add(std::vector<FlowTrack>{{id, scene.nearest(to).face, from, to, 3e-3, time, 0.1}});
    };
    const auto wet = [&](double y, double time) {
        const WetFloatMaps maps = mapsOf(mapper, time, {});
        int count = 0;
        for (double x = 3e-3; x < 13e-3; x += 0.1e-3) {
            count += at(maps.thickness, x, y) > 0.0 ? 1 : 0;
        }
        return 0.1e-3 * count;
    };
    run(1, {8e-3, 15e-3, 0.0}, {8e-3, -15e-3, 0.0}, 0.3);
    EXPECT_NEAR(wet(10e-3, 0.3), 3e-3, 0.3e-3) << "as wide as the droplet";
    EXPECT_LT(wet(10e-3, 0.36), 2.2e-3);
    EXPECT_GT(wet(10e-3, 0.36), 0.4e-3);
    double before = 0.0;
    double after = 0.0;
    for (double y = -12e-3; y < 12e-3; y += 0.5e-3) {
        before += wet(y, 0.6);
    }
    // Another one runs beside: the rivulet is within its width.
    run(2, {9.2e-3, 15e-3, 0.0}, {9.2e-3, -15e-3, 0.0}, 0.6);
    const WetFloatMaps swept = mapsOf(mapper, 0.66, {});
    for (double y = -12e-3; y < 12e-3; y += 0.5e-3) {
        after += at(swept.thickness, 8.1e-3, y);
    }
    EXPECT_GT(before, 0.0);
    EXPECT_EQ(after, 0.0);
}

TEST(WetMaps, TheBackOfAThinSheetStaysDry)
{
    // A box 0.2 mm thick, whose lower side has another part of the texture.
    FlowObject object;
    for (const double z : {0.0, -0.2e-3}) {
        for (const double y : {0.5, -0.5}) {
            for (const double x : {-0.5, 0.5}) {
                object.vertices.push_back({kSide * x, kSide * y, z});
                object.normals.push_back({0.0, 0.0, z < 0.0 ? -1.0 : 1.0});
                object.uvs.push_back({0.25 + 0.4 * x + (z < 0.0 ? 0.5 : 0.0), 0.5 - y});
            }
        }
    }
    object.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 7, 6}, {4, 5, 7}, {2, 6, 7}, {2, 7, 3},
                        {0, 1, 5}, {0, 5, 4}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    const FlowTerrain scene = sceneOf(object);
    WetMapper mapper(object, scene, {.width = kSize, .height = kSize});
    const Vec3 place{0.0, -19.5e-3, 0.0};  // near the sheet's edge
    mapper.add(std::vector<FlowTrack>{{1, scene.nearest({0.0, -19e-3, 1e-3}).face, place, place, 3e-3, 0.0, 0.0}});
    const WetFloatMaps maps = mapper.floatMaps(0.0, {}, Surface());
    double front = 0.0;
    double back = 0.0;
    for (std::size_t i = 0; i < maps.thickness.values.size(); ++i) {
        const std::size_t column = i % kSize;
        (column < kSize * 9 / 20 ? front : back) +=
            column < kSize * 9 / 20 || column > kSize * 11 / 20 ? static_cast<double>(maps.thickness.values[i]) : 0.0;
    }
    EXPECT_GT(front, 0.0);
    EXPECT_EQ(back, 0.0);
}

TEST(WetMaps, AnObjectWithoutUvIsRefused)
{
    FlowObject object = sheet();
    const FlowTerrain scene = sceneOf(object);
    const auto message = [&] {
        try {
            WetMapper mapper(object, scene);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    object.uvs.clear();
    EXPECT_THAT(message(), ::testing::HasSubstr("none: unwrap it"));
    object.uvs.assign(object.vertices.size(), {0.5, 0.5});
    EXPECT_THAT(message(), ::testing::HasSubstr("no area"));
    object = sheet();
    EXPECT_THROW(WetMapper(object, scene, {.width = 8}), Error);
    EXPECT_THROW(WetMapper(object, scene, {.film = {.drying = 0.0}}), Error);
}

TEST(WetMaps, FollowTheObjectToAnotherShape)
{
    const FlowObject object = sheet();
    // Set upright and moved; then twice as wide.
    const auto upright = [](Vec3 p) { return Vec3{p.x + 0.1, -p.z, p.y + 0.3}; };
    std::vector<std::vector<Vec3>> vertices(3, object.vertices);
    for (std::size_t v = 0; v < object.vertices.size(); ++v) {
        vertices[1][v] = upright(object.vertices[v]);
        vertices[2][v].x *= 2.0;
    }
    FlowShapes shapes(flowSurface(object.vertices, object.triangles), object.triangles, vertices, 24.0);
    const FlowTerrain& scene = shapes.first();
    const FlowTrack track{
        1, scene.nearest({-9e-3, 5e-3, 0.0}).face, {-15e-3, 5e-3, 0.0}, {-4e-3, 5e-3, 0.0}, 4e-3, 0.5, 0.1};
    const std::vector<FlowSample> flat{restingAt(scene, {8e-3, 1e-3, 0.0})};
    WetMapper mapper(object, scene, {.width = kSize, .height = kSize});
    mapper.add(std::vector{track});
    const WetFloatMaps expected = mapsOf(mapper, 0.51, flat);
    ASSERT_GT(at(expected.wet, -9e-3, 5e-3), 0.0);

    std::vector<FlowSample> moved = flat;
    moved.front().place = upright(flat.front().place);
    moved.front().normal = {0.0, -1.0, 0.0};
    const Vec3 gravity{0.0, kStandardGravity, 0.0};
    mapper.reshape(inShape(object, vertices[1]), *shapes.at(1));
    const WetFloatMaps maps = mapper.floatMaps(0.51, moved, dropletSurfaces(moved, {bodies(), gravity}));
    // A round droplet has another direction; its grid may differ by a cell.
    EXPECT_NEAR(volumeIn(maps.thickness), volumeIn(expected.thickness), 1e-14);
    EXPECT_EQ(maps.age.values, expected.age.values);
    for (const double x : {-14e-3, -9e-3, 8e-3}) {
        const double y = x > 0.0 ? 1e-3 : 5e-3;
        EXPECT_NEAR(at(maps.thickness, x, y), at(expected.thickness, x, y), 0.02 * at(expected.thickness, x, y));
        EXPECT_EQ(at(maps.wet, x, y), at(expected.wet, x, y));
    }
    EXPECT_GT(at(maps.normal, 9e-3, 1e-3, 0), 0.1) << "leans outward as before";
    EXPECT_GT(at(maps.normal, 8e-3, 2e-3, 1), 0.1);

    std::vector<FlowSample> wide = flat;
    wide.front().place.x *= 2.0;
    mapper.reshape(inShape(object, vertices[2]), *shapes.at(2));
    // Texels stand for twice the area, so that half the thickness is the droplet's volume; the film keeps its
    // thickness.
    EXPECT_NEAR(volumeIn(expected.thickness) - volumeIn(mapsOf(mapper, 0.51, wide).thickness), 10e-9, 1e-10);
}

}  // namespace
}  // namespace droplet
