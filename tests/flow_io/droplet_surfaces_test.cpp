// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/droplet_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "droplet/units.h"

namespace droplet {
namespace {

const Vec3 kGravity{0.0, 0.0, -kStandardGravity};

/// A sample on a slope that falls toward +x by an angle.
FlowSample onSlope(double angle, Vec3 velocity = {})
{
    FlowSample sample;
    sample.contact = velocity == Vec3{} ? FlowContact::Still : FlowContact::Face;
    sample.face = 0;
    sample.place = {0.1, 0.2, 0.3};
    sample.normal = {std::sin(angle), 0.0, std::cos(angle)};
    sample.velocity = velocity;
    sample.volume = 20e-9;
    return sample;
}

void expectNear(Vec3 a, Vec3 b, double tolerance = 1e-15)
{
    EXPECT_LE(length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' '
                                        << b.z;
}

TEST(DropletSurfaces, FrameRunsAlongTheVelocityOrDown)
{
    const double slope = 0.5;
    const Vec3 down{std::cos(slope), 0.0, -std::sin(slope)};
    expectNear(frameOf(onSlope(slope, {0.0, 0.3, 0.0}), kGravity).ahead, {0.0, 1.0, 0.0});
    expectNear(frameOf(onSlope(slope), kGravity).ahead, down);
    // A velocity along the normal has no direction along the surface.
    const FlowSample landing = onSlope(slope, -2.0 * onSlope(slope).normal);
    expectNear(frameOf(landing, kGravity).ahead, down);
    for (const FlowSample& sample :
         {onSlope(slope, {0.1, 0.2, -0.3}), onSlope(slope), onSlope(0.0), onSlope(90.0 * kDegree), FlowSample()}) {
        const DropletFrame frame = frameOf(sample, kGravity);
        EXPECT_NEAR(length(frame.ahead), 1.0, 1e-15);
        EXPECT_NEAR(length(frame.left), 1.0, 1e-15);
        EXPECT_NEAR(dot(frame.ahead, frame.normal), 0.0, 1e-15);
        expectNear(cross(frame.ahead, frame.left), frame.normal);
        EXPECT_EQ(frame.place, sample.place);
    }
}

TEST(DropletSurfaces, ConditionsAreInTheFrameOfTheDroplet)
{
    const double slope = 0.5;
    const BodyConditions rest = conditionsOf(onSlope(slope), kGravity);
    EXPECT_EQ(rest.volume, 20e-9);
    EXPECT_EQ(rest.speed, 0.0);
    EXPECT_FALSE(rest.airborne);
    expectNear(rest.gravity, kStandardGravity * Vec3{std::sin(slope), 0.0, -std::cos(slope)}, 1e-14);
    // It runs across the slope, to +y: down is on its right.
    const BodyConditions across = conditionsOf(onSlope(slope, {0.0, 0.3, 0.0}), kGravity);
    EXPECT_DOUBLE_EQ(across.speed, 0.3);
    expectNear(across.gravity, kStandardGravity * Vec3{0.0, -std::sin(slope), -std::cos(slope)}, 1e-14);
    FlowSample falling = onSlope(slope);
    falling.contact = FlowContact::Air;
    EXPECT_TRUE(conditionsOf(falling, kGravity).airborne);
}

TEST(DropletSurfaces, HaveTheVolumesOfTheSamplesAtTheirPlaces)
{
    const DropletBodies bodies(BodyShape::Capillary);
    FlowSample falling = onSlope(0.0);
    falling.contact = FlowContact::Air;
    falling.place = {-0.1, 0.0, 0.5};
    const std::vector<FlowSample> samples{onSlope(0.0), onSlope(0.7, {0.2, 0.0, -0.2}), falling};
    const Surface open = dropletSurfaces(samples, {bodies, kGravity});
    open.validate();
    ASSERT_EQ(open.vertices.size(), samples.size() * bodies.vertices());
    // Rims lie on the ground, the rest above it.
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t k = 0; k < bodies.vertices(); ++k) {
            const double height = dot(open.vertices[i * bodies.vertices() + k] - samples[i].place, samples[i].normal);
            EXPECT_GE(height, -1e-12);
            EXPECT_TRUE(k >= bodies.rimVertices() || height < 1e-12);
        }
    }
    EXPECT_TRUE(dropletSurfaces({}, {bodies, kGravity}).vertices.empty());
}

// Section 3.4 of the paper: nothing at rest and at high speed, most in between.
TEST(SmallDeformation, IsForSlowDroplets)
{
    const SmallDeformation small{.amplitude = 0.2};
    EXPECT_EQ(small.at(0.0), 0.0);
    double largest = 0.0;
    double before = 0.0;
    bool falls = false;
    for (int k = 1; k < 300; ++k) {
        const double now = small.at(0.01 * k);
        EXPECT_TRUE(now > before || (falls && now < before)) << k;
        falls = falls || small.at(0.01 * (k + 1)) < now;
        largest = std::max(largest, now);
        before = now;
    }
    EXPECT_NEAR(largest, 0.2, 1e-3);
    EXPECT_LT(small.at(1.0), 1e-3);
}

TEST(SmallDeformation, ChangesTheOutlineAndKeepsTheVolume)
{
    const DropletBodies bodies(BodyShape::Capillary);
    const SmallDeformation small{.amplitude = 0.1};
    const DropletShapes shapes{bodies, kGravity, small};
    const FlowSample rest = onSlope(0.5);
    EXPECT_EQ(dropletSurfaces({&rest, 1}, shapes).vertices, dropletSurfaces({&rest, 1}, {bodies, kGravity}).vertices);
    double squares = 0.0;
    std::size_t count = 0;
    for (int k = 0; k < 40; ++k) {
        FlowSample sample = onSlope(0.0, {0.1, 0.0, 0.0});
        sample.place = {0.05 * k, 0.0, 0.0};
        const Surface plain = dropletSurfaces({&sample, 1}, {bodies, kGravity});
        const Surface moved = dropletSurfaces({&sample, 1}, shapes);
        const auto volume = [&](const Surface& surface) {
            double sum = 0.0;
            for (const auto& [a, b, c] : surface.triangles) {
                sum += dot(surface.vertices[a] - sample.place,
                           cross(surface.vertices[b] - sample.place, surface.vertices[c] - sample.place)) /
                       6.0;
            }
            return sum;
        };
        EXPECT_NEAR(volume(moved), volume(plain), 1e-9 * sample.volume);
        for (std::size_t v = 0; v < bodies.rimVertices(); ++v, ++count) {
            EXPECT_NEAR(moved.vertices[v].z, 0.0, 1e-15);
            const double factor =
                length(moved.vertices[v] - sample.place) / length(plain.vertices[v] - sample.place) - 1.0;
            squares += factor * factor;
        }
        // Normals belong to the new surface.
        for (const auto& [a, b, c] : moved.triangles) {
            const Vec3 facet = cross(moved.vertices[b] - moved.vertices[a], moved.vertices[c] - moved.vertices[a]);
            if (length(facet) > 1e-3 * 1e-6) {
                EXPECT_GT(dot(moved.normals[a] + moved.normals[b] + moved.normals[c], facet), 2.5 * length(facet));
            }
        }
    }
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), 0.1, 0.02);
    // It follows from the place alone: what moves a little changes little.
    FlowSample sample = onSlope(0.0, {0.1, 0.0, 0.0});
    const Surface here = dropletSurfaces({&sample, 1}, shapes);
    sample.place.x += 1e-6;
    const Surface there = dropletSurfaces({&sample, 1}, shapes);
    for (std::size_t v = 0; v < here.vertices.size(); ++v) {
        EXPECT_LT(length(there.vertices[v] - here.vertices[v]), 3e-6);
    }
}

}  // namespace
}  // namespace droplet
