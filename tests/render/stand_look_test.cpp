// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/stand_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/render/render.h"
#include "support/ball_mesh.h"

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

/// Green and blue halves, in pixels that are narrow beside the picture: at its border colours of both sides mix.
Picture halves(bool begins_green)
{
    Picture picture{32, 1, {}};
    for (int x = 0; x < 32; ++x) {
        const bool is_green = (x < 16) == begins_green;
        picture.rgb.insert(picture.rgb.end(), {0, static_cast<std::uint8_t>(is_green ? 255 : 0),
                                               static_cast<std::uint8_t>(is_green ? 0 : 255)});
    }
    return picture;
}

TEST(StandLook, HasItsColourAndTexture)
{
    const auto red = meanOf(render(Surface(), optionsOf(opaqueLook({0.6, 0.02, 0.02}))));
    EXPECT_GT(red[0], 4.0 * red[1]);
    EXPECT_NEAR(red[1], red[2], 12.0);
    StandLook look = opaqueLook({1.0, 1.0, 1.0});
    look.colours = halves(false);
    const Picture picture = render(Surface(), optionsOf(look));
    const auto left = meanOf(picture, 8, 14);
    const auto right = meanOf(picture, 50, 56);
    EXPECT_GT(left[2], 3.0 * left[1]);
    EXPECT_GT(right[1], 3.0 * right[2]);
}

TEST(StandLook, TexturesCanBeMoved)
{
    StandLook look = opaqueLook({1.0, 1.0, 1.0});
    look.colours = halves(false);
    look.place.offset = {0.5, 0.0};
    const Picture moved = render(Surface(), optionsOf(look));
    look.place = {};
    look.colours = halves(true);
    const Picture swapped = render(Surface(), optionsOf(look));
    EXPECT_GT(meanOf(moved, 8, 14)[1], 3.0 * meanOf(moved, 8, 14)[2]);
    EXPECT_NEAR(meanOf(moved, 8, 14)[1], meanOf(swapped, 8, 14)[1], 2.0);
    look.place.scale.x = std::numeric_limits<double>::infinity();
    EXPECT_THROW(render(Surface(), optionsOf(look)), Error);
}

// Where all of a face has one uv, on the border of the picture, rounding shows no pattern.
TEST(StandLook, OneUvIsOneColour)
{
    RenderOptions options = optionsOf(opaqueLook({1.0, 1.0, 1.0}));
    options.stand_looks[0].colours = Picture{2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};
    for (const Vec2 uv : {Vec2{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.3, 1.0}}) {
        options.stand->uvs.assign(options.stand->vertices.size(), uv);
        const Picture picture = render(Surface(), options);
        const auto left = meanOf(picture, 24, 26);
        const auto right = meanOf(picture, 38, 40);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(left[c], right[c], 4.0);
        }
    }
}

TEST(StandLook, RoughGlassShowsABlurredRoom)
{
    StandLook look = clearLook({1.0, 1.0, 1.0}, 1.0);
    RenderOptions options = optionsOf(look);
    options.shows_room = true;
    const auto contrast = [&] {
        const Picture picture = render(Surface(), options);
        double low = 255.0;
        double high = 0.0;
        for (int y = 12; y < 52; ++y) {
            const double level = picture.rgb[3 * static_cast<std::size_t>(y * picture.width + 32) + 1];
            low = std::min(low, level);
            high = std::max(high, level);
        }
        return high - low;
    };
    const double sharp = contrast();
    options.stand_looks[0].look.roughness = 0.5;
    EXPECT_LT(contrast(), 0.5 * sharp);
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
    const Picture clear = render(Surface(), optionsOf(clearLook({1.0, 1.0, 1.0}, 1.0)));
    EXPECT_EQ(none, clear) << "what is not there has no colour";
    EXPECT_NE(none, full);
}

TEST(StandLook, OpacityMixesMetalToo)
{
    StandLook look = opaqueLook({0.9, 0.1, 0.1});
    look.look.metallic = 1.0;
    const Picture full = render(Surface(), optionsOf(look));
    const auto with_opacity = [&](double opacity) {
        look.opacity = opacity;
        return render(Surface(), optionsOf(look));
    };
    const Picture half = with_opacity(0.5);
    const Picture none = with_opacity(0.0);
    look = opaqueLook({0.9, 0.1, 0.1});
    look.coverage = Picture{1, 1, {0, 0, 0}};
    expectAlike(none, render(Surface(), optionsOf(look)));
    EXPECT_GT(meanOf(full)[0], meanOf(half)[0] + 5.0);
    EXPECT_GT(meanOf(half)[0], meanOf(none)[0] + 5.0);
}

