// SPDX-License-Identifier: GPL-3.0-or-later
// The whole pipeline on every mask of data/ and on awkward masks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "support/angles.h"
#include "support/command.h"
#include "support/flood.h"
#include "support/masks.h"
#include "support/paths.h"
#include "support/sound.h"

namespace droplet {
namespace {

using testing::Counts;
using testing::disc;
using testing::drawnMask;
using testing::expectSound;
using testing::flooded;
using testing::hardMask;
using testing::readFile;
using testing::runDroplet;
using testing::ScratchDirectory;

const std::string kData = testing::inSource("data/");

std::size_t triangles(const Droplet& droplet)
{
    std::size_t count = 0;
    for (const PlanarMesh& mesh : droplet.meshes) {
        count += mesh.triangles.size();
    }
    return count;
}

Counts counted(const Droplet& droplet)
{
    Counts counts{droplet.domain.droplets.size(), 0};
    for (const Footprint& footprint : droplet.domain.droplets) {
        counts.holes += footprint.holes.size();
    }
    return counts;
}

/// Runs the pipeline without dropping specks; expects the mask's droplets, sound and with the given volume.
void expectSoundDroplets(const Mask& mask, std::size_t triangles = 2'000)
{
    constexpr double kVolume = 1.0 * kMicrolitre;
    DropletOptions options;
    options.trace.speck_size = 0.0;
    options.trace.pixel_size = 0.1 * kMillimetre;
    options.mesh.triangles = triangles;
    options.solve.fill = {FillBy::Volume, kVolume, FillSharing::Total};
    options.allow_less = true;  // the topology is looked at: a microlitre is more than a pixel can hold
    const Droplet droplet = makeDroplet(mask, options);
    expectSound(droplet);
    EXPECT_EQ(counted(droplet), flooded(mask));
    EXPECT_NEAR(droplet.total.volume / kVolume, 1.0, 1e-10);
    EXPECT_NEAR(enclosedVolume(droplet.surface) / kVolume, 1.0, 1e-9);
}

// Masks of data/.

class DataMaskTest : public ::testing::TestWithParam<const char*> {};

TEST_P(DataMaskTest, BecomesASoundDroplet)
{
    DropletOptions options;
    options.allow_less = true;  // the ornament cannot hold 40°
    const Droplet droplet = makeDroplet(readMask(kData + GetParam()), options);
    expectSound(droplet);
    const bool has_less = ::testing::Matches(::testing::Contains(::testing::HasSubstr("was taken")))(droplet.warnings);
    for (const ShapeFigures& figures : droplet.figures) {
        EXPECT_NEAR(figures.contact_angle.mean, 40.0 * kDegree, has_less ? 25.0 * kDegree : 1e-6);
    }
    EXPECT_NEAR(static_cast<double>(triangles(droplet)), 40'000.0, 4'000.0);
    // Where a sheet lies over stairs of pixels, as in the maze, each of their inner corners is rounded by short edges.
    EXPECT_THAT(
        droplet.warnings,
        ::testing::Not(::testing::Contains(::testing::AllOf(
            ::testing::HasSubstr("asked for"), ::testing::Not(::testing::HasSubstr("the footprint's detail takes"))))));
}

TEST_P(DataMaskTest, HasThePromisedAngles)
{
    DropletOptions options;
    options.solve.model = Model::Linear;  // the mesh alone is looked at
    const Droplet droplet = makeDroplet(readMask(kData + GetParam()), options);
    for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
        EXPECT_THAT(testing::brokenPromises(droplet.meshes[k], droplet.domain.droplets[k]), ::testing::IsEmpty());
    }
}

TEST_P(DataMaskTest, KeepsEveryPixelOfItsTopology)
{
    expectSoundDroplets(readMask(kData + GetParam()), 5'000);
}

INSTANTIATE_TEST_SUITE_P(Data, DataMaskTest,
                         ::testing::Values("ampersand.png", "butterfly.jpg", "cluster.png", "debian_astro.png",
                                           "debian_swirl.png", "deer.bmp", "flourish.png", "handprint.jpg",
                                           "inkscape.png", "letter_g_1bit.png", "line_of_type.png", "maze.pgm",
                                           "ornament.png", "raindrops.png", "sakura.tif", "shamrock.webp"),
                         [](const auto& info) {
                             const std::string name = info.param;
                             return name.substr(0, name.find('.'));
                         });

TEST(DataMasks, GiveTheSameBytesInEveryProcess)
{
    // Addresses differ between processes; no order may depend on them.
    const ScratchDirectory scratch;
    for (const char* name : {"cluster.png", "debian_swirl.png", "maze.pgm"}) {
        SCOPED_TRACE(name);
        for (const char* output : {"first.glb", "second.glb"}) {
            const auto result = runDroplet({kData + name, (scratch.path() / output).string(), "--quiet"});
            ASSERT_EQ(result.exit_code, 0) << result.error;
        }
        const std::string first = readFile(scratch.path() / "first.glb");
        EXPECT_GT(first.size(), 100'000U);
        EXPECT_TRUE(first == readFile(scratch.path() / "second.glb"));
    }
}

// Awkward masks.

struct AwkwardMask {
    const char* name;
    Counts counts;
    std::function<Mask()> make;
};

void PrintTo(const AwkwardMask& mask, std::ostream* out)
{
    *out << mask.name;
}

class AwkwardMaskTest : public ::testing::TestWithParam<AwkwardMask> {};

TEST_P(AwkwardMaskTest, BecomesASoundDroplet)
{
    const Mask mask = GetParam().make();
    ASSERT_EQ(flooded(mask), GetParam().counts);
    expectSoundDroplets(mask);
}

Mask comb()
{
    return hardMask(63, 30, [](Vec2 p) { return p.y < 4.0 || (static_cast<int>(p.x) % 2 == 0 && p.y < 27.0); });
}

Mask spiral()
{
    return hardMask(100, 100, [](Vec2 p) {
        const Vec2 d = p - Vec2{50.0, 50.0};
        const double turn = (std::atan2(d.y, d.x) + std::numbers::pi) / (2.0 * std::numbers::pi);
        const double arm = length(d) / 9.0 - turn;
        return arm > 0.0 && arm < 4.0 && arm - std::floor(arm) < 0.45;
    });
}

Mask rings()
{
    return hardMask(90, 90, [](Vec2 p) {
        const double r = length(p - Vec2{45.0, 45.0});
        return r < 6.0 || (r > 12.0 && r < 20.0) || (r > 26.0 && r < 40.0);
    });
}

INSTANTIATE_TEST_SUITE_P(
    Mask, AwkwardMaskTest,
    ::testing::Values(
        AwkwardMask{"OnePixel", {1, 0}, [] { return drawnMask("#"); }},
        AwkwardMask{"OnePixelInTheMiddle", {1, 0}, [] { return drawnMask("...\n.#.\n..."); }},
        AwkwardMask{
            "HorizontalLine", {1, 0}, [] { return hardMask(40, 9, [](Vec2 p) { return p.y > 4.0 && p.y < 5.0; }); }},
        AwkwardMask{"DiagonalLine", {1, 0}, [] { return hardMask(30, 30, [](Vec2 p) { return p.x == p.y; }); }},
        AwkwardMask{"DiagonalCross",
                    {1, 0},
                    [] { return hardMask(31, 31, [](Vec2 p) { return p.x == p.y || p.x + p.y == 31.0; }); }},
        AwkwardMask{"Checkerboard",
                    {1, 98},
                    [] { return hardMask(16, 16, [](Vec2 p) { return static_cast<int>(p.x + p.y) % 2 == 0; }); }},
        AwkwardMask{"AllLiquid", {1, 0}, [] { return hardMask(20, 12, [](Vec2) { return true; }); }},
        AwkwardMask{"Frame",
                    {1, 1},
                    [] { return hardMask(20, 14, [](Vec2 p) { return p.x < 2 || p.y < 2 || p.x > 18 || p.y > 12; }); }},
        AwkwardMask{"FrameOfOnePixel",
                    {1, 1},
                    [] { return hardMask(20, 14, [](Vec2 p) { return p.x < 1 || p.y < 1 || p.x > 19 || p.y > 13; }); }},
        AwkwardMask{
            "AllButOnePixel", {1, 1}, [] { return hardMask(21, 15, [](Vec2 p) { return p.x != 9.5 || p.y != 6.5; }); }},
        AwkwardMask{"IslandsInRings", {3, 2}, rings},
        AwkwardMask{"DiscsThatTouchAtACorner",
                    {1, 0},
                    [] {
                        return drawnMask(
                            "..##......\n.####.....\n######....\n######....\n.####.....\n..###.....\n"
                            ".....###..\n.....####.\n....######\n....######\n.....####.\n......##..");
                    }},
        AwkwardMask{"Spiral", {1, 0}, spiral}, AwkwardMask{"Comb", {1, 0}, comb},
        AwkwardMask{"BarelyLiquid",
                    {1, 0},
                    [] {
                        Mask mask = hardMask(16, 16, disc({8.0, 8.0}, 5.0));
                        for (std::uint16_t& c : mask.coverage) {
                            c = c > 0 ? 32768 : 32767;
                        }
                        return mask;
                    }}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(AwkwardMasks, RefusesSpecksAlone)
{
    for (const Mask& mask : {drawnMask("#"), drawnMask("....\n.#..\n...#"), drawnMask("...\n...")}) {
        try {
            makeDroplet(mask);
            ADD_FAILURE() << "a droplet was made from specks";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        }
    }
}

/// Uniform numbers in [0, 1) from Knuth's 64-bit linear congruential generator, the same on every platform.
class Noise {
public:
    explicit Noise(std::uint64_t seed) : state_(seed) {}
    double next()
    {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return static_cast<double>(state_ >> 11U) * 0x1p-53;
    }

private:
    std::uint64_t state_;
};

class NoiseMaskTest : public ::testing::TestWithParam<bool> {};

TEST_P(NoiseMaskTest, BecomesSoundDroplets)
{
    const bool hard = GetParam();
    Noise noise(hard ? 1 : 2);
    for (int k = 0; k < 100; ++k) {
        const double density = 0.05 + 0.9 * k / 99.0;
        Mask mask;
        mask.width = 4 + static_cast<int>(20.0 * noise.next());
        mask.height = 4 + static_cast<int>(20.0 * noise.next());
        for (int i = 0; i < mask.width * mask.height; ++i) {
            const double level = std::clamp(0.5 + density - noise.next(), 0.0, 1.0);
            mask.coverage.push_back(
                static_cast<std::uint16_t>(hard ? (level >= 0.5 ? 65535 : 0) : std::lround(65535.0 * level)));
        }
        SCOPED_TRACE("mask " + std::to_string(k));
        if (flooded(mask).droplets == 0) {
            EXPECT_THROW(makeDroplet(mask), Error);
            continue;
        }
        expectSoundDroplets(mask, 1'000);
        if (HasFatalFailure()) {
            return;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Mask, NoiseMaskTest, ::testing::Values(true, false),
                         [](const auto& info) { return std::string(info.param ? "Hard" : "Grey"); });

TEST(AwkwardMasks, LargeMaskWithOneSmallDroplet)
{
    constexpr int kSide = 4096;
    Mask mask;
    mask.width = kSide;
    mask.height = kSide;
    mask.coverage.assign(static_cast<std::size_t>(kSide) * kSide, 0);
    const testing::Inside inside = disc({3000.0, 777.0}, 25.0);
    for (int y = 740; y < 820; ++y) {
        for (int x = 2960; x < 3040; ++x) {
            mask.coverage[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)] =
                inside({x + 0.5, y + 0.5}) ? 65535 : 0;
        }
    }
    DropletOptions options;
    options.trace.width = 4.096;
    options.mesh.triangles = 2'000;
    const Droplet droplet = makeDroplet(mask, options);
    expectSound(droplet);
    EXPECT_EQ(counted(droplet), (Counts{1, 0}));
    EXPECT_NEAR(droplet.total.footprint_area / (std::numbers::pi * 25e-3 * 25e-3), 1.0, 1e-2);
    Vec2 middle;
    for (const Vec2 v : droplet.meshes[0].vertices) {
        middle = middle + (1.0 / static_cast<double>(droplet.meshes[0].vertices.size())) * v;
    }
    EXPECT_NEAR(middle.x, 3.000 - 2.048, 1e-3);
    EXPECT_NEAR(middle.y, 2.048 - 0.777, 1e-3);
}

}  // namespace
}  // namespace droplet
