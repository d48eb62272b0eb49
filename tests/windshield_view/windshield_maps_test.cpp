// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield_view/windshield_maps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/windshield/balance.h"
#include "droplet/windshield_view/glass_maps.h"

namespace droplet {
namespace {

/// Everything happens: rain, running, merging, tearing, wiping.
WindshieldParameters storm()
{
    WindshieldParameters parameters;
    parameters.glass = Glass(Glass::Cylinder{.width = 0.5, .height = 0.3, .radius = 5.0});
    parameters.rainfall = 100.0 * kMillimetrePerHour;
    parameters.vehicle = constantSpeed(17.0);
    parameters.forces.wetting.hysteresis = 0.2;
    parameters.wipers = tandemWipers(parameters.glass, 1.2);
    parameters.splashes = true;
    return parameters;
}

struct Map {
    WindshieldMaps maps;
    std::vector<std::uint16_t> pixels;

    explicit Map(const Glass& glass, const WindshieldMapOptions& options = {.width = 300})
        : maps(glass, options),
          pixels(4 * static_cast<std::size_t>(maps.width()) * static_cast<std::size_t>(maps.height()))
    {
    }

    [[nodiscard]] float at(std::size_t pixel, std::size_t channel) const
    {
        return static_cast<float>(Eigen::numext::bit_cast<Eigen::half>(pixels[4 * pixel + channel]));
    }
};

TEST(WindshieldMapsOf, AreThoseOfNewOnesAfterAnySteps)
{
    const WindshieldParameters parameters = storm();
    WindshieldState state = startWindshield(parameters);
    Map kept(parameters.glass);
    for (int k = 0; k < 120; ++k) {
        state = step(std::move(state), parameters, 1.0 / 60.0);
        if (k % 7 != 3) {  // not every step is shown
            kept.maps.update(state, kept.pixels);
        }
    }
    EXPECT_GT(state.counts.wiped, 0U);
    EXPECT_GT(state.counts.merged, 0U);
    EXPECT_GT(state.counts.swept, 0U);
    Map fresh(parameters.glass);
    fresh.maps.update(state, fresh.pixels);
    EXPECT_EQ(kept.pixels, fresh.pixels);
    EXPECT_TRUE(kept.maps.update(state, kept.pixels).empty()) << "nothing has changed";
    kept.maps.update(startWindshield(parameters), kept.pixels);
    EXPECT_THAT(kept.pixels, ::testing::Each(0)) << "all is taken away again without a rest";
}

TEST(WindshieldMapsOf, HaveRimsOfSplashesWithoutWater)
{
    WindshieldParameters parameters;
    parameters.glass = Glass(Glass::Cylinder{.width = 0.1, .height = 0.1, .radius = 5.0});
    WindshieldState state = startWindshield(parameters);
    Splash splash = splashOf(3e-3, 12.0, parameters.forces.liquid).value();
    splash.position = {0.05, 0.05};
    state.splashes = {splash};
    state.time = 0.25 * splash.lifetime;
    const SplashRing ring = ringOf(splash, state.time).value();
    Map map(parameters.glass);
    map.maps.update(state, map.pixels);
    double wet = 0.0;
    const double pixel = 0.1 / 300.0;
    for (std::size_t k = 0; k < map.pixels.size() / 4; ++k) {
        EXPECT_EQ(map.at(k, 2), 0.0F) << "its water is in a droplet";
        const double x = (static_cast<double>(k % 300) + 0.5) * pixel - 0.05;
        const double y = 0.05 - (static_cast<double>(k / 300) + 0.5) * pixel;
        const double off = std::hypot(x, y) - ring.radius;
        if (map.at(k, 3) > 0.0F) {
            EXPECT_LT(std::abs(off), 2.0 * ring.half_width + pixel);
            // Both flanks slope away from the middle of the rim.
            const double outward =
                (x * static_cast<double>(map.at(k, 0)) + y * static_cast<double>(map.at(k, 1))) / std::hypot(x, y);
            EXPECT_GE(outward * off, -1e-6);
        }
        wet += static_cast<double>(map.at(k, 3)) * pixel * pixel;
    }
    // Knots change the width by chance, by a quarter of it at a quarter of its lifetime.
    const double area = 2.0 * std::numbers::pi * ring.radius * 2.0 * ring.half_width * 0.75;
    EXPECT_NEAR(wet, area, 0.25 * area);
    state.time = splash.lifetime;
    map.maps.update(state, map.pixels);
    EXPECT_THAT(map.pixels, ::testing::Each(0)) << "the ring is gone without a rest";
}

TEST(WindshieldMapsOf, NameEveryTileThatChanges)
{
    const WindshieldParameters parameters = storm();
    WindshieldState state = startWindshield(parameters);
    Map map(parameters.glass);
    std::size_t changed = 0;
    for (int k = 0; k < 40; ++k) {
        state = step(std::move(state), parameters, 1.0 / 60.0);
        const std::vector<std::uint16_t> before = map.pixels;
        const std::vector<MapTile> tiles = map.maps.update(state, map.pixels);
        std::vector<std::uint16_t> copied = before;
        for (const MapTile& tile : tiles) {
            ASSERT_LE(tile.x + tile.width, map.maps.width());
            ASSERT_LE(tile.y + tile.height, map.maps.height());
            for (int y = tile.y; y < tile.y + tile.height; ++y) {
                const std::size_t begin = 4 * static_cast<std::size_t>(y * map.maps.width() + tile.x);
                std::copy_n(map.pixels.begin() + static_cast<std::ptrdiff_t>(begin), 4 * tile.width,
                            copied.begin() + static_cast<std::ptrdiff_t>(begin));
            }
        }
        EXPECT_EQ(copied, map.pixels);
        changed += tiles.size();
    }
    EXPECT_GT(changed, 40U);
}

TEST(GlassMapFramesOf, AreThoseOfTheStateAlone)
{
    const WindshieldParameters parameters = storm();
    for (const BodyShape body : {BodyShape::Capsule, BodyShape::Capillary}) {
        const GlassMapOptions options{.width = 200, .body = body};
        WindshieldState state = startWindshield(parameters);
        GlassMapFrames frames(parameters.glass, options);
        for (int k = 0; k < 60; ++k) {
            state = step(std::move(state), parameters, 1.0 / 60.0);
            if (k % 7 != 3) {
                frames.maps(state);
            }
        }
        EXPECT_GT(state.counts.wiped, 0U);
        for (const WindshieldState& shown : {state, startWindshield(parameters)}) {
            const GlassMaps& kept = frames.maps(shown);
            const GlassMaps fresh = glassMaps(parameters.glass, shown, options);
            EXPECT_EQ(kept.normal, fresh.normal);
            EXPECT_EQ(kept.thickness, fresh.thickness);
            EXPECT_EQ(kept.velocity, fresh.velocity);
        }
        const GlassFloatMaps kept = frames.floatMaps(state);
        const GlassFloatMaps fresh = glassFloatMaps(parameters.glass, state, options);
        EXPECT_EQ(kept.normal, fresh.normal);
        EXPECT_EQ(kept.thickness, fresh.thickness);
        EXPECT_EQ(kept.velocity, fresh.velocity);
    }
}

TEST(WindshieldMapsOf, AgreeWithTheMapsOfFiles)
{
    WindshieldParameters parameters = storm();
    parameters.wipers.clear();
    WindshieldState state = startWindshield(parameters);
    for (int k = 0; k < 60; ++k) {
        state = step(std::move(state), parameters, 1.0 / 60.0);
    }
    Map map(parameters.glass);
    map.maps.update(state, map.pixels);
    const GlassFloatMaps files = glassFloatMaps(parameters.glass, state, {.width = 300});
    ASSERT_EQ(files.normal.width, map.maps.width());
    ASSERT_EQ(files.normal.height, map.maps.height());
    double water = 0.0;
    for (std::size_t i = 0; i < files.thickness.values.size(); ++i) {
        // Half floats have 11 bits.
        // The normals of files, which bare glass draws upright, have the same directions along the glass.
        const float x = map.at(i, 0);
        const float y = map.at(i, 1);
        EXPECT_NEAR(x * files.normal.values[3 * i + 1], y * files.normal.values[3 * i], 1e-3F);
        EXPECT_GE(x * files.normal.values[3 * i] + y * files.normal.values[3 * i + 1], -1e-6F);
        EXPECT_LE(x * x + y * y, 1.001F * map.at(i, 3) * map.at(i, 3));
        EXPECT_NEAR(map.at(i, 2), 1e3F * files.thickness.values[i], 5e-4F * map.at(i, 2) + 1e-6F);
        EXPECT_GE(map.at(i, 3), 0.0F);
        water += static_cast<double>(map.at(i, 2));
    }
    const WaterBalance all = balanceOf(state);
    const double pixel =
        parameters.glass.width() * parameters.glass.height() / static_cast<double>(files.thickness.values.size());
    EXPECT_NEAR(1e-3 * water * pixel / (all.on_glass_still + all.on_glass_running), 1.0, 0.005);
}

TEST(WindshieldMapsOf, RefusesOtherSizes)
{
    EXPECT_THROW(WindshieldMaps(Glass(), {.width = 8}), Error);
    EXPECT_THROW(WindshieldMaps(Glass(Glass::Cylinder{.width = 0.1, .height = 2.0}), {.width = 8192}), Error);
    WindshieldMaps maps{Glass()};
    std::vector<std::uint16_t> small(16);
    EXPECT_THROW(maps.update(startWindshield({}), small), Error);
}

WindshieldState drenched(WindshieldParameters& parameters)
{
    parameters = storm();
    parameters.splashes = false;
    parameters.runoff = 1.0;
    parameters.tear_off_weber = std::numeric_limits<double>::infinity();  // parts would overlap
    WindshieldState state = startWindshield(parameters);
    for (int k = 0; k < 300; ++k) {
        state = step(std::move(state), parameters, 1.0 / 60.0);
    }
    return state;
}

TEST(FilmInMaps, HasAllWaterAtAnyWidth)
{
    WindshieldParameters parameters;
    const WindshieldState state = drenched(parameters);
    const WaterBalance all = balanceOf(state);
    const double on_glass = all.on_glass_film + all.on_glass_still + all.on_glass_running;
    ASSERT_GT(all.on_glass_film, 0.3 * on_glass);
    const double area = parameters.glass.width() * parameters.glass.height();
    for (const int width : {16, 33, 200, 1000}) {
        const GlassFloatMaps maps = glassFloatMaps(parameters.glass, state, {.width = width});
        double water = 0.0;
        for (const float thickness : maps.thickness.values) {
            water += static_cast<double>(thickness) * area / static_cast<double>(maps.thickness.values.size());
        }
        EXPECT_NEAR(water / on_glass, 1.0, 0.005) << width;
    }
}

TEST(FilmInMaps, IsThatOfNewMapsAfterAnySteps)
{
    WindshieldParameters parameters;
    WindshieldState state = drenched(parameters);
    GlassMapFrames frames(parameters.glass, {.width = 300});
    for (int k = 0; k < 10; ++k) {
        state = step(std::move(state), parameters, 1.0 / 60.0);
        if (k % 3 != 1) {
            frames.maps(state);
        }
    }
    const GlassMaps& kept = frames.maps(state);
    const GlassMaps fresh = glassMaps(parameters.glass, state, {.width = 300});
    EXPECT_EQ(kept.thickness.levels, fresh.thickness.levels);
    EXPECT_EQ(kept.normal.levels, fresh.normal.levels);
    state.film = Runoff();
    EXPECT_EQ(frames.maps(state).normal.levels, glassMaps(parameters.glass, state, {.width = 300}).normal.levels);
}

/// A film that grows evenly to the right, on the default glass of a storm.
Runoff wedge(double slope)
{
    Runoff film;
    film.cell = 4e-3;
    film.columns = 125;
    film.rows = 75;
    for (std::uint32_t k = 0; k < film.columns * film.rows; ++k) {
        film.thickness.push_back(
            static_cast<std::int32_t>(slope * film.cell * (k % film.columns) / Runoff::kThickness));
    }
    return film;
}

TEST(FilmInMaps, LeansAsItsThicknessSays)
{
    const WindshieldParameters parameters = storm();
    WindshieldState state = startWindshield(parameters);
    constexpr double kSlope = 2e-3;
    state.film = wedge(kSlope);
    const GlassFloatMaps maps = glassFloatMaps(parameters.glass, state, {.width = 500});
    EXPECT_NEAR(static_cast<double>(maps.thickness.values[150 * 500 + 250]), kSlope * (0.2505 - 2e-3), 2e-6);
    // Waves lean to all sides alike: only the mean over many of them leans with the film.
    double right = 0.0;
    double up = 0.0;
    double waves = 0.0;
    constexpr int kMargin = 20;  // at the edges the film ends
    constexpr double kShare = 1.0 / ((250.0 - kMargin) * (300.0 - 2.0 * kMargin));
    for (int y = kMargin; y < 300 - kMargin; ++y) {
        for (int x = 250; x < 500 - kMargin; ++x) {
            const float* const normal = &maps.normal.values[3 * static_cast<std::size_t>(500 * y + x)];
            right += kShare * static_cast<double>(normal[0]);
            up += kShare * static_cast<double>(normal[1]);
            waves += kShare * std::abs(static_cast<double>(normal[0]));
        }
    }
    EXPECT_NEAR(right, -kSlope, 0.2 * kSlope);
    EXPECT_NEAR(up, 0.0, 0.2 * kSlope);
    EXPECT_GT(waves, 10.0 * kSlope);
}

TEST(FilmInMaps, WavesRunAndTakeNoWaterAlong)
{
    const WindshieldParameters parameters = storm();
    WindshieldState state = startWindshield(parameters);
    state.film = wedge(1e-3);
    const auto maps = [&](double down) {
        state.film.drift = {0.0, -down};
        return glassFloatMaps(parameters.glass, state, {.width = 500});
    };
    const GlassFloatMaps before = maps(0.0);
    const GlassFloatMaps after = maps(3e-3);
    EXPECT_EQ(before.thickness.values, after.thickness.values);
    EXPECT_NE(before.normal.values, after.normal.values);
    // Both kinds of waves repeat after 32 units: long ones, which run half as fast, every 0.64 m, and short ones every
    // 0.1536 m; 3.84 m is a multiple of both.
    const GlassFloatMaps around = maps(3.84);
    for (std::size_t k = 0; k < before.normal.values.size(); ++k) {
        ASSERT_NEAR(before.normal.values[k], around.normal.values[k], 1e-3F);
    }
}

}  // namespace
}  // namespace droplet
