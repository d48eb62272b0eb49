// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/shape/figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "blocks.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "number_text.h"
#include "shape/area_vector.h"
#include "shape/overhang.h"
#include "shape/sheet_base.h"
#include "shape/sheet_energy.h"

namespace droplet {
namespace {

/// Square of the slope up to which the linear model's area is within 10 % (thesis, section 4.1.2): tan² 50°.
constexpr double kSteep = 1.4202766254612063;

/// @param figures  with the depth: liquid that is nowhere below the ground has no negative contact angle, which only
///                 recovery makes
void measureRim(const CapillarySurface& surface, Vec2 downhill, ShapeFigures& figures)
{
    const double least = figures.depth_max > 0.0 ? -std::numbers::pi : 0.0;
    const PlanarMesh mesh = rimOf(surface);
    ContactAngle& angle = figures.contact_angle;
    angle.min = std::numeric_limits<double>::infinity();
    angle.max = -angle.min;
    double sum = 0.0;
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            const std::uint32_t next = nextOnRim(mesh, loop, v);
            const Vec2 along = mesh.vertices[next] - mesh.vertices[v];
            const double edge = length(along);
            const double here = std::max(surface.contact_angle[v], least);
            sum += 0.5 * edge * (here + std::max(surface.contact_angle[next], least));
            figures.rim_length += edge;
            figures.projected_width += 0.5 * std::abs(cross(along, downhill));
            if (here < angle.min) {
                angle.min = here;
                angle.min_at = mesh.vertices[v];
            }
            if (here > angle.max) {
                angle.max = here;
                angle.max_at = mesh.vertices[v];
            }
        }
    }
    angle.mean = sum / figures.rim_length;
}

/// Sums over triangles.
struct Sums {
    double footprint = 0.0;
    double dry = 0.0;
    double area = 0.0;    ///< without dry ground
    double linear = 0.0;  ///< the same in the linear model
    double steep = 0.0;
    double slope = 0.0;    ///< square of the largest one of triangles that face up
    double leaning = 0.0;  ///< largest angle to the plane of the others [rad]

    void add(const Sums& more)
    {
        footprint += more.footprint;
        dry += more.dry;
        area += more.area;
        linear += more.linear;
        steep += more.steep;
        slope = std::max(slope, more.slope);
        leaning = std::max(leaning, more.leaning);
    }
};

Sums sumsOver(const CapillarySurface& surface, std::size_t begin, std::size_t end)
{
    Sums sums;
    for (std::size_t i = begin; i < end; ++i) {
        const Triangle& t = surface.triangles[i];
        const Vec3 normal = areaVector(surface.vertices, t);
        sums.footprint += normal.z;
        if (isDry(surface, t)) {
            sums.dry += normal.z;
            continue;
        }
        sums.area += length(normal);
        const double across = normal.x * normal.x + normal.y * normal.y;
        if (normal.z <= 0.0) {
            sums.leaning = std::max(sums.leaning, std::atan2(std::sqrt(across), normal.z));
            continue;
        }
        const double slope = across / (normal.z * normal.z);
        sums.slope = std::max(sums.slope, slope);
        if (surface.isHeightField()) {
            sums.linear += normal.z * (1.0 + 0.5 * slope);
            sums.steep += slope > kSteep ? normal.z : 0.0;
        }
    }
    return sums;
}

/// How far vertices are above and below the ground [m].
struct Reach {
    double above = 0.0;
    double below = 0.0;
};

Reach reachOf(const CapillarySurface& surface, const SheetBase& base)
{
    Reach reach;
    for (const Reach& part : mapBlocks<Reach>(surface.vertices.size(), [&](std::size_t begin, std::size_t end) {
             Reach own;
             for (std::size_t v = begin; v < end; ++v) {
                 const double clearance = base.clearance(surface.vertices[v]);
                 if (std::isfinite(clearance)) {
                     own = {std::max(own.above, clearance), std::max(own.below, -clearance)};
                 }
             }
             return own;
         })) {
        reach = {std::max(reach.above, part.above), std::max(reach.below, part.below)};
    }
    return reach;
}