// A glowing plate is as bright as white ground in open light, wherever it looks, and adds to what is lit.
TEST(StandLook, GlowIsLightOfItsOwn)
{
    StandLook look = opaqueLook({0.0, 0.0, 0.0});
    look.look.ior = 1.0;
    const Picture black = render(Surface(), optionsOf(look));
    EXPECT_LE(meanOf(black)[0], 1.0);
    look.glow = {1.0, 1.0, 1.0};
    const std::array<double, 3> front = meanOf(render(Surface(), optionsOf(look)));
    EXPECT_GT(front[0], 200.0);
    RenderOptions tilted = optionsOf(look);
    tilted.camera = CameraPlace{-0.5 * std::numbers::pi, 1.0};
    EXPECT_NEAR(meanOf(render(Surface(), tilted))[0], front[0], 1.0);
    look.glow = {0.0, 0.25, 0.0};
    const std::array<double, 3> dim = meanOf(render(Surface(), optionsOf(look)));
    EXPECT_LE(dim[0], 1.0);
    EXPECT_GT(dim[1], 50.0);
    EXPECT_LT(dim[1], front[1] - 20.0);
    look.look.colour = {0.3, 0.3, 0.3};
    StandLook unlit = look;
    unlit.glow = {};
    const std::array<double, 3> both = meanOf(render(Surface(), optionsOf(look)));
    const std::array<double, 3> lit = meanOf(render(Surface(), optionsOf(unlit)));
    EXPECT_NEAR(both[0], lit[0], 1e-9);
    EXPECT_GT(both[1], std::max(lit[1], dim[1]) + 5.0);
    // A picture of it: sRGB's level 188 is half the light.
    look.glow = {0.5, 0.5, 0.5};
    StandLook pictured = look;
    pictured.glow = {1.0, 1.0, 1.0};
    pictured.glows = Picture{1, 1, {188, 188, 188}};
    expectAlike(render(Surface(), optionsOf(pictured)), render(Surface(), optionsOf(look)));
    look.glow.x = -1.0;
    EXPECT_THROW((void)render(Surface(), optionsOf(look)), Error);
}

// Clear matter and metal glow, too.
TEST(StandLook, GlowNeedsNoMatter)
{
    for (StandLook look : {clearLook({1.0, 1.0, 1.0}, 1.5), opaqueLook({1.0, 1.0, 1.0})}) {
        look.look.metallic = look.look.transmission > 0.0 ? 0.0 : 1.0;
        const std::array<double, 3> dark = meanOf(render(Surface(), optionsOf(look)));
        look.glow = {0.5, 0.0, 0.0};
        const std::array<double, 3> bright = meanOf(render(Surface(), optionsOf(look)));
        EXPECT_GT(bright[0], dark[0] + 20.0);
        EXPECT_NEAR(bright[2], dark[2], 1.0);
    }
}

// The back of a sheet mirrors as its front does; it was seen as if every ray grazed it.
TEST(StandLook, GlossIsTheSameOnBothSides)
{
    StandLook look = opaqueLook({0.2, 0.5, 0.1});
    look.look.roughness = 0.4;
    RenderOptions front = optionsOf(look);
    RenderOptions back = front;
    for (Vec3& normal : back.stand->normals) {
        normal = -1.0 * normal;
    }
    for (Triangle& triangle : back.stand->triangles) {
        std::swap(triangle[1], triangle[2]);
    }
    expectAlike(render(Surface(), back), render(Surface(), front));
}

