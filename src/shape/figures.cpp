// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/shape/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "blocks.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "number_text.h"
#include "shape/gradient.h"
#include "shape/rim_figures.h"

namespace droplet {
namespace {

/// Square of the slope up to which the linear model's area is within 10 % (thesis, section 4.1.2): tan² 50°.
constexpr double kSteep = 1.4202766254612063;

void measureRim(const PlanarMesh& mesh, const std::vector<double>& contact_angle, Vec2 downhill, ShapeFigures& figures)
{
    ContactAngle& angle = figures.contact_angle;
    angle.min = std::numeric_limits<double>::infinity();
    angle.max = -angle.min;
    double sum = 0.0;
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            const std::uint32_t next = nextOnRim(mesh, loop, v);
            const Vec2 along = mesh.vertices[next] - mesh.vertices[v];
            const double edge = length(along);
            const double here = contact_angle[v];
            sum += 0.5 * edge * (here + contact_angle[next]);
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
    double area = 0.0;
    double dry = 0.0;
    double volume = 0.0;
    double liquid_area = 0.0;
    double linear_area = 0.0;
    double steep = 0.0;
    double squares = 0.0;  ///< ∫(u² − h²)
    Vec2 moment;           ///< ∫x(u − h)
    double steepest = 0.0;
};

Sums sumsOver(const PlanarMesh& mesh, const HeightField& field, std::size_t begin, std::size_t end)
{
    const std::vector<double>& u = field.height;
    const auto on_ground = [&](std::uint32_t v) { return mesh.onRim(v) || field.dry[v] != 0; };
    // ∫u² of a linear function over a triangle, divided by its area.
    const auto mean_square = [](double a, double b, double c) {
        return (a * a + b * b + c * c + a * b + b * c + c * a) / 6.0;
    };
    Sums sums;
    for (std::size_t i = begin; i < end; ++i) {
        const Triangle& t = mesh.triangles[i];
        const double area = 0.5 * doubleArea(mesh, t);
        sums.area += area;
        if (!field.dry.empty() && std::all_of(t.begin(), t.end(), on_ground)) {
            sums.dry += area;
            continue;
        }
        const std::array<double, 3> thick{field.thicknessAt(t[0]), field.thicknessAt(t[1]), field.thicknessAt(t[2])};
        const double third = area * (thick[0] + thick[1] + thick[2]) / 3.0;
        const Vec2 g = gradient(mesh, t, u);
        const double slope = dot(g, g);
        sums.volume += third;
        sums.liquid_area += area * std::sqrt(1.0 + slope);
        sums.linear_area += area * (1.0 + 0.5 * slope);
        sums.steep += slope > kSteep ? area : 0.0;
        sums.squares += area * mean_square(u[t[0]], u[t[1]], u[t[2]]);
        if (!field.ground.empty()) {
            sums.squares -= area * mean_square(field.ground[t[0]], field.ground[t[1]], field.ground[t[2]]);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            // ∫φx over a triangle: A/12 (sum of its corners + the vertex).
            const Vec2 weighted = mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]] + mesh.vertices[t[k]];
            sums.moment = sums.moment + (area / 12.0 * thick[k]) * weighted;
        }
        sums.steepest = std::max(sums.steepest, slope);
    }
    return sums;
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

void addRimFigures(const PlanarMesh& mesh, const std::vector<double>& contact_angle, const SolveOptions& options,
                   ShapeFigures& figures)
{
    const PlaneGravity gravity = planeGravity(options);
    figures.bond_number = options.liquid.density * std::abs(options.gravity) * figures.footprint_area /
                          (std::numbers::pi * options.liquid.surface_tension);
    const double along = length(gravity.along);
    measureRim(mesh, contact_angle, along > 0.0 ? (1.0 / along) * gravity.along : Vec2{}, figures);
    const double angle = figures.contact_angle.mean;
    if (options.ground.flat() && along == 0.0 && gravity.normal > 0.0 && angle > 0.0) {
        if (const auto unit = capillaryLength(options.liquid, options.gravity)) {
            figures.height_bound = 2.0 * *unit * std::sin(0.5 * angle);
        }
    }
}

ShapeFigures measure(const PlanarMesh& mesh, const HeightField& field, const SolveOptions& options)
{
    Sums total;
    for (const Sums& block : mapBlocks<Sums>(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
             return sumsOver(mesh, field, begin, end);
         })) {
        total.area += block.area;
        total.dry += block.dry;
        total.volume += block.volume;
        total.liquid_area += block.liquid_area;
        total.linear_area += block.linear_area;
        total.steep += block.steep;
        total.squares += block.squares;
        total.moment = total.moment + block.moment;
        total.steepest = std::max(total.steepest, block.steepest);
    }
    const PlaneGravity gravity = planeGravity(options);
    const double density = options.liquid.density;
    const double sigma = options.liquid.surface_tension;
    ShapeFigures figures;
    figures.footprint_area = total.area;
    figures.dry_area = total.dry;
    figures.volume = total.volume;
    figures.liquid_area = total.liquid_area;
    figures.linear_area = total.linear_area;
    figures.steep_area = total.steep;
    for (std::uint32_t v = 0; v < field.height.size(); ++v) {
        const double thickness = field.thicknessAt(v);
        figures.height_max = std::max(figures.height_max, thickness);
        figures.depth_max = std::max(figures.depth_max, -thickness);
    }
    figures.surface_energy = sigma * figures.liquid_area;
    figures.gravity_energy = density * (0.5 * gravity.normal * total.squares - dot(gravity.along, total.moment));
    figures.slope_max = std::atan(std::sqrt(total.steepest));
    addRimFigures(mesh, field.contact_angle, options, figures);
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
