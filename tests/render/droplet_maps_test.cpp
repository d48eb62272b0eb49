// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/droplet_maps.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "support/domains.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::kExtent;
using testing::RoundDroplet;
using testing::roundDroplet;

std::size_t at(const FloatPicture& map, int column, int row)
{
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(column);
}

double integral(const FloatPicture& map, Vec2 extent)
{
    double sum = 0.0;
    for (const float value : map.values) {
        sum += value;
    }
    return sum * extent.x * extent.y / (static_cast<double>(map.width) * map.height);
}

/// A paraboloid and no longer than needed to see its triangles.
RoundDroplet fine(Vec2 centre = {})
{
    return {.rings = 40, .segments = 180, .centre = centre};
}

TEST(DropletMaps, ShowAParaboloid)
{
    const Surface surface = roundDroplet(fine());
    const DropletMaps maps = dropletMaps(surface, {.extent = {kExtent, kExtent}, .width = 200});
    for (const FloatPicture* map :
         {&maps.height, &maps.normal, &maps.thickness, &maps.coverage, &maps.wetness, &maps.occlusion}) {
        map->validate();
        ASSERT_EQ(map->width, 200);
        ASSERT_EQ(map->height, 200);
    }
    const RoundDroplet shape = fine();
    for (int row = 0; row < 200; ++row) {
        for (int column = 0; column < 200; ++column) {
            const Vec2 p{(column + 0.5) / 200.0 * kExtent - 0.5 * kExtent,
                         0.5 * kExtent - (row + 0.5) / 200.0 * kExtent};
            const double r = length(p);
            const std::size_t pixel = at(maps.height, column, row);
            if (std::abs(r - shape.outer) < 0.2e-3) {
                continue;  // a pixel of both
            }
            const bool is_liquid = r < shape.outer;
            const double height = is_liquid ? shape.height * (1.0 - r * r / (shape.outer * shape.outer)) : 0.0;
            // The mean over a pixel of 0.1 mm, and chords of 0.1 mm.
            ASSERT_NEAR(maps.height.values[pixel], height, 2e-6) << p.x << " " << p.y;
            ASSERT_FLOAT_EQ(maps.thickness.values[pixel], maps.height.values[pixel]);
            ASSERT_EQ(maps.coverage.values[pixel], is_liquid ? 1.0F : 0.0F);
            ASSERT_EQ(maps.wetness.values[pixel], maps.coverage.values[pixel]);
            const double slope = is_liquid ? 2.0 * shape.height * r / (shape.outer * shape.outer) : 0.0;
            const double z = 1.0 / std::hypot(1.0, slope);
            ASSERT_NEAR(maps.normal.values[3 * pixel + 2], z, 2e-3);
            if (r > 0.0) {
                ASSERT_NEAR(maps.normal.values[3 * pixel], slope * z * p.x / r, 6e-3);
                ASSERT_NEAR(maps.normal.values[3 * pixel + 1], slope * z * p.y / r, 6e-3);
            }
        }
    }
}

// A sheet of 120 degrees covers more ground than it wets, and its thickness adds up to its volume.
TEST(DropletMaps, IntegralsAreVolumeAndAreas)
{
    DropletOptions options;
    options.mesh.triangles = 8000;
    options.solve.fill = {FillBy::ContactAngle, 120.0 * kDegree, FillSharing::Each};
    const Droplet droplet = makeDroplet(domainOf(ellipseLoop(1.5e-3, 1e-3)), options);
    ASSERT_FALSE(droplet.solution.droplets.front().isHeightField());
    const Vec2 extent{5e-3, 4e-3};
    for (const int width : {100, 400}) {
        const DropletMaps maps = dropletMaps(droplet.surface, {.extent = extent, .width = width});
        EXPECT_EQ(maps.height.height, width * 4 / 5);
        const double volume = enclosedVolume(droplet.surface);
        EXPECT_NEAR(integral(maps.thickness, extent) / volume, 1.0, 0.1 / width);
        const double wet = std::numbers::pi * 1.5e-6;
        EXPECT_NEAR(integral(maps.wetness, extent) / wet, 1.0, 2e-3);
        double up = 0.0;
        for (const Vec3& p : droplet.surface.vertices) {
            up = std::max(up, p.y);
        }
        ASSERT_GT(up, 1.1e-3);
        EXPECT_GT(integral(maps.coverage, extent), 1.05 * wet);
        // Below what leans out is air: thickness is less than height.
        const std::size_t rim =
            at(maps.height, width / 2, static_cast<int>((0.5 - (0.15e-3 + 0.85 * up) / extent.y) * maps.height.height));
        EXPECT_GT(maps.height.values[rim], 1.2F * maps.thickness.values[rim]);
        EXPECT_GT(maps.thickness.values[rim], 0.0F);
    }
}

