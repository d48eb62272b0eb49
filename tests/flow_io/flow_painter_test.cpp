// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_painter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "droplet/error.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/units.h"
#include "flow_io/settled_droplets.h"

namespace droplet {
namespace {

constexpr double kRadius = 20e-3;
const Vec3 kGravity{0.0, 0.0, -kStandardGravity};

const DropletBodies& bodies()
{
    static const DropletBodies made(BodyShape::Capillary);
    return made;
}

FlowObject sphere()
{
    constexpr std::uint32_t kAround = 64;
    constexpr std::uint32_t kRings = 32;
    FlowObject object;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
        for (std::uint32_t k = 0; k <= kAround; ++k) {
            const double tilt = std::numbers::pi * ring / kRings;
            const double turn = 2.0 * std::numbers::pi * k / kAround;
            object.normals.push_back(
                {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)});
            object.vertices.push_back(kRadius * object.normals.back());
            if (ring < kRings && k < kAround) {
                const std::uint32_t a = ring * (kAround + 1) + k;
                object.triangles.push_back({a, a + kAround + 1, a + kAround + 2});
                object.triangles.push_back({a, a + kAround + 2, a + 1});
            }
        }
    }
    return object;
}

class FlowPainters : public ::testing::Test {
protected:
    FlowPainters() : object(sphere()), scene(flowSurface(object.vertices, object.triangles))
    {
        options.render.width = 120;
        options.render.height = 90;
        options.render.samples = 4;
        options.film.thickness = 60e-6;
        options.film.drying = 2.0;
    }

    /// Droplets in front of the camera.
    [[nodiscard]] std::vector<FlowSample> droplets() const
    {
        std::vector<FlowSample> samples;
        for (const Vec3 from : {Vec3{0.0, -1.0, 0.6}, {0.5, -1.0, 0.1}, {-0.5, -1.0, 0.3}}) {
            FlowSample sample;
            sample.id = samples.size() + 1;
            const FlowTerrain::Point on = *scene.firstAlong(from, -1.0 * from);
            sample.contact = FlowContact::Still;
            sample.face = on.face;
            sample.place = on.place;
            sample.normal = scene.surface().faces[on.face].normal;
            sample.volume = 15e-9;
            samples.push_back(sample);
        }
        return samples;
    }

    [[nodiscard]] static Surface surfacesOf(const std::vector<FlowSample>& samples)
    {
        return dropletSurfaces(samples, {bodies(), kGravity});
    }

    FlowObject object;
    FlowTerrain scene;
    FlowPainterOptions options;
};

// White furnace: leaks of light at the rims and shadows in the wrong place would be dark.
TEST_F(FlowPainters, DropletsOnAnObjectAreInvisibleInAWhiteFurnace)
{
    options.render.lighting = Lighting::Uniform;
    FlowPainter painter(object, scene, options);
    const Picture picture = painter.picture({}, droplets(), surfacesOf(droplets()));
    EXPECT_THAT(picture.rgb, ::testing::Each(::testing::Ge(250)));
}

TEST_F(FlowPainters, DropletsFollowTheObjectAndKeepTheirVolume)
{
    const std::vector<FlowSample> samples = droplets();
    const SettledDroplets made = settled(scene, samples, surfacesOf(samples), std::vector<bool>(samples.size(), true));
    ASSERT_EQ(made.bases.size(), samples.size());
    const std::size_t vertices = made.surface.vertices.size() / samples.size();
    for (std::size_t v = 0; v < made.surface.vertices.size(); ++v) {
        const double height = length(made.surface.vertices[v]) - kRadius;
        if (v % vertices < bodies().rimVertices()) {
            EXPECT_NEAR(height, 0.0, 0.06e-3) << "a rim on the facets";
        } else if (v % vertices >= bodies().vertices()) {
            EXPECT_LT(height, 0.0) << "the rim's extension is below the ground";
        }
    }
}

