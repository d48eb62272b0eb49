// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/sequence/sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "support/masks.h"
#include "support/sound.h"

namespace droplet {
namespace {

using testing::disc;
using ::testing::ElementsAre;
using testing::expectSound;
using ::testing::HasSubstr;
using testing::Inside;
using ::testing::IsEmpty;
using testing::smoothMask;
using ::testing::UnorderedElementsAre;

constexpr double kPixel = 0.1 * kMillimetre;

Outline outlineOf(const Inside& inside, int width = 96, int height = 64)
{
    return trace(smoothMask(width, height, inside), {.pixel_size = kPixel});
}

SequenceOptions optionsFor(VolumeMode mode)
{
    SequenceOptions options;
    options.volume_mode = mode;
    options.droplet.mesh.triangles = 1500;
    options.droplet.solve.model = Model::Linear;
    if (mode == VolumeMode::Total) {
        options.droplet.solve.fill = {FillBy::Volume, 2 * kMicrolitre, FillSharing::Total};
    }
    return options;
}

std::vector<Frame> framesOf(const std::vector<Outline>& outlines, const SequenceOptions& options)
{
    std::vector<Frame> frames;
    for (const Outline& outline : outlines) {
        frames.push_back(frames.empty() ? firstFrame(outline, options) : nextFrame(frames.back(), outline, options));
        if (!frames.back().droplets.empty()) {
            expectSound(frames.back().droplet);
        }
    }
    return frames;
}

double volume(const Frame& frame)
{
    return std::accumulate(frame.droplets.begin(), frame.droplets.end(), 0.0,
                           [](double sum, const Ancestry& droplet) { return sum + droplet.volume; });
}

/// Checks that volumes are those prescribed and change only by the reported gains and losses.
void expectVolumesAddUp(const std::vector<Frame>& frames)
{
    for (std::size_t k = 0; k < frames.size(); ++k) {
        SCOPED_TRACE(k);
        const Frame& frame = frames[k];
        ASSERT_EQ(frame.droplets.size(), frame.droplet.meshes.size());
        std::set<std::size_t> ids;
        for (std::size_t i = 0; i < frame.droplets.size(); ++i) {
            EXPECT_NEAR(frame.droplet.figures[i].volume / frame.droplets[i].volume, 1.0, 1e-9);
            EXPECT_TRUE(ids.insert(frame.droplets[i].id).second);
        }
        if (k > 0) {
            const double expected = volume(frames[k - 1]) - frame.volume_lost + frame.volume_gained;
            EXPECT_NEAR(volume(frame), expected, 1e-9 * volume(frames[k - 1]) + 1e-9 * volume(frame));
        }
    }
}

/// Ring whose hole closes from frame to frame; the last frame has no hole.
std::vector<Outline> closingHole()
{
    std::vector<Outline> outlines;
    for (const double hole : {9.0, 8.0, 7.0, 6.0, 5.0, 0.0}) {
        outlines.push_back(outlineOf(
            [=](Vec2 p) {
                const Vec2 d = p - Vec2{32, 32};
                return length(d) < 25 && length(d - Vec2{3, 1}) >= hole;
            },
            64, 64));
    }
    return outlines;
}

std::vector<Outline> movingDisc(double step)
{
    std::vector<Outline> outlines;
    for (int k = 0; k < 6; ++k) {
        outlines.push_back(outlineOf(disc({30 + k * step, 32}, 20)));
    }
    return outlines;
}

TEST(Sequence, TotalKeepsTheVolumeAndOnePressureWhateverTheTopology)
{
    std::vector<Outline> outlines = closingHole();
    outlines.push_back(outlineOf([](Vec2 p) { return disc({20, 20}, 12)(p) || disc({45, 45}, 15)(p); }, 64, 64));
    const std::vector<Frame> frames = framesOf(outlines, optionsFor(VolumeMode::Total));
    expectVolumesAddUp(frames);
    for (const Frame& frame : frames) {
        EXPECT_NEAR(frame.droplet.total.volume / (2 * kMicrolitre), 1.0, 1e-9);
        EXPECT_EQ(frame.volume_gained, 0.0);
        EXPECT_EQ(frame.volume_lost, 0.0);
    }
    const std::vector<CapillarySurface>& two = frames.back().droplet.solution.droplets;
    ASSERT_EQ(two.size(), 2U);
    EXPECT_NEAR(two[0].pressure / two[1].pressure, 1.0, 1e-9);
}

TEST(Sequence, TotalKeepsTheVolumeOfTheFirstFrameIfNoneIsGiven)
{
    SequenceOptions options = optionsFor(VolumeMode::Total);
    options.droplet.solve.fill = {FillBy::ContactAngle, 35 * kDegree, FillSharing::Total};
    const std::vector<Frame> frames = framesOf(closingHole(), options);
    EXPECT_NEAR(frames[0].droplet.total.contact_angle.mean, 35 * kDegree, 1e-6);
    for (const Frame& frame : frames) {
        EXPECT_NEAR(frame.droplet.total.volume / frames[0].droplet.total.volume, 1.0, 1e-9);
    }
}

TEST(Sequence, FillGivesEveryFrameItsContactAngle)
{
    SequenceOptions options = optionsFor(VolumeMode::Fill);
    options.droplet.solve.fill = {FillBy::ContactAngle, 35 * kDegree, FillSharing::Each};
    std::vector<Outline> outlines = closingHole();
    outlines.push_back(outlineOf(disc({32, 32}, 30), 64, 64));
    outlines.push_back(outlineOf(disc({32, 32}, 15), 64, 64));
    const std::vector<Frame> frames = framesOf(outlines, options);
    expectVolumesAddUp(frames);
    for (const Frame& frame : frames) {
        EXPECT_NEAR(frame.droplet.total.contact_angle.mean, 35 * kDegree, 1e-6);
    }
    // Small droplets of one angle are similar: volumes go as the cubes of their radii, which gravity lessens.
    const auto volume_of = [&](std::size_t back) { return frames[frames.size() - back].droplet.total.volume; };
    const double ratio = volume_of(2) / volume_of(1);
    EXPECT_GT(ratio, 6.0);
    EXPECT_LT(ratio, 8.0);
}

TEST(Sequence, PressureFallsWhileAHoleCloses)
{
    const std::vector<Frame> frames = framesOf(closingHole(), optionsFor(VolumeMode::Total));
    for (std::size_t k = 1; k < frames.size(); ++k) {
        EXPECT_LT(frames[k].droplet.solution.droplets[0].pressure, frames[k - 1].droplet.solution.droplets[0].pressure);
        EXPECT_EQ(frames[k].continues, k + 1 < frames.size()) << k;
    }
    // Even a tiny hole holds the surface down, so the last step is by far the largest.
    const auto pressure = [&](std::size_t k) { return frames[k].droplet.solution.droplets[0].pressure; };
    EXPECT_GT(pressure(4) / pressure(5), 1.5 * pressure(3) / pressure(4));
}

TEST(Sequence, DiscMovedByWholePixelsChangesOnlyItsPlace)
{
    for (const VolumeMode mode : {VolumeMode::Total, VolumeMode::Track}) {
        const std::vector<Frame> frames = framesOf(movingDisc(3.0), optionsFor(mode));
        const Droplet& first = frames[0].droplet;
        for (std::size_t k = 1; k < frames.size(); ++k) {
            const Droplet& droplet = frames[k].droplet;
            EXPECT_TRUE(frames[k].continues);
            EXPECT_EQ(frames[k].droplets[0].id, 0U);
            EXPECT_THAT(frames[k].droplets[0].from, ElementsAre(0U));
            EXPECT_EQ(droplet.surface.triangles, first.surface.triangles);
            EXPECT_NEAR(droplet.total.volume / first.total.volume, 1.0, 1e-9);
            EXPECT_NEAR(droplet.solution.droplets[0].pressure / first.solution.droplets[0].pressure, 1.0, 1e-5);
            const Vec3 by{static_cast<double>(k) * 3.0 * kPixel, 0.0, 0.0};
            for (std::size_t v = 0; v < first.surface.vertices.size(); ++v) {
                EXPECT_LT(length(droplet.surface.vertices[v] - first.surface.vertices[v] - by), 1e-6);
            }
        }
    }
}

TEST(Sequence, DiscMovedByPartsOfAPixelKeepsItsVertices)
{
    const std::vector<Frame> frames = framesOf(movingDisc(1.37), optionsFor(VolumeMode::Total));
    for (std::size_t k = 1; k < frames.size(); ++k) {
        EXPECT_TRUE(frames[k].continues);
        EXPECT_NEAR(frames[k].droplet.solution.droplets[0].pressure / frames[0].droplet.solution.droplets[0].pressure,
                    1.0, 2e-3);
    }
}

TEST(Sequence, EqualOutlinesGiveEqualFrames)
{
    const std::vector<Outline> outlines(
        3, outlineOf([](Vec2 p) {
            return (disc({30, 32}, 20)(p) && !disc({27, 30}, 6)(p)) || testing::rectangle({70, 30}, {15, 9}, 0.3)(p);
        }));
    const std::vector<Frame> frames = framesOf(outlines, optionsFor(VolumeMode::Track));
    for (std::size_t k = 1; k < frames.size(); ++k) {
        ASSERT_TRUE(frames[k].continues);
        for (std::size_t v = 0; v < frames[0].droplet.surface.vertices.size(); ++v) {
            EXPECT_LT(length(frames[k].droplet.surface.vertices[v] - frames[0].droplet.surface.vertices[v]),
                      0.05 * kPixel);
        }
    }
}

TEST(Sequence, TrackAddsVolumesThatMergeAndKeepsTheLargestOnesId)
{
    const auto two = [](double gap) {
        return outlineOf([=](Vec2 p) {
            return disc({30 - gap, 32}, 12)(p) || disc({56 + gap, 32}, 15)(p) ||
                   (gap < 1 && testing::rectangle({42, 32}, {12, 4}, 0.0)(p));
        });
    };
    const std::vector<Frame> frames = framesOf({two(4), two(2), two(0.5)}, optionsFor(VolumeMode::Track));
    expectVolumesAddUp(frames);
    ASSERT_EQ(frames[1].droplets.size(), 2U);
    ASSERT_EQ(frames[2].droplets.size(), 1U);
    EXPECT_TRUE(frames[1].continues);
    EXPECT_FALSE(frames[2].continues);
    EXPECT_NEAR(frames[2].droplets[0].volume / volume(frames[0]), 1.0, 1e-12);
    const std::size_t larger = frames[1].droplets[0].volume > frames[1].droplets[1].volume ? 0 : 1;
    EXPECT_EQ(frames[2].droplets[0].id, frames[1].droplets[larger].id);
    EXPECT_THAT(frames[2].droplets[0].from, UnorderedElementsAre(0U, 1U));
}

TEST(Sequence, PartsOfASplitDropletHaveOnePressure)
{
    const auto dumbbell = [](bool bridge) {
        return outlineOf([=](Vec2 p) {
            return disc({26, 32}, 18)(p) || disc({68, 32}, 10)(p) ||
                   (bridge && testing::rectangle({50, 32}, {14, 2.5}, 0.0)(p));
        });
    };
    const std::vector<Frame> frames =
        framesOf({dumbbell(true), dumbbell(false), dumbbell(false), dumbbell(true)}, optionsFor(VolumeMode::Track));
    expectVolumesAddUp(frames);
    const std::vector<Ancestry>& parts = frames[1].droplets;
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_NEAR((parts[0].volume + parts[1].volume) / frames[0].droplets[0].volume, 1.0, 1e-12);
    EXPECT_NEAR(frames[1].droplet.solution.droplets[0].pressure / frames[1].droplet.solution.droplets[1].pressure, 1.0,
                1e-8);
    // The bridge is small, so the pressure hardly changes.
    EXPECT_NEAR(frames[1].droplet.solution.droplets[0].pressure / frames[0].droplet.solution.droplets[0].pressure, 1.0,
                0.05);
    const std::size_t large = parts[0].volume > parts[1].volume ? 0 : 1;
    EXPECT_EQ(parts[large].id, 0U);
    EXPECT_EQ(parts[1 - large].id, 1U);
    for (const Ancestry& part : parts) {
        EXPECT_THAT(part.from, ElementsAre(0U));
    }
    EXPECT_EQ(frames[2].droplets[large].volume, parts[large].volume);
    EXPECT_EQ(frames[3].droplets[0].volume, parts[0].volume + parts[1].volume);
}

TEST(Sequence, ManyToManyConservesTheVolumeOfTheGroup)
{
    const auto blobs = [](const std::vector<Vec2>& centres, double radius) {
        return outlineOf([=](Vec2 p) {
            for (const Vec2 c : centres) {
                if (disc(c, radius)(p)) {
                    return true;
                }
            }
            return false;
        });
    };
    // Two stripes become two that cross them, so all belong to one group.
    const auto stripes = [](bool upright) {
        return outlineOf([=](Vec2 p) {
            const double a = upright ? p.x - 48 : p.y - 32;
            const double b = upright ? p.y - 32 : p.x - 48;
            return std::abs(b) < 26 && (std::abs(a - 12) < 7 || std::abs(a + 14) < 9);
        });
    };
    std::vector<Frame> frames = framesOf({stripes(true), stripes(false)}, optionsFor(VolumeMode::Track));
    expectVolumesAddUp(frames);
    ASSERT_EQ(frames[1].droplets.size(), 2U);
    EXPECT_EQ(frames[1].volume_gained, 0.0);
    EXPECT_EQ(frames[1].volume_lost, 0.0);
    for (const Ancestry& droplet : frames[1].droplets) {
        EXPECT_THAT(droplet.from, UnorderedElementsAre(0U, 1U));
    }
    // Beads that move into one another's places do not mix.
    frames =
        framesOf({blobs({{16, 30}, {44, 30}}, 11), blobs({{26, 30}, {54, 30}}, 11), blobs({{36, 30}, {64, 30}}, 11)},
                 optionsFor(VolumeMode::Track));
    for (const Frame& frame : frames) {
        EXPECT_EQ(frame.droplets[0].volume, frames[0].droplets[0].volume);
        EXPECT_EQ(frame.droplets[0].id, 0U);
    }
}

TEST(Sequence, NewDropletsAreFilledAndLostVolumeIsCounted)
{
    const Outline one = outlineOf(disc({25, 32}, 15));
    const Outline both = outlineOf([](Vec2 p) { return disc({25, 32}, 15)(p) || disc({70, 20}, 10)(p); });
    const Outline other = outlineOf(disc({70, 20}, 10));
    const std::vector<Frame> frames = framesOf({one, both, other}, optionsFor(VolumeMode::Track));
    expectVolumesAddUp(frames);
    EXPECT_GT(frames[1].volume_gained, 0.0);
    std::size_t fresh = frames[1].droplets[0].from.empty() ? 0 : 1;
    EXPECT_THAT(frames[1].droplets[fresh].from, IsEmpty());
    EXPECT_EQ(frames[1].droplets[fresh].volume, frames[1].volume_gained);
    EXPECT_NEAR(frames[1].droplet.figures[fresh].contact_angle.mean, 40 * kDegree, 1e-6);
    EXPECT_EQ(frames[2].volume_lost, frames[0].droplets[0].volume);
    EXPECT_EQ(frames[2].droplets[0].id, frames[1].droplets[fresh].id);
}

Outline dryOutline()
{
    Outline outline = outlineOf(disc({25, 32}, 15));
    outline.loops.clear();
    return outline;
}

TEST(Sequence, FramesWithoutLiquidAreValid)
{
    const Outline dry = dryOutline();
    const Outline wide = outlineOf(disc({25, 32}, 15));
    const Outline narrow = outlineOf(disc({25, 32}, 12));
    for (const VolumeMode mode : {VolumeMode::Total, VolumeMode::Track}) {
        SequenceOptions options = optionsFor(mode);
        options.droplet.solve.fill.by = FillBy::ContactAngle;
        options.droplet.solve.fill.amount = 40 * kDegree;
        const std::vector<Frame> frames = framesOf({dry, wide, narrow, dry, dry, narrow, dry}, options);
        expectVolumesAddUp(frames);
        for (const std::size_t k : {0U, 3U, 4U, 6U}) {
            EXPECT_TRUE(frames[k].droplets.empty());
            EXPECT_TRUE(frames[k].droplet.surface.triangles.empty());
            EXPECT_EQ(frames[k].droplet.domain.extent, dry.extent);
            EXPECT_FALSE(frames[k].continues);
        }
        EXPECT_NEAR(frames[1].droplet.total.contact_angle.mean, 40 * kDegree, 1e-6);
        EXPECT_EQ(frames[1].volume_gained, volume(frames[1]));
        EXPECT_EQ(frames[3].volume_lost, volume(frames[2]));
        EXPECT_EQ(frames[1].droplets[0].id, 0U);
        EXPECT_EQ(frames[5].droplets[0].id, 1U) << "ids are never reused";
        EXPECT_THAT(frames[5].droplets[0].from, IsEmpty());
        if (mode == VolumeMode::Total) {
            EXPECT_NEAR(volume(frames[5]) / volume(frames[1]), 1.0, 1e-12) << "the reservoir is unchanged";
        } else {
            EXPECT_NEAR(frames[5].droplet.total.contact_angle.mean, 40 * kDegree, 1e-6)
                << "new droplet, filled as requested";
        }
    }
}

TEST(Sequence, DropletsKeepTheirOrderWhenOutlinesFindThemInAnother)
{
    // The lower disc rises past the upper one, beside it, so that outlines find it first.
    std::vector<Outline> outlines;
    for (const double y : {40.0, 34.0, 28.0, 22.0, 16.0}) {
        outlines.push_back(outlineOf([=](Vec2 p) { return disc({24, 28}, 14)(p) || disc({68, y}, 12)(p); }));
    }
    const std::vector<Frame> frames = framesOf(outlines, optionsFor(VolumeMode::Track));
    for (std::size_t k = 1; k < frames.size(); ++k) {
        EXPECT_TRUE(frames[k].continues) << k;
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_EQ(frames[k].droplets[i].id, frames[0].droplets[i].id);
            EXPECT_EQ(frames[k].droplets[i].volume, frames[0].droplets[i].volume);
        }
    }
}

TEST(Sequence, FollowedSurfacesMatchNewOnes)
{
    SequenceOptions fresh = optionsFor(VolumeMode::Total);
    fresh.keep_vertices = false;
    const std::vector<Frame> moved = framesOf(closingHole(), optionsFor(VolumeMode::Total));
    const std::vector<Frame> anew = framesOf(closingHole(), fresh);
    for (std::size_t k = 0; k < moved.size(); ++k) {
        EXPECT_FALSE(anew[k].continues);
        const ShapeFigures& a = moved[k].droplet.total;
        const ShapeFigures& b = anew[k].droplet.total;
        EXPECT_NEAR(a.footprint_area / b.footprint_area, 1.0, 1e-4);
        EXPECT_NEAR(a.height_max / b.height_max, 1.0, 0.01);
        EXPECT_NEAR(a.contact_angle.mean / b.contact_angle.mean, 1.0, 0.01);
        EXPECT_NEAR(moved[k].droplet.solution.droplets[0].pressure / anew[k].droplet.solution.droplets[0].pressure, 1.0,
                    0.01);
    }
}

TEST(Sequence, RunsOnAnyGroundWithAnyModel)
{
    SequenceOptions options = optionsFor(VolumeMode::Track);
    options.droplet.solve.ground = BaseSurface::sphere(15e-3);
    options.droplet.solve.tilt = 10 * kDegree;
    const auto discs = [](double x) {
        return outlineOf([=](Vec2 p) { return disc({x, 32}, 18)(p) && !disc({x, 30}, 5)(p); });
    };
    std::vector<Frame> frames;
    for (const double x : {40.0, 42.0, 44.0}) {
        frames.push_back(frames.empty() ? firstFrame(discs(x), options) : nextFrame(frames.back(), discs(x), options));
        EXPECT_TRUE(isClosed(frames.back().droplet.surface));
    }
    EXPECT_TRUE(frames[2].continues);
    options = optionsFor(VolumeMode::Total);
    options.droplet.solve.model = Model::Exact;
    options.droplet.open = true;
    const Frame first = firstFrame(discs(40), options);
    const Frame second = nextFrame(first, discs(42), options);
    EXPECT_TRUE(second.continues);
    EXPECT_NEAR(second.droplet.total.volume / first.droplet.total.volume, 1.0, 1e-9);
}

TEST(Sequence, IsTheSameAtAnyNumberOfThreads)
{
    const auto vertices = [](int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
        std::vector<Vec3> all;
        for (const Frame& frame : framesOf(closingHole(), optionsFor(VolumeMode::Track))) {
            all.insert(all.end(), frame.droplet.surface.vertices.begin(), frame.droplet.surface.vertices.end());
        }
        return all;
    };
    EXPECT_TRUE(vertices(1) == vertices(2));
}

TEST(Sequence, RejectsOptionsThatDoNotApply)
{
    const auto refusal = [](SequenceOptions options) -> std::string {
        try {
            firstFrame(outlineOf(disc({30, 30}, 20)), options);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    };
    SequenceOptions options = optionsFor(VolumeMode::Total);
    EXPECT_EQ(refusal(options), "");
    options.droplet.fill_range = FillRange{};
    EXPECT_THAT(refusal(options), HasSubstr("fill_range"));
    options.droplet.fill_range.reset();
    options.droplet.mesh.quads = true;
    EXPECT_THAT(refusal(options), HasSubstr("mesh.quads"));
    options = optionsFor(VolumeMode::Total);
    options.droplet.solve.fill.sharing = FillSharing::Each;
    EXPECT_THAT(refusal(options), HasSubstr("fill.sharing"));
    options = optionsFor(VolumeMode::Track);
    options.droplet.solve.volumes = {1e-9};
    EXPECT_THAT(refusal(options), HasSubstr("volumes"));
    options.droplet.solve.volumes.clear();
    const Frame first = firstFrame(outlineOf(disc({30, 30}, 20)), options);
    EXPECT_THROW(nextFrame(first, outlineOf(disc({30, 30}, 20), 80, 64), options), Error);
    EXPECT_THROW(nextFrame(Frame(), outlineOf(disc({30, 30}, 20)), options), Error);
}

}  // namespace
}  // namespace droplet