// Seen from a level place at a distance d from the middle of half a ball of radius R, the ball hides the directions
// within asin(R/d) of the way to its middle: by Nusselt's analogue a segment of a circle.
TEST(DropletMaps, OcclusionBesideHalfABall)
{
    DropletOptions options;
    options.mesh.triangles = 8000;
    options.solve.liquid.density = 1.0;  // as good as without weight
    options.solve.fill = {FillBy::ContactAngle, 90.0 * kDegree, FillSharing::Each};
    const double radius = 1e-3;
    const Droplet droplet = makeDroplet(domainOf(ellipseLoop(radius, radius)), options);
    const Vec2 extent{8e-3, 8e-3};
    const DropletMaps maps = dropletMaps(droplet.surface, {.extent = extent, .width = 400});
    for (const double distance : {1.2, 1.5, 2.0, 3.0}) {
        for (const double turn : {0.0, 0.3, 0.8}) {
            const int column = static_cast<int>((distance * radius * std::cos(turn) / extent.x + 0.5) * 400);
            const int row = static_cast<int>((0.5 - distance * radius * std::sin(turn) / extent.y) * 400);
            const double x = ((column + 0.5) / 400.0 - 0.5) * extent.x;
            const double y = (0.5 - (row + 0.5) / 400.0) * extent.y;
            const double angle = std::asin(radius / std::hypot(x, y));
            const double hidden = (angle - std::sin(angle) * std::cos(angle)) / std::numbers::pi;
            EXPECT_NEAR(maps.occlusion.values[at(maps.height, column, row)], 1.0 - hidden, 0.02)
                << distance << " " << turn;
        }
    }
    // Its top sees everything.
    EXPECT_GT(maps.occlusion.values[at(maps.height, 200, 200)], 0.99F);
}

// A droplet over the corner of a tile is the droplet in its middle, moved around.
TEST(DropletMaps, TilesGoAround)
{
    constexpr int kWidth = 80;
    const Vec2 extent{kExtent, kExtent};
    const auto maps = [&](Vec2 centre) {
        return dropletMaps(roundDroplet(fine(centre)), {.extent = extent, .width = kWidth, .is_tile = true});
    };
    const DropletMaps middle = maps({});
    const DropletMaps corner = maps({0.5 * kExtent, -0.5 * kExtent});
    for (const auto& [a, b] : {std::pair{&middle.height, &corner.height},
                               {&middle.thickness, &corner.thickness},
                               {&middle.coverage, &corner.coverage},
                               {&middle.wetness, &corner.wetness},
                               {&middle.occlusion, &corner.occlusion}}) {
        const float most = *std::max_element(a->values.begin(), a->values.end());
        ASSERT_GT(most, 0.0F);
        for (int row = 0; row < kWidth; ++row) {
            for (int column = 0; column < kWidth; ++column) {
                ASSERT_NEAR(a->values[at(*a, column, row)],
                            b->values[at(*a, (column + kWidth / 2) % kWidth, (row + kWidth / 2) % kWidth)], 0.07 * most)
                    << column << " " << row;  // one place of 16 at the rim
            }
        }
    }
    // Without tiles three quarters of it are beyond the window.
    const DropletMaps cut =
        dropletMaps(roundDroplet(fine({0.5 * kExtent, -0.5 * kExtent})), {.extent = extent, .width = kWidth});
    EXPECT_NEAR(integral(cut.thickness, extent) / integral(corner.thickness, extent), 0.25, 1e-3);
}

TEST(DropletMaps, ShowCurvedGround)
{
    const double radius = 30e-3;
    const DropletMaps maps = dropletMaps(
        roundDroplet(fine()), {.extent = {kExtent, kExtent}, .width = 100, .ground = BaseSurface::sphere(radius)});
    const double x = (95.5 / 100.0 - 0.5) * kExtent;
    const double y = 0.5 / 100.0 * kExtent;
    const std::size_t pixel = at(maps.height, 95, 49);
    EXPECT_NEAR(maps.height.values[pixel], std::sqrt(radius * radius - x * x - y * y) - radius, 1e-6);
    EXPECT_NEAR(maps.normal.values[3 * pixel], x / radius, 1e-3);
    EXPECT_EQ(maps.thickness.values[pixel], 0.0F);
}

TEST(DropletMaps, AreTheSameWithOneThread)
{
    const Surface surface = roundDroplet();
    const DropletMapOptions options{.extent = {kExtent, 0.7 * kExtent}, .width = 150};
    const DropletMaps many = dropletMaps(surface, options);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const DropletMaps alone = dropletMaps(surface, options);
    EXPECT_EQ(many.height, alone.height);
    EXPECT_EQ(many.normal, alone.normal);
    EXPECT_EQ(many.thickness, alone.thickness);
    EXPECT_EQ(many.occlusion, alone.occlusion);
}

TEST(DropletMaps, RefuseWindowsWithoutArea)
{
    const Surface surface = roundDroplet();
    EXPECT_THROW(dropletMaps(surface, {.extent = {0.0, 1.0}}), Error);
    EXPECT_THROW(dropletMaps(surface, {.extent = {1.0, std::nan("")}}), Error);
    EXPECT_THROW(dropletMaps(surface, {.extent = {1.0, 1.0}, .width = 15}), Error);
    EXPECT_THROW(dropletMaps(surface, {.extent = {1.0, 100.0}}), Error);
}

}  // namespace
}  // namespace droplet
