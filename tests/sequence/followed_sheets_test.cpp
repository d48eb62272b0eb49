// SPDX-License-Identifier: GPL-3.0-or-later
//
// Films of droplets that hang over their rims: vertices keep their identity, and shapes are those of frames that are
// solved by themselves.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/io/animation.h"
#include "droplet/sequence/sequence.h"
#include "droplet/units.h"
#include "support/masks.h"
#include "support/sound.h"

namespace droplet {
namespace {

using testing::disc;
using testing::expectSound;
using testing::Inside;
using testing::smoothMask;

constexpr double kPixel = 0.05 * kMillimetre;

Outline outlineOf(const Inside& inside)
{
    return trace(smoothMask(96, 64, inside), {.pixel_size = kPixel});
}

SequenceOptions optionsFor(double angle, VolumeMode mode = VolumeMode::Fill)
{
    SequenceOptions options;
    options.volume_mode = mode;
    options.droplet.mesh.triangles = 1500;
    options.droplet.solve.fill = {FillBy::ContactAngle, angle * kDegree, FillSharing::Each};
    return options;
}

std::vector<Frame> framesOf(const std::vector<Inside>& masks, const SequenceOptions& options)
{
    std::vector<Frame> frames;
    for (const Inside& inside : masks) {
        const Outline outline = outlineOf(inside);
        frames.push_back(frames.empty() ? firstFrame(outline, options) : nextFrame(frames.back(), outline, options));
        expectSound(frames.back().droplet);
    }
    return frames;
}

void expectSameLiquid(const Droplet& a, const Droplet& b, double tolerance)
{
    EXPECT_NEAR(a.total.volume, b.total.volume, tolerance * b.total.volume);
    EXPECT_NEAR(a.total.liquid_area, b.total.liquid_area, tolerance * b.total.liquid_area);
    EXPECT_NEAR(a.total.height_max, b.total.height_max, tolerance * b.total.height_max);
}

TEST(FollowedSheets, ABeadThatGrowsIsOneMesh)
{
    std::vector<Inside> masks;
    for (int k = 0; k < 6; ++k) {
        masks.push_back(disc({48, 32}, 18.0 + 0.3 * k));
    }
    const SequenceOptions options = optionsFor(120.0);
    const std::vector<Frame> frames = framesOf(masks, options);
    for (std::size_t k = 1; k < frames.size(); ++k) {
        EXPECT_TRUE(frames[k].continues) << k;
        EXPECT_EQ(frames[k].vertices_kept, 1.0);
        EXPECT_EQ(frames[k].droplet.surface.triangles, frames[0].droplet.surface.triangles);
        EXPECT_NEAR(frames[k].droplet.total.contact_angle.mean, 120.0 * kDegree, 1e-8);
        expectSameLiquid(frames[k].droplet, firstFrame(outlineOf(masks[k]), options).droplet, 5e-3);
    }
}

TEST(FollowedSheets, ABeadThatMovesKeepsItsShape)
{
    const std::vector<Frame> frames =
        framesOf({disc({40, 32}, 18), disc({42, 32}, 18)}, optionsFor(130.0, VolumeMode::Track));
    ASSERT_TRUE(frames[1].continues);
    EXPECT_EQ(frames[1].droplets[0].volume, frames[0].droplets[0].volume);
    const Vec3 way{2.0 * kPixel, 0.0, 0.0};
    const CapillarySurface& from = frames[0].droplet.solution.droplets[0];
    const CapillarySurface& to = frames[1].droplet.solution.droplets[0];
    for (std::size_t v = 0; v < from.vertices.size(); ++v) {
        ASSERT_LT(length(to.vertices[v] - from.vertices[v] - way), 0.01 * kPixel) << v;
    }
}

/// A plus sign, whose inner corners are rounded.
Inside plus(double size)
{
    return [=](Vec2 p) {
        const Vec2 d{std::abs(p.x - 48.0), std::abs(p.y - 32.0)};
        return std::max(d.x, d.y) < size && std::min(d.x, d.y) < 0.4 * size;
    };
}

TEST(FollowedSheets, RoundedCornersAndTheirBasesMoveAlong)
{
    SequenceOptions options = optionsFor(75.0);
    options.droplet.mesh.triangles = 5000;
    const auto outline = [](double size) {
        const Inside inside = [=](Vec2 p) { return plus(size)(p + Vec2{-150.0, -150.0} + Vec2{48.0, 32.0}); };
        return trace(testing::hardMask(300, 300, inside), {.pixel_size = 0.2 * kPixel});
    };
    const Frame first = firstFrame(outline(120), options);
    const CapillarySurface& surface = first.droplet.solution.droplets[0];
    ASSERT_FALSE(surface.isHeightField());
    EXPECT_NE(surface.rimVertexCount(), first.droplet.meshes[0].rimVertexCount());
    Frame last = first;
    for (const double size : {122.0, 124.0}) {
        last = nextFrame(last, outline(size), options);
        expectSound(last.droplet);
        EXPECT_TRUE(last.continues) << size;
        EXPECT_EQ(last.droplet.surface.triangles, first.droplet.surface.triangles);
    }
    expectSameLiquid(last.droplet, firstFrame(outline(124), options).droplet, 1e-2);
}

TEST(FollowedSheets, HeightFieldsMayBeBesideThem)
{
    // Only the plus hangs over its rim.
    std::vector<Inside> masks;
    for (int k = 0; k < 3; ++k) {
        masks.push_back([=](Vec2 p) {
            return disc({14.0 + k, 32}, 10)(p) || plus(20.0 + 0.5 * k)(p + Vec2{-10.0, 0.0});
        });
    }
    const std::vector<Frame> frames = framesOf(masks, optionsFor(70.0));
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const std::vector<CapillarySurface>& surfaces = frames[k].droplet.solution.droplets;
        ASSERT_EQ(surfaces.size(), 2U);
        EXPECT_NE(surfaces[0].isHeightField(), surfaces[1].isHeightField());
        EXPECT_EQ(frames[k].continues, k > 0);
    }
}

TEST(FollowedSheets, AFrameThatCannotFollowIsSolvedAnew)
{
    const auto ellipse = [](double a, double b) {
        return [=](Vec2 p) { return std::hypot((p.x - 48.0) / a, (p.y - 32.0) / b) < 1.0; };
    };
    const SequenceOptions options = optionsFor(120.0);
    const std::vector<Frame> frames = framesOf({ellipse(16, 16), ellipse(31, 27), ellipse(31, 27.5)}, options);
    EXPECT_FALSE(frames[1].continues) << "triangles would be too large";
    EXPECT_LT(*frames[1].vertices_kept, 1.0);
    EXPECT_NEAR(frames[1].droplet.total.contact_angle.mean, 120.0 * kDegree, 1e-8);
    expectSameLiquid(frames[1].droplet, firstFrame(outlineOf(ellipse(31, 27)), options).droplet, 5e-3);
    EXPECT_TRUE(frames[2].continues) << "a new run begins";
}

TEST(FollowedSheets, AreTheSameAtAnyNumberOfThreads)
{
    const auto filmOf = [](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Animation film({.frames_per_second = 24.0});
        for (const Frame& frame : framesOf({disc({40, 32}, 18), disc({41, 32}, 18.5)}, optionsFor(120.0))) {
            film.add(frame.droplet.surface, frame.continues);
        }
        std::ostringstream out;
        film.write(out);
        return out.str();
    };
    EXPECT_EQ(filmOf(1), filmOf(2));
}

/// With tracked volumes, a bead that appears gets the angle that was asked for, and the one before keeps its volume.
TEST(FollowedSheets, ANewBeadHangsOverItsRim)
{
    const Inside one = disc({24, 32}, 12.0);
    const Inside other = disc({70, 32}, 9.0);
    const std::vector<Frame> frames =
        framesOf({one, [=](Vec2 p) { return one(p) || other(p); }}, optionsFor(110.0, VolumeMode::Track));
    ASSERT_EQ(frames[1].droplet.figures.size(), 2U);
    EXPECT_NEAR(frames[1].droplets[0].volume, frames[0].droplet.total.volume, 1e-12 * frames[0].droplet.total.volume);
    for (const ShapeFigures& figures : frames[1].droplet.figures) {
        EXPECT_NEAR(figures.contact_angle.mean, 110.0 * kDegree, 0.2 * kDegree);
    }
}

/// At one pressure, all beads follow together, and liquid flows between them.
TEST(FollowedSheets, BeadsThatShareTheirLiquidAreOneMesh)
{
    std::vector<Inside> masks;
    for (int k = 0; k < 4; ++k) {
        masks.push_back([=](Vec2 p) { return disc({24, 32}, 14.0)(p) || disc({70, 32}, 8.0 + 0.2 * k)(p); });
    }
    SequenceOptions options = optionsFor(100.0, VolumeMode::Total);
    options.droplet.solve.fill.sharing = FillSharing::Total;
    const std::vector<Frame> frames = framesOf(masks, options);
    for (std::size_t k = 1; k < frames.size(); ++k) {
        const Droplet& droplet = frames[k].droplet;
        EXPECT_TRUE(frames[k].continues) << k;
        EXPECT_NEAR(droplet.total.volume, frames[0].droplet.total.volume, 1e-9 * droplet.total.volume);
        EXPECT_EQ(droplet.solution.droplets[0].pressure, droplet.solution.droplets[1].pressure);
        EXPECT_NE(droplet.figures[1].volume, frames[k - 1].droplet.figures[1].volume);
    }
}

}  // namespace
}  // namespace droplet