/// Adds what follows from footprint and contact angles.
/// @param figures  with the footprint's area, and the depth
void addRimFigures(const CapillarySurface& surface, const SolveOptions& options, ShapeFigures& figures)
{
    const PlaneGravity gravity = planeGravity(options);
    figures.bond_number = options.liquid.density * std::abs(options.gravity) * figures.footprint_area /
                          (std::numbers::pi * options.liquid.surface_tension);
    const double along = length(gravity.along);
    measureRim(surface, along > 0.0 ? (1.0 / along) * gravity.along : Vec2{}, figures);
    const double angle = figures.contact_angle.mean;
    if (options.ground.flat() && along == 0.0 && gravity.normal > 0.0 && angle > 0.0) {
        if (const auto unit = capillaryLength(options.liquid, options.gravity)) {
            figures.height_bound = 2.0 * *unit * std::sin(0.5 * angle);
        }
    }
}

}  // namespace

void Hysteresis::validate() const
{
    if (!(receding >= 0.0 && receding <= advancing && advancing <= std::numbers::pi)) {
        throw Error(
            ErrorCode::InvalidArgument,
            fmt::format("receding {} and advancing {} degrees must be from 0 to 180, and receding at most advancing",
                        numberText(receding / kDegree), numberText(advancing / kDegree)));
    }
}

Retention retention(const ShapeFigures& figures, const SolveOptions& options, const Hysteresis& hysteresis)
{
    hysteresis.validate();
    const double along = length(planeGravity(options).along);
    return {options.liquid.density * figures.volume * along,
            options.liquid.surface_tension * figures.projected_width *
                (std::cos(hysteresis.receding) - std::cos(hysteresis.advancing))};
}

ShapeFigures measure(const CapillarySurface& surface, const SolveOptions& options)
{
    Sums total;
    for (const Sums& block : mapBlocks<Sums>(surface.triangles.size(), [&](std::size_t begin, std::size_t end) {
             return sumsOver(surface, begin, end);
         })) {
        total.add(block);
    }
    const Vec3 weight = weightOf(options);
    const SheetBase base = baseOf(surface, options.ground, weight);
    const SheetIntegrals liquid = base.liquidUnder(surface, weight);
    const Reach reach = reachOf(surface, base);
    const double sigma = options.liquid.surface_tension;
    ShapeFigures figures;
    figures.footprint_area = total.footprint;
    figures.dry_area = total.dry;
    figures.volume = liquid.volume;
    figures.height_max = reach.above;
    figures.depth_max = reach.below;
    figures.overhang = surface.isHeightField() ? 0.0 : overhangOf(surface);
    figures.liquid_area = total.area;
    figures.linear_area = total.linear;
    figures.surface_energy = sigma * total.area;
    figures.gravity_energy = sigma * liquid.gravity;
    figures.slope_max = std::max(total.leaning, std::atan(std::sqrt(total.slope)));
    figures.steep_area = total.steep;
    addRimFigures(surface, options, figures);
    return figures;
}

ShapeFigures combine(const std::vector<ShapeFigures>& droplets)
{
    ShapeFigures total;
    total.contact_angle.min = std::numeric_limits<double>::infinity();
    total.contact_angle.max = -total.contact_angle.min;
    double angle = 0.0;
    for (const ShapeFigures& d : droplets) {
        total.footprint_area += d.footprint_area;
        total.rim_length += d.rim_length;
        total.dry_area += d.dry_area;
        total.volume += d.volume;
        total.height_max = std::max(total.height_max, d.height_max);
        total.height_bound = std::max(total.height_bound, d.height_bound);  // stays empty if no droplet has one
        total.depth_max = std::max(total.depth_max, d.depth_max);
        total.overhang = std::max(total.overhang, d.overhang);
        total.liquid_area += d.liquid_area;
        total.linear_area += d.linear_area;
        total.steep_area += d.steep_area;
        total.projected_width += d.projected_width;
        total.bond_number = std::max(total.bond_number, d.bond_number);
        total.surface_energy += d.surface_energy;
        total.gravity_energy += d.gravity_energy;
        total.slope_max = std::max(total.slope_max, d.slope_max);
        if (d.contact_angle.min < total.contact_angle.min) {
            total.contact_angle.min = d.contact_angle.min;
            total.contact_angle.min_at = d.contact_angle.min_at;
        }
        if (d.contact_angle.max > total.contact_angle.max) {
            total.contact_angle.max = d.contact_angle.max;
            total.contact_angle.max_at = d.contact_angle.max_at;
        }
        angle += d.rim_length * d.contact_angle.mean;
    }
    total.contact_angle.mean = angle / total.rim_length;
    return total;
}

}  // namespace droplet