TEST_F(FlowPainters, StreaksDarkenAndDry)
{
    FlowPainter painter(object, scene, options);
    const Picture dry = painter.picture({}, {}, Surface());
    const FlowSample middle = droplets().front();
    painter.add(std::vector<FlowTrack>{{1, *middle.face, middle.place, middle.place, 10e-3, 1.0, 0.0}});
    const Picture wet = painter.picture({.time = 1.0}, {}, Surface());
    int darker = 0;
    int total = 0;
    for (std::size_t i = 0; i < dry.rgb.size(); ++i) {
        darker += wet.rgb[i] + 8 < dry.rgb[i] ? 1 : 0;
        total += wet.rgb[i] != dry.rgb[i] ? 1 : 0;
    }
    EXPECT_GT(darker, 300);
    EXPECT_LT(total, static_cast<int>(dry.rgb.size() / 5)) << "only below the streak";
    EXPECT_EQ(painter.picture({.time = 3.5}, {}, Surface()), dry);
}

TEST_F(FlowPainters, TheBackOfASheetIsDry)
{
    // It faces the camera.
    object = FlowObject{};
    object.vertices = {{-0.05, 0.0, 0.0}, {0.05, 0.0, 0.0}, {0.05, 0.0, 0.1}, {-0.05, 0.0, 0.1}};
    object.normals.assign(4, {0.0, -1.0, 0.0});
    object.triangles = {{0, 1, 2}, {0, 2, 3}};
    const FlowTerrain sheet(flowSurface(object.vertices, object.triangles));
    options.render.view = View::Side;
    const auto changes = [&](double azimuth) {
        FlowPainter painter(object, sheet, options);
        const Picture dry = painter.picture({.azimuth = azimuth}, {}, Surface());
        painter.add(std::vector<FlowTrack>{{1, 0, {0.0, 0.0, 0.04}, {0.02, 0.0, 0.04}, 10e-3, 0.0, 0.1}});
        return painter.picture({.azimuth = azimuth}, {}, Surface()) != dry;
    };
    EXPECT_TRUE(changes(0.0));
    EXPECT_FALSE(changes(std::numbers::pi));
}

TEST_F(FlowPainters, FramesHaveOneCameraAndTheSameBytesWithAnyNumberOfThreads)
{
    FlowPainter painter(object, scene, options);
    const Picture dry = painter.picture({}, {}, Surface());
    std::vector<FlowSample> falling = droplets();
    falling.resize(1);
    falling[0].contact = FlowContact::Air;
    falling[0].place = {0.0, 0.0, -80e-3};  // below the object
    EXPECT_EQ(painter.picture({}, falling, surfacesOf(falling)), dry);
    options.render.framed = ViewBox{{-30e-3, -30e-3, -30e-3}, {30e-3, 30e-3, 30e-3}};
    FlowPainter framed(object, scene, options);
    const Picture far = framed.picture({}, {}, Surface());
    EXPECT_NE(far, dry);
    const Picture with_droplet = framed.picture({}, falling, surfacesOf(falling));
    int changed = 0;
    for (std::size_t i = 0; i < far.rgb.size(); ++i) {
        changed += with_droplet.rgb[i] != far.rgb[i] ? 1 : 0;
    }
    EXPECT_LT(changed, 60) << "the droplet alone";
    const Picture parallel = framed.picture({}, droplets(), surfacesOf(droplets()));
    EXPECT_NE(parallel, far);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(framed.picture({}, droplets(), surfacesOf(droplets())), parallel);
}

TEST_F(FlowPainters, AMovingObjectStaysInTheFrame)
{
    ObjectMotion motion;
    EXPECT_FALSE(framedOver(object, motion, 1.0).has_value());
    motion.keys = {{0.0, {}}, {1.0, {{0.1, 0.0, 0.0}, {}, 1.0}}};
    const ViewBox box = framedOver(object, motion, 1.0).value();
    EXPECT_NEAR(box.low.x, -kRadius, 1e-12);
    EXPECT_NEAR(box.high.x, 0.1 + kRadius, 1e-12);
}

TEST_F(FlowPainters, RefuseATextureWithoutUv)
{
    options.render.ground = Picture{1, 1, {255, 0, 0}};
    EXPECT_THROW(FlowPainter(object, scene, options), Error);
    options.render.ground.reset();
    options.film.drying = -1.0;
    EXPECT_THROW(FlowPainter(object, scene, options), Error);
}

}  // namespace
}  // namespace droplet
