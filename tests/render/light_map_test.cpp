// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/light_map.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "support/surfaces.h"

namespace droplet {
namespace {

using testing::roundDroplet;

constexpr int kCells = 160;

Light straightDown()
{
    return {grey(1.0F), {{{0.0F, 0.0F, 1.0F}, 1.0F}}, false};
}

Light slanted()
{
    return {grey(1.0F), {{unit({0.5F, 0.2F, 0.7F}), 0.75F}, {unit({-0.3F, 0.6F, 0.9F}), 0.25F}}, false};
}

// Missing light on the plane, as an area [m²].
double missing(const LightMap& map, const RayTracer& scene)
{
    double sum = 0.0;
    for (const Vec3f& value : map.values) {
        sum += 1.0 - static_cast<double>(value.y);
    }
    const double cell = static_cast<double>(map.cell) * scene.scale();
    return sum * cell * cell;
}

double reflectance(double cosine, double n)
{
    const double inner = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
    const double across = (cosine - n * inner) / (cosine + n * inner);
    const double along = (inner - n * cosine) / (inner + n * cosine);
    return 0.5 * (across * across + along * along);
}

TEST(LightMap, LiquidOfAirsIndexChangesNothing)
{
    const Surface surface = roundDroplet({.height = 2e-3, .rings = 8, .segments = 48});
    const RayTracer scene(surface, RenderOptions{});
    for (const Light& light : {straightDown(), slanted()}) {
        for (const Vec3f& value : lightGain(scene, {{true, 1.0F, {}}}, light, kCells, 0.0F).values) {
            ASSERT_NEAR(value.x, 1.0, 2e-4);
            ASSERT_NEAR(value.z, 1.0, 2e-4);
        }
    }
}

TEST(LightMap, OpaqueDropletTakesTheLightItIntercepts)
{
    const Surface surface = roundDroplet({.height = 1e-3, .rings = 8, .segments = 48});
    const RayTracer scene(surface, RenderOptions{});
    const double area = testing::polygonArea(4e-3, 48);
    const LightMap down = lightGain(scene, {{false, 1.0F, {}}}, straightDown(), kCells, 0.0F);
    EXPECT_NEAR(missing(down, scene), area, 0.005 * area);
    // Blurring moves light but loses none.
    EXPECT_NEAR(missing(lightGain(scene, {{false, 1.0F, {}}}, straightDown(), kCells, 2.0F), scene), area,
                0.005 * area);
}

// The light that arrives, anywhere, is the intercepted light minus the reflected light (Fresnel).
TEST(LightMap, ClearDropletLosesWhatItReflects)
{
    constexpr double kRadius = 4e-3;
    for (const double height : {0.3e-3, 1e-3, 1.6e-3}) {
        const Surface surface = roundDroplet({.outer = kRadius, .height = height, .rings = 40, .segments = 160});
        const RayTracer scene(surface, RenderOptions{});
        double reflected = 0.0;
        constexpr int kRings = 2000;
        for (int k = 0; k < kRings; ++k) {
            const double r = kRadius * (k + 0.5) / kRings;
            const double slope = 2.0 * height * r / (kRadius * kRadius);
            reflected +=
                2.0 * std::numbers::pi * r * kRadius / kRings * reflectance(1.0 / std::hypot(1.0, slope), 1.333);
        }
        const LightMap map = lightGain(scene, {{true, 1.333F, {}}}, straightDown(), 400, 0.0F);
        EXPECT_NEAR(missing(map, scene), reflected, 0.03 * reflected) << height;
    }
}

// Near its axis a droplet is a lens of focal length R/(1 − 1/n) below its top, with the radius of curvature R there.
TEST(LightMap, MiddleOfADropletGathersLightLikeALens)
{
    constexpr double kHeight = 1e-3;
    constexpr double kRadius = 4e-3;
    constexpr double kIndex = 1.5;
    const Surface surface = roundDroplet({.outer = kRadius, .height = kHeight, .rings = 60, .segments = 160});
    const RayTracer scene(surface, RenderOptions{});
    const LightMap map = lightGain(scene, {{true, static_cast<float>(kIndex), {}}}, straightDown(), 400, 4.0F);
    const double curvature = 2.0 * kHeight / (kRadius * kRadius);
    const double narrowed = 1.0 - kHeight * curvature * (1.0 - 1.0 / kIndex);
    EXPECT_NEAR(map.at({}).y, (1.0 - 0.04) / (narrowed * narrowed), 0.02);
}

TEST(LightMap, ColouredLiquidAbsorbsByItsDepth)
{
    // The middle is almost level.
    const Surface surface = roundDroplet({.outer = 8e-3, .height = 0.5e-3, .rings = 40, .segments = 96});
    const RayTracer scene(surface, RenderOptions{});
    const auto depth = static_cast<float>(0.5e-3 / scene.scale());
    const Media medium{{true, 1.0F, {1.0F / depth, 0.5F / depth, 0.0F}}};
    const Vec3f middle = lightGain(scene, medium, straightDown(), kCells, 0.0F).at({});
    EXPECT_NEAR(middle.x, std::exp(-1.0), 0.005);
    EXPECT_NEAR(middle.y, std::exp(-0.5), 0.005);
    EXPECT_NEAR(middle.z, 1.0, 1e-4);
}

TEST(LightMap, IsTheSameWithAnyNumberOfThreads)
{
    const Surface surface = roundDroplet({.height = 2e-3, .rings = 8, .segments = 48});
    const auto made = [&](int threads) {
        LightMap map;
        tbb::task_arena(threads).execute([&] {
            const RayTracer scene(surface, RenderOptions{});
            map = lightOnPlane(scene, {{true, 1.333F, {1.0F, 2.0F, 3.0F}}}, {slanted(), straightDown()}, kCells);
        });
        return map;
    };
    const LightMap one = made(1);
    const LightMap several = made(4);
    ASSERT_EQ(one.values.size(), several.values.size());
    EXPECT_EQ(std::memcmp(one.values.data(), several.values.data(), one.values.size() * sizeof(Vec3f)), 0);
}

// If the stand is the plane, the map by uv equals the map on the plane.
TEST(LightMap, OnAStandEqualsThePlane)
{
    const Surface surface = roundDroplet({.height = 1e-3, .rings = 24, .segments = 96});
    TexturedMesh plane;
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        plane.vertices.push_back({8e-3 * x, 8e-3 * y, 0.0});
        plane.normals.push_back({0.0, 0.0, 1.0});
        plane.uvs.push_back({0.5 + 8e-3 * x / testing::kExtent, 0.5 - 8e-3 * y / testing::kExtent});
    }
    plane.triangles = {{0, 1, 2}, {0, 2, 3}};
    RenderOptions options;
    options.extent = {testing::kExtent, testing::kExtent};
    const RayTracer on_plane(surface, options);
    options.stand = plane;
    const RayTracer on_stand(surface, options);
    const Media medium{{true, 1.333F, {}}};
    const LightMap expected = lightGain(on_plane, medium, slanted(), 300, 2.0F);
    const LightMap gain = lightGainOnStand(on_stand, medium, slanted(), 300);
    double error = 0.0;
    double change = 0.0;
    for (double x = -3.4e-3; x < 3.5e-3; x += 0.4e-3) {
        for (double y = -3.4e-3; y < 3.5e-3; y += 0.4e-3) {
            const auto there = static_cast<double>(expected.at(on_plane.toScene({x, y, 0.0})).y);
            const Vec3f uv{static_cast<float>(0.5 + x / testing::kExtent),
                           static_cast<float>(0.5 - y / testing::kExtent), 0.0F};
            error += std::abs(static_cast<double>(gain.at(uv).y) - there);
            change += std::abs(1.0 - there);
        }
    }
    EXPECT_LT(error, 0.25 * change);
}

TEST(DiffuseReflectance, IsAsTabulated)
{
    // W. G. Egan, T. W. Hilgeman, "Optical Properties of Inhomogeneous Materials" (1979): 0.0919 at n = 1.5.
    EXPECT_NEAR(diffuseReflectance(1.5), 0.0918, 2e-4);
    EXPECT_NEAR(diffuseReflectance(4.0 / 3.0), 0.0662, 3e-4);
    EXPECT_EQ(diffuseReflectance(1.0), 0.0);
    // Reference: quadrature of Fresnel's formula under Lambert's law.
    for (const double n : {1.1, 1.333, 2.0}) {
        double sum = 0.0;
        constexpr int kSteps = 20000;
        for (int k = 0; k < kSteps; ++k) {
            const double cosine = (k + 0.5) / kSteps;
            sum += 2.0 * cosine * reflectance(cosine, n) / kSteps;
        }
        EXPECT_NEAR(diffuseReflectance(n), sum, 1e-5) << n;
    }
}

}  // namespace
}  // namespace droplet
