// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/stand_look.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <vector>

#include "droplet/error.h"
#include "droplet/render/render.h"

namespace droplet {
namespace {

/// Upright plates behind one another, towards the camera.
TexturedMesh plates(int count)
{
    TexturedMesh mesh;
    for (int k = 0; k < count; ++k) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const auto& [x, z] : {std::array{-0.05, 0.0}, {0.05, 0.0}, {0.05, 0.1}, {-0.05, 0.1}}) {
            mesh.vertices.push_back({x, 0.002 * k, z});
            mesh.normals.push_back({0.0, -1.0, 0.0});
            mesh.uvs.push_back({x < 0.0 ? 0.0 : 1.0, z > 0.0 ? 0.0 : 1.0});
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first, first + 2, first + 3});
    }
    return mesh;
}

RenderOptions optionsOf(const StandLook& look, int count = 1)
{
    RenderOptions options;
    options.width = 64;
    options.height = 64;
    options.samples = 4;
    options.camera = CameraPlace{-0.5 * std::numbers::pi, 0.0};
    options.stand = plates(count);
    options.stand_looks = {look};
    options.stand_materials.assign(options.stand->triangles.size(), 0);
    options.stand_water = StandWater{};
    options.extent = {1.0, 1.0};
    return options;
}

/// Mean level in a part of the picture's middle.
std::array<double, 3> meanOf(const Picture& picture, int left = 24, int right = 40)
{
    std::array<double, 3> mean{};
    int count = 0;
    for (int y = 24; y < 40; ++y) {
        for (int x = left; x < right; ++x, ++count) {
            for (std::size_t c = 0; c < 3; ++c) {
                mean[c] += picture.rgb[3 * static_cast<std::size_t>(y * picture.width + x) + c];
            }
        }
    }
    for (double& value : mean) {
        value /= count;
    }
    return mean;
}

void expectAlike(const Picture& a, const Picture& b)
{
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        EXPECT_NEAR(a.rgb[i], b.rgb[i], 1) << i;
    }
}

StandLook opaqueLook(Vec3 colour)
{
    StandLook look;
    look.look.colour = colour;
    look.look.roughness = 1.0;
    look.look.transmission = 0.0;
    look.look.ior = 1.5;
    return look;
}

StandLook clearLook(Vec3 colour, double ior)
{
    StandLook look;
    look.look.colour = colour;
    look.look.ior = ior;
    return look;
}

TEST(StandLook, HasItsColourAndTexture)
{
    const auto red = meanOf(render(Surface(), optionsOf(opaqueLook({0.6, 0.02, 0.02}))));
    EXPECT_GT(red[0], 4.0 * red[1]);
    EXPECT_NEAR(red[1], red[2], 12.0);
    StandLook look = opaqueLook({1.0, 1.0, 1.0});
    look.colours = Picture{2, 1, {0, 0, 255, 0, 255, 0}};
    const Picture picture = render(Surface(), optionsOf(look));
    const auto left = meanOf(picture, 8, 14);
    const auto right = meanOf(picture, 50, 56);
    EXPECT_GT(left[2], 3.0 * left[1]);
    EXPECT_GT(right[1], 3.0 * right[2]);
}

TEST(StandLook, ThinWallsTintOnceEach)
{
    // Of index 1 they do not mirror. Two walls of share s are one of share s².
    const Picture one = render(Surface(), optionsOf(clearLook({0.25, 0.49, 0.81}, 1.0), 1));
    const Picture two = render(Surface(), optionsOf(clearLook({0.5, 0.7, 0.9}, 1.0), 2));
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(meanOf(one)[c], meanOf(two)[c], 1.0);
    }
    EXPECT_GT(meanOf(one)[2], meanOf(one)[0] + 10.0);
}

TEST(StandLook, OpacityMixes)
{
    StandLook look = opaqueLook({0.8, 0.8, 0.8});
    const Picture full = render(Surface(), optionsOf(look));
    look.opacity = 0.0;
    look.look.ior = 1.0;
    const Picture none = render(Surface(), optionsOf(look));
    const Picture clear = render(Surface(), optionsOf(clearLook({0.8, 0.8, 0.8}, 1.0)));
    EXPECT_EQ(none, clear);
    EXPECT_NE(none, full);
}

/// A droplet's cap on the plate, open below.
Surface cap()
{
    Surface surface;
    constexpr std::uint32_t kRings = 8;
    constexpr std::uint32_t kAround = 24;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
        const double tilt = 1.2 * ring / kRings;
        for (std::uint32_t k = 0; k < kAround; ++k) {
            const double turn = 2.0 * std::numbers::pi * k / kAround;
            const Vec3 normal{std::sin(tilt) * std::cos(turn), -std::cos(tilt), std::sin(tilt) * std::sin(turn)};
            surface.normals.push_back(normal);
            surface.vertices.push_back(0.02 * normal + Vec3{0.0, 0.02 * std::cos(1.2), 0.05});
            if (ring < kRings) {
                const std::uint32_t a = ring * kAround + k;
                const std::uint32_t b = ring * kAround + (k + 1) % kAround;
                surface.triangles.push_back({a, a + kAround, b + kAround});
                surface.triangles.push_back({a, b + kAround, b});
            }
        }
    }
    surface.uvs.resize(surface.vertices.size());
    surface.weld.resize(surface.vertices.size());
    std::iota(surface.weld.begin(), surface.weld.end(), 0U);
    surface.mean_height = 5e-3;
    return surface;
}

TEST(StandLook, ADropletOfAirOnAPaneIsInvisible)
{
    RenderOptions options = optionsOf(clearLook({0.9, 0.9, 0.9}, 1.0));
    options.look.ior = 1.0;
    const Picture without = render(Surface(), options);
    const Picture with = render(cap(), options);
    expectAlike(with, without);
    options.look.ior = 1.333;
    EXPECT_NE(render(cap(), options), without) << "one of water refracts";
}

// From behind, the way meets the pane first and enters the water there.
TEST(StandLook, ADropletIsInvisibleOrRefractsFromBehind)
{
    RenderOptions options = optionsOf(clearLook({0.9, 0.9, 0.9}, 1.0));
    options.azimuth = std::numbers::pi;
    options.look.ior = 1.0;
    const Picture without = render(Surface(), options);
    const Picture with = render(cap(), options);
    expectAlike(with, without);
    options.look.ior = 1.333;
    const auto dark = meanOf(render(cap(), options));
    EXPECT_GT(dark[1], 0.2 * meanOf(without)[1]) << "light passes";
}

TEST(StandLook, RefusesWhatDoesNotFit)
{
    RenderOptions options = optionsOf(opaqueLook({1.0, 1.0, 1.0}));
    options.stand_materials = {0};
    EXPECT_THROW(render(Surface(), options), Error);
    options.stand_materials = {0, 1};
    EXPECT_THROW(render(Surface(), options), Error);
    options.stand_materials = {0, 0};
    options.stand_looks[0].opacity = 2.0;
    EXPECT_THROW(render(Surface(), options), Error);
}

}  // namespace
}  // namespace droplet
