// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/shape/figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "blocks.h"
#include "shape/gradient.h"

namespace droplet {
namespace {

void measureRim(const PlanarMesh& mesh, const HeightField& field, ShapeFigures& figures)
{
    ContactAngle& angle = figures.contact_angle;
    angle.min = std::numeric_limits<double>::infinity();
    angle.max = -angle.min;
    double sum = 0.0;
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            const std::uint32_t next = nextOnRim(mesh, loop, v);
            const double edge = length(mesh.vertices[next] - mesh.vertices[v]);
            const double here = std::atan(field.rim_slope[v]);
            sum += 0.5 * edge * (here + std::atan(field.rim_slope[next]));
            figures.rim_length += edge;
            angle.min = std::min(angle.min, here);
            angle.max = std::max(angle.max, here);
        }
    }
    angle.mean = sum / figures.rim_length;
}

}  // namespace

ShapeFigures measure(const PlanarMesh& mesh, const HeightField& field, const SolveOptions& options)
{
    struct Sums {
        double area = 0.0;
        double volume = 0.0;
        double liquid_area = 0.0;
        double squares = 0.0;
        double steepest = 0.0;
    };
    const std::vector<double>& u = field.height;
    Sums total;
    for (const Sums& block : mapBlocks<Sums>(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
             Sums sums;
             for (std::size_t i = begin; i < end; ++i) {
                 const Triangle& t = mesh.triangles[i];
                 const double area = 0.5 * doubleArea(mesh, t);
                 const double a = u[t[0]];
                 const double b = u[t[1]];
                 const double c = u[t[2]];
                 const Vec2 g = gradient(mesh, t, u);
                 const double slope = dot(g, g);
                 sums.area += area;
                 sums.volume += area * (a + b + c) / 3.0;
                 sums.liquid_area += area * std::sqrt(1.0 + slope);
                 // ∫u² of a linear function over a triangle.
                 sums.squares += area * (a * a + b * b + c * c + a * b + b * c + c * a) / 6.0;
                 sums.steepest = std::max(sums.steepest, slope);
             }
             return sums;
         })) {
        total.area += block.area;
        total.volume += block.volume;
        total.liquid_area += block.liquid_area;
        total.squares += block.squares;
        total.steepest = std::max(total.steepest, block.steepest);
    }
    ShapeFigures figures;
    figures.footprint_area = total.area;
    figures.volume = total.volume;
    figures.liquid_area = total.liquid_area;
    figures.height_max = *std::max_element(field.height.begin(), field.height.end());
    figures.surface_energy = options.liquid.surface_tension * figures.liquid_area;
    figures.gravity_energy = 0.5 * options.liquid.density * options.gravity * total.squares;
    figures.slope_max = std::atan(std::sqrt(total.steepest));
    measureRim(mesh, field, figures);
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
        total.volume += d.volume;
        total.height_max = std::max(total.height_max, d.height_max);
        total.liquid_area += d.liquid_area;
        total.surface_energy += d.surface_energy;
        total.gravity_energy += d.gravity_energy;
        total.slope_max = std::max(total.slope_max, d.slope_max);
        total.contact_angle.min = std::min(total.contact_angle.min, d.contact_angle.min);
        total.contact_angle.max = std::max(total.contact_angle.max, d.contact_angle.max);
        angle += d.rim_length * d.contact_angle.mean;
    }
    total.contact_angle.mean = angle / total.rim_length;
    return total;
}

}  // namespace droplet