TEST(StandLook, CoverageHasHoles)
{
    StandLook look = opaqueLook({0.8, 0.2, 0.2});
    const auto near = [](RenderOptions options) {
        options.look_at = Vec3{0.0, 0.0, 0.05};
        options.distance = 0.2;
        return options;
    };
    RenderOptions empty = near(optionsOf(look));
    for (Vec3& p : empty.stand->vertices) {
        p.x += 1.0;
    }
    const Picture none = render(Surface(), empty);
    const Picture full = render(Surface(), near(optionsOf(look)));
    EXPECT_GT(std::abs(meanOf(full)[0] - meanOf(none)[0]), 30.0);
    const auto covered = [&](std::uint8_t level, std::optional<double> cutoff = {}) {
        look.coverage = Picture{1, 1, {level, level, level}};
        look.cutoff = cutoff;
        return render(Surface(), near(optionsOf(look)));
    };
    expectAlike(covered(255), full);
    expectAlike(covered(0), none);
    const std::array<double, 3> half = meanOf(covered(128));
    EXPECT_GT(half[0], std::min(meanOf(full)[0], meanOf(none)[0]) + 5.0);
    EXPECT_LT(half[0], std::max(meanOf(full)[0], meanOf(none)[0]) - 5.0);
    expectAlike(covered(100, 0.5), none);
    expectAlike(covered(150, 0.5), full);
    // Left there is nothing.
    Picture sides = halves(true);
    for (std::size_t i = 0; i < sides.rgb.size(); i += 3) {
        sides.rgb[i] = sides.rgb[i + 2];
    }
    look.coverage = sides;
    look.cutoff = 0.5;
    const Picture right = render(Surface(), near(optionsOf(look)));
    EXPECT_NEAR(meanOf(right, 12, 28)[0], meanOf(none, 12, 28)[0], 1.0);
    EXPECT_NEAR(meanOf(right, 36, 52)[0], meanOf(full, 36, 52)[0], 1.0);
    look.cutoff = 2.0;
    EXPECT_THROW((void)render(Surface(), optionsOf(look)), Error);
}

TEST(StandLook, ColoursOfVerticesMultiply)
{
    RenderOptions options = optionsOf(opaqueLook({1.0, 1.0, 1.0}));
    options.stand_colours.assign(options.stand->vertices.size(), {0.25, 0.5, 1.0});
    const Picture coloured = render(Surface(), options);
    expectAlike(coloured, render(Surface(), optionsOf(opaqueLook({0.25, 0.5, 1.0}))));
    for (std::size_t v = 0; v < options.stand_colours.size(); ++v) {
        options.stand_colours[v] = options.stand->vertices[v].x < 0.0 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 0.0, 1.0};
    }
    const Picture graded = render(Surface(), options);
    EXPECT_GT(meanOf(graded, 12, 20)[0], meanOf(graded, 44, 52)[0] + 30.0);
    EXPECT_NEAR(meanOf(graded, 31, 33)[0], meanOf(graded, 31, 33)[2], 12.0);
    options.stand_colours.pop_back();
    EXPECT_THROW((void)render(Surface(), options), Error);
    options.stand_colours.push_back({0.0, 0.0, 2.0});
    EXPECT_THROW((void)render(Surface(), options), Error);
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

/// Ball of 5 cm about (0, 0, 0.05 m).
TexturedMesh ball()
{
    TexturedMesh mesh;
    testing::addBall(mesh, 0.05, {0.0, 0.0, 0.05});
    return mesh;
}

RenderOptions ofBall(const StandLook& look)
{
    RenderOptions options = optionsOf(look);
    options.stand = ball();
    options.stand_materials.assign(options.stand->triangles.size(), 0);
    options.shows_room = true;
    return options;
}

// In matter of index 1 ways are straight, and light of 1 cm leaves a share after 10 cm: its tenth power.
TEST(StandLook, MatterOfIndexOneOnlyAbsorbs)
{
    StandLook look = clearLook({1.0, 1.0, 1.0}, 1.0);
    look.thickness = 0.1;
    const Picture clear = render(Surface(), ofBall(look));
    RenderOptions none = ofBall(look);
    none.stand_looks[0].thickness.reset();
    expectAlike(clear, render(Surface(), none));
    look.absorption = Attenuation{{0.9, 0.95, 1.0}, 0.01};
    const Picture tinted = render(Surface(), ofBall(look));
    look.absorption.reset();
    look.thickness.reset();
    look.look.colour = {std::pow(0.9, 5.0), std::pow(0.95, 5.0), 1.0};
    const Picture walls = render(Surface(), ofBall(look));
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(meanOf(tinted, 31, 33)[c], meanOf(walls, 31, 33)[c], 3.0) << "two walls of the fifth power";
    }
    EXPECT_LT(meanOf(tinted)[0], meanOf(clear)[0] - 10.0);
}

// A ball of glass shows the room upside down: bright below, where a thin one is dark.
TEST(StandLook, ABallOfGlassTurnsTheRoom)
{
    StandLook look = clearLook({1.0, 1.0, 1.0}, 1.5);
    const auto upperOverLower = [](const Picture& picture) {
        double upper = 0.0;
        double lower = 0.0;
        for (int y = 16; y < 48; ++y) {
            for (int x = 28; x < 36; ++x) {
                (y < 32 ? upper : lower) += picture.rgb[3 * static_cast<std::size_t>(y * picture.width + x) + 1];
            }
        }
        return upper / lower;
    };
    EXPECT_GT(upperOverLower(render(Surface(), ofBall(look))), 1.05);
    look.thickness = 0.1;
    EXPECT_LT(upperOverLower(render(Surface(), ofBall(look))), 0.95);
}

