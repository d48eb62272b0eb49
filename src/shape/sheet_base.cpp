// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/sheet_base.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace droplet {
namespace {

/// Clearance over the extent of the rim that is rounding.
constexpr double kTouching = 1e-12;

/// Quadrature over a triangle with six points: D. A. Dunavant, Int. J. Numer. Meth. Eng. 21 (1985), degree 4. They are
/// at no places that triangles of another mesh have in common with this one, such as the middles of edges.
struct QuadraturePoint {
    double weight;
    double near;  ///< share of one corner; the others have half of the rest each
};
constexpr std::array<QuadraturePoint, 2> kQuadrature{
    {{0.223381589678011, 1.0 - 2.0 * 0.445948490915965}, {0.109951743655322, 1.0 - 2.0 * 0.091576213509771}}};

/// Integrals between triangles of a sheet and the base below them.
/// @param dry  marks of vertices; triangles of these and of the rim's count
SheetIntegrals filmOver(const FacetedGround& facets, const CapillarySurface& sheet,
                        const std::vector<std::uint8_t>& dry, Vec3 weight)
{
    SheetIntegrals sum;
    for (const Triangle& t : sheet.triangles) {
        if (std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return !sheet.onRim(v) && dry[v] == 0; })) {
            continue;
        }
        const double size = areaVector(sheet.vertices, t).z;
        const Vec3 whole = sheet.vertices[t[0]] + sheet.vertices[t[1]] + sheet.vertices[t[2]];
        for (const QuadraturePoint& point : kQuadrature) {
            for (const std::uint32_t v : t) {
                const double rest = 0.5 * (1.0 - point.near);
                const Vec3 place = rest * whole + (point.near - rest) * sheet.vertices[v];
                // Liquid that lies on the ground beside its base has no other one.
                const double height = facets.heightAt({place.x, place.y}).value_or(place.z);
                const double part = point.weight * size * (place.z - height);
                sum.volume += part;
                sum.gravity += part * dot(weight, {place.x, place.y, 0.5 * (place.z + height)});
            }
        }
    }
    return sum;
}

}  // namespace

SheetIntegrals SheetBase::baseOf(const CapillarySurface& sheet, Vec3 weight) const
{
    if (!facets) {
        return integrals;
    }
    const std::vector<std::uint8_t> dry = dryOf(sheet);
    return dry.empty() ? integrals : integrals + filmOver(*facets, sheet, dry, weight);
}

std::vector<std::uint8_t> SheetBase::dryOf(const CapillarySurface& sheet) const
{
    std::vector<std::uint8_t> dry(sheet.vertices.size(), 0);
    for (std::uint32_t v = sheet.rimVertexCount(); v < dry.size(); ++v) {
        dry[v] = clearance(sheet.vertices[v]) <= 0.0 ? 1 : 0;
    }
    return std::find(dry.begin(), dry.end(), 1) == dry.end() ? std::vector<std::uint8_t>{} : dry;
}

GroundPoint SheetBase::under(Vec3 place) const
{
    constexpr GroundPoint kBottomless{-std::numeric_limits<double>::infinity(), {}};
    return ground.find({place.x, place.y}).value_or(kBottomless);
}

void SheetBase::lift(std::vector<Vec3>& vertices, std::size_t first) const
{
    double extent = 0.0;
    for (std::size_t v = 0; v < first; ++v) {
        extent = std::max(extent, length(vertices[v] - vertices.front()));
    }
    const double rounding = kTouching * extent;
    for (std::size_t v = first; v < vertices.size(); ++v) {
        const double height = under(vertices[v]).height;
        if (vertices[v].z <= height + rounding) {
            vertices[v].z = height;
        }
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
    if (ground.flat()) {
        return {};
    }
    const CapillarySurface dry = drySheet(footprint, ground);
    return {ground, integrate(dry, weight), std::make_shared<FacetedGround>(dry)};
}

SheetBase baseOf(const CapillarySurface& surface, const BaseSurface& ground, Vec3 weight)
{
    if (ground.flat()) {
        return {};
    }
    if (surface.isHeightField()) {
        return {ground, integrate(drySheet(footprintOf(surface), ground), weight), {}};
    }
    return baseOf(footprintOf(surface), ground, weight);
}

double liquidVolume(const CapillarySurface& surface, const BaseSurface& ground)
{
    return baseOf(surface, ground, {}).liquidUnder(surface, {}).volume;
}

}  // namespace droplet
