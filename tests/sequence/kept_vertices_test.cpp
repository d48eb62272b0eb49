// SPDX-License-Identifier: GPL-3.0-or-later
// Tests how many vertices of a mesh are kept if only a part of the rim changes: a drip that grows from a letter,
// droplets that merge, a ring that closes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "droplet/sequence/sequence.h"
#include "droplet/units.h"
#include "support/masks.h"
#include "support/sound.h"

namespace droplet {
namespace {

using testing::disc;
using testing::Inside;

constexpr int kSide = 160;

SequenceOptions options(std::size_t triangles = 3000)
{
    SequenceOptions options;
    options.droplet.mesh.triangles = triangles;
    options.droplet.solve.fill = {FillBy::Volume, 20 * kMicrolitre, FillSharing::Total};
    options.droplet.solve.model = Model::Linear;  // sheets have triangles of their own
    return options;
}

std::vector<Frame> framesOf(const std::vector<Inside>& masks, const SequenceOptions& options)
{
    std::vector<Frame> frames;
    for (const Inside& inside : masks) {
        Outline outline = trace(testing::hardMask(kSide, kSide, inside));
        frames.push_back(frames.empty() ? firstFrame(std::move(outline), options)
                                        : nextFrame(frames.back(), std::move(outline), options));
    }
    return frames;
}

/// The letter E with a drip below its foot.
Inside letterWithDrip(double drip)
{
    return [=](Vec2 p) {
        const auto box = [&](double x0, double y0, double x1, double y1) {
            return p.x > x0 && p.x < x1 && p.y > y0 && p.y < y1;
        };
        const Vec2 bead{60.0, 118.0 + drip};
        return box(30, 20, 52, 120) || box(30, 20, 120, 40) || box(30, 60, 105, 80) || box(30, 100, 120, 120) ||
               (drip > 0.0 && (box(54, 110, 66, bead.y) || length(p - bead) < 7.0));
    };
}

std::vector<Inside> drip()
{
    std::vector<Inside> masks;
    for (int k = 0; k < 24; ++k) {
        masks.push_back(letterWithDrip(1.3 * k));
    }
    return masks;
}

/// Two discs at rest, and one between them that grows until it meets both.
std::vector<Inside> merge()
{
    std::vector<Inside> masks;
    for (int k = 0; k < 16; ++k) {
        masks.push_back([=](Vec2 p) {
            return disc({40, 60}, 32)(p) || disc({122, 100}, 30)(p) || disc({84, 80}, 6.0 + 0.7 * k)(p);
        });
    }
    return masks;
}

std::vector<Inside> closingRing()
{
    std::vector<Inside> masks;
    for (int k = 0; k < 12; ++k) {
        masks.push_back([=](Vec2 p) { return disc({80, 80}, 65)(p) && !disc({84, 76}, 24.0 - 2.4 * k)(p); });
    }
    return masks;
}

std::pair<std::size_t, std::size_t> topologyOf(const Frame& frame)
{
    std::size_t loops = 0;
    for (const PlanarMesh& mesh : frame.droplet.meshes) {
        loops += mesh.loopCount();
    }
    return {frame.droplet.meshes.size(), loops};
}

/// Share of vertices at places where the frame before had one.
double sharedPlaces(const Frame& before, const Frame& frame)
{
    std::set<std::pair<double, double>> places;
    for (const PlanarMesh& mesh : before.droplet.meshes) {
        for (const Vec2 p : mesh.vertices) {
            places.emplace(p.x, p.y);
        }
    }
    std::size_t shared = 0;
    std::size_t all = 0;
    for (const PlanarMesh& mesh : frame.droplet.meshes) {
        all += mesh.vertices.size();
        for (const Vec2 p : mesh.vertices) {
            shared += places.contains({p.x, p.y}) ? 1 : 0;
        }
    }
    return static_cast<double>(shared) / static_cast<double>(all);
}

void expectFrameSound(const Frame& frame)
{
    for (std::size_t k = 0; k < frame.droplet.meshes.size(); ++k) {
        const PlanarMesh& mesh = frame.droplet.meshes[k];
        EXPECT_GE(minAngle(mesh) / kDegree, 15.0);
        EXPECT_NEAR(area(mesh) / area(frame.droplet.domain.droplets[k]), 1.0, 4e-3);
    }
    testing::expectSound(frame.droplet);
}

struct Film {
    const char* name;
    std::vector<Inside> masks;
};

TEST(KeptVertices, AreMostOfThoseFarFromTheChange)
{
    for (const Film& film : {Film{"drip", drip()}, Film{"merge", merge()}, Film{"ring", closingRing()}}) {
        SCOPED_TRACE(film.name);
        const std::vector<Frame> frames = framesOf(film.masks, options());
        double sum = 0.0;
        std::size_t continued = 0;
        std::size_t changes = 0;
        for (std::size_t k = 0; k < frames.size(); ++k) {
            SCOPED_TRACE(k + 1);
            expectFrameSound(frames[k]);
            if (k == 0) {
                EXPECT_FALSE(frames[k].vertices_kept);
                continue;
            }
            ASSERT_TRUE(frames[k].vertices_kept);
            const double kept = *frames[k].vertices_kept;
            const bool same = topologyOf(frames[k]) == topologyOf(frames[k - 1]);
            EXPECT_GE(kept, same ? 0.8 : 0.5);
            sum += kept;
            continued += frames[k].continues ? 1 : 0;
            changes += same ? 0 : 1;
        }
        EXPECT_EQ(changes > 0, std::string(film.name) != "drip");
        EXPECT_GT(sum, 0.95 * static_cast<double>(frames.size() - 1)) << "mean share of kept vertices";
        EXPECT_LT(continued, frames.size() - 1) << "some frame must not only be moved";
    }
}

TEST(KeptVertices, StayInPlaceIfTheLetterRests)
{
    const std::vector<Frame> frames = framesOf({letterWithDrip(0.0), letterWithDrip(17.0)}, options());
    ASSERT_FALSE(frames[1].continues);
    EXPECT_NEAR(sharedPlaces(frames[0], frames[1]), *frames[1].vertices_kept, 0.02);
}

TEST(KeptVertices, SurfacesMatchNewOnes)
{
    SequenceOptions fresh = options();
    fresh.keep_vertices = false;
    const std::vector<Inside> masks{letterWithDrip(4.0), letterWithDrip(9.0), letterWithDrip(14.0)};
    const std::vector<Frame> kept = framesOf(masks, options());
    const std::vector<Frame> anew = framesOf(masks, fresh);
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const ShapeFigures& a = kept[k].droplet.total;
        const ShapeFigures& b = anew[k].droplet.total;
        EXPECT_NEAR(a.footprint_area / b.footprint_area, 1.0, 4e-3);
        EXPECT_NEAR(a.height_max / b.height_max, 1.0, 0.01);
        EXPECT_NEAR(a.contact_angle.mean / b.contact_angle.mean, 1.0, 0.02);
    }
    EXPECT_EQ(*anew[1].vertices_kept, 0.0);
}

}  // namespace
}  // namespace droplet