// A plate of glass with parallel faces moves what is behind sideways, and turns nothing: far away nothing changes but
// what its two faces mirror, which is what a thin wall mirrors.
TEST(StandLook, APlateOfGlassIsAThinWallForWhatIsFar)
{
    const StandLook thin = clearLook({1.0, 1.0, 1.0}, 1.5);
    StandLook matter = thin;
    matter.thickness = 0.002;
    RenderOptions options = optionsOf(matter, 2);
    TexturedMesh& mesh = *options.stand;
    for (std::size_t v = 4; v < 8; ++v) {
        mesh.normals[v] = {0.0, 1.0, 0.0};
    }
    std::swap(mesh.triangles[2][1], mesh.triangles[2][2]);
    std::swap(mesh.triangles[3][1], mesh.triangles[3][2]);
    options.shows_room = true;
    RenderOptions wall = optionsOf(thin);
    wall.framed = ViewBox{{-0.05, 0.0, 0.0}, {0.05, 0.002, 0.1}};
    wall.shows_room = true;
    const auto thick = meanOf(render(Surface(), options));
    const auto flat = meanOf(render(Surface(), wall));
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(thick[c], flat[c], 3.0);
    }
}

TEST(StandLook, DirectionsTurnTheLight)
{
    StandLook look = opaqueLook({0.6, 0.6, 0.6});
    const Picture flat = render(Surface(), optionsOf(look));
    look.normals = Picture{1, 1, {128, 128, 255}};
    const Picture straight = render(Surface(), optionsOf(look));
    for (std::size_t i = 0; i < flat.rgb.size(); ++i) {
        EXPECT_NEAR(straight.rgb[i], flat.rgb[i], 2);  // 128 is not quite the middle
    }
    // Green is up, where uv's y decreases. The same plate tilted by 45 degrees has that light.
    look.normals = Picture{1, 1, {128, 218, 218}};
    const double up = meanOf(render(Surface(), optionsOf(look)))[1];
    look.normals = Picture{1, 1, {128, 38, 218}};
    const double down = meanOf(render(Surface(), optionsOf(look)))[1];
    look.normals.reset();
    RenderOptions tilted = optionsOf(look);
    for (const double side : {1.0, -1.0}) {
        for (Vec3& normal : tilted.stand->normals) {
            normal = {0.0, -std::sqrt(0.5), side * std::sqrt(0.5)};
        }
        EXPECT_NEAR(meanOf(render(Surface(), tilted))[1], side > 0.0 ? up : down, 2.0);
    }
    EXPECT_GT(std::abs(up - down), 10.0);
    look.normals = Picture{1, 1, {128, 218, 218}};
    look.relief = 0.0;
    EXPECT_EQ(render(Surface(), optionsOf(look)), flat);
}

TEST(StandLook, FinishIsRoughnessAndMetal)
{
    StandLook look = opaqueLook({0.9, 0.6, 0.3});
    look.look.metallic = 1.0;
    const Picture metal = render(Surface(), optionsOf(look));
    look.finish = Picture{1, 1, {0, 255, 255}};
    EXPECT_EQ(render(Surface(), optionsOf(look)), metal);
    look.finish = Picture{1, 1, {0, 255, 0}};
    const Picture matt = render(Surface(), optionsOf(look));
    EXPECT_NE(matt, metal);
    look.finish.reset();
    look.look.metallic = 0.0;
    EXPECT_EQ(render(Surface(), optionsOf(look)), matt);
    look.look.metallic = 1.0;
    look.finish = Picture{1, 1, {0, 0, 255}};
    const Picture mirror = render(Surface(), optionsOf(look));
    look.finish.reset();
    look.look.roughness = 0.0;
    EXPECT_EQ(render(Surface(), optionsOf(look)), mirror);
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
    options.stand_looks[0].opacity = 1.0;
    options.stand_looks[0].thickness = 0.0;
    EXPECT_THROW(render(Surface(), options), Error);
    options.stand_looks[0].thickness = 1.0;
    options.stand_looks[0].absorption = Attenuation{{0.0, 1.0, 1.0}, 1.0};
    EXPECT_THROW(render(Surface(), options), Error);
}

}  // namespace
}  // namespace droplet
