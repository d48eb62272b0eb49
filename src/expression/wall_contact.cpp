// SPDX-License-Identifier: GPL-3.0-or-later
#include "wall_contact.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "droplet/liquid2d/fluid_scene.h"
#include "liquid2d/bounds.h"
#include "liquid2d/wall_distance.h"
#include "plain_length.h"
#include "surface_kernel.h"

namespace droplet {
namespace {

/// Distance from a wall up to which an outline goes to the wall, and from which on it stays where it is, in spacings.
constexpr double kNear = 0.7;
constexpr double kFar = 1.3;

/// Cosine between the directions to the wall and out of the liquid, likewise: a surface that ends at the wall stays.
constexpr double kAside = 0.1;
constexpr double kFacing = 0.5;

/// Depth below the wall's side, in spacings: drawn edges that only touch show a hairline.
constexpr double kDepth = 0.1;

/// Passes; a point in a corner meets one wall after the other.
constexpr int kPasses = 2;

GridShape gridAround(const std::vector<Loop>& loops, double cell)
{
    Bounds box;
    for (const Loop& loop : loops) {
        box.include(loop.points);
    }
    GridShape grid;
    grid.cell = cell;
    grid.left = static_cast<std::int64_t>(std::floor(box.lower.x / cell)) - 2;
    grid.bottom = static_cast<std::int64_t>(std::floor(box.lower.y / cell)) - 2;
    grid.columns = static_cast<std::size_t>(static_cast<std::int64_t>(std::ceil(box.upper.x / cell)) + 2 - grid.left);
    grid.rows = static_cast<std::size_t>(static_cast<std::int64_t>(std::ceil(box.upper.y / cell)) + 2 - grid.bottom);
    return grid;
}

}  // namespace

void meetWalls(std::vector<Loop>& loops, const ParticleFrame& frame)
{
    if (loops.empty() || frame.walls.empty()) {
        return;
    }
    FluidScene scene;
    for (const Region& wall : frame.walls) {
        scene.walls.push_back({.region = wall, .motion = {}});
    }
    const GridShape grid = gridAround(loops, frame.spacing);
    const GridPlaces places(grid);
    const WallField field = WallDistance(scene, frame.spacing).at(0.0, grid);
    std::vector<Vec2> next;
    for (Loop& loop : loops) {
        for (int pass = 0; pass < kPasses; ++pass) {
            next = loop.points;
            const std::size_t count = next.size();
            for (std::size_t i = 0; i < count; ++i) {
                const Bilinear place = places.at(loop.points[i]).amongCorners();
                const double distance = place.in(field.distance) / frame.spacing;
                if (!(distance < kFar)) {
                    continue;
                }
                const Vec2 along = loop.points[i + 1 == count ? 0 : i + 1] - loop.points[i == 0 ? count - 1 : i - 1];
                const Vec2 slope = place.slopeIn(field.distance);
                const double steepness = plainLength(slope);
                const double size = plainLength(along) * steepness;
                // The outward normal is the tangent, turned to the right.
                const double facing = size > 0.0 ? -cross(slope, along) / size : 0.0;
                const double share = smoothRamp(distance, kFar, kNear) * smoothRamp(facing, kAside, kFacing);
                if (share > 0.0) {
                    next[i] = loop.points[i] - ((share * (distance + kDepth) * frame.spacing) / steepness) * slope;
                }
            }
            loop.points.swap(next);
        }
    }
}

}  // namespace droplet
