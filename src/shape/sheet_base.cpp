// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/sheet_base.h"

#include <algorithm>
#include <limits>

namespace droplet {

GroundPoint SheetBase::under(Vec3 place) const
{
    constexpr GroundPoint kBottomless{-std::numeric_limits<double>::infinity(), {}};
    return ground.find({place.x, place.y}).value_or(kBottomless);
}

void SheetBase::lift(std::vector<Vec3>& vertices, std::size_t first) const
{
    for (std::size_t v = first; v < vertices.size(); ++v) {
        vertices[v].z = std::max(vertices[v].z, under(vertices[v]).height);
    }
}

Vec3 weightOf(const SolveOptions& options)
{
    const double scale = options.liquid.density / options.liquid.surface_tension;
    const PlaneGravity gravity = planeGravity(options);
    return scale * Vec3{-gravity.along.x, -gravity.along.y, gravity.normal};
}

Vec3 normalOf(const GroundPoint& ground)
{
    const Vec3 up{-ground.gradient.x, -ground.gradient.y, 1.0};
    return (1.0 / length(up)) * up;
}

std::vector<double> heightsUnder(const PlanarMesh& footprint, const BaseSurface& ground)
{
    std::vector<double> heights;
    heights.reserve(footprint.vertices.size());
    for (const Vec2 p : footprint.vertices) {
        heights.push_back(ground.at(p).height);
    }
    return heights;
}

CapillarySurface drySheet(const PlanarMesh& footprint, const BaseSurface& ground)
{
    CapillarySurface sheet{.triangles = footprint.triangles, .loop_starts = footprint.loop_starts};
    const std::vector<double> heights = heightsUnder(footprint, ground);
    sheet.vertices.reserve(heights.size());
    for (std::size_t v = 0; v < heights.size(); ++v) {
        sheet.vertices.push_back({footprint.vertices[v].x, footprint.vertices[v].y, heights[v]});
    }
    return sheet;
}

SheetBase baseOf(const PlanarMesh& footprint, const BaseSurface& ground, Vec3 weight)
{
    return {ground, ground.flat() ? SheetIntegrals{} : integrate(drySheet(footprint, ground), weight)};
}

SheetBase baseOf(const CapillarySurface& surface, const BaseSurface& ground, Vec3 weight)
{
    return ground.flat() ? SheetBase{} : baseOf(footprintOf(surface), ground, weight);
}

double liquidVolume(const CapillarySurface& surface, const BaseSurface& ground)
{
    return integrate(surface, {}).volume - baseOf(surface, ground, {}).integrals.volume;
}

}  // namespace droplet
