// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/puddle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace droplet {
namespace {

/// Part of gravity across a wall that is none: the cosine of 90° is not exactly 0.
constexpr double kAcross = 1e-9;

/// Greatest depth of the ground below a film without weight and pressure that is spread over the rim [m]: liquid that
/// is level with the rim is as thick. 0 over a ball, the depth of a bowl. The film of the linear model is harmonic, and
/// affine in the pressure.
double depthBelowRim(const PlanarMesh& footprint, const BaseSurface& ground)
{
    if (ground.flat()) {
        return 0.0;
    }
    SolveOptions options;
    options.liquid.density = 0.0;
    options.ground = ground;
    options.model = Model::Linear;
    const double volume = std::pow(area(footprint), 1.5);
    options.volumes = {volume, 2.0 * volume};
    const std::vector<CapillarySurface> films = solve({footprint, footprint}, options).droplets;
    const CapillarySurface& one = films.at(0);
    const CapillarySurface& two = films.at(1);
    const double share = one.pressure / (two.pressure - one.pressure);
    double depth = 0.0;
    for (std::size_t v = 0; v < one.vertices.size(); ++v) {
        const double film = one.vertices[v].z - share * (two.vertices[v].z - one.vertices[v].z);
        depth = std::max(depth, film - ground.at(footprint.vertices[v]).height);
    }
    return depth;
}

}  // namespace

std::optional<double> bendingLayer(const SolveOptions& options)
{
    const double normal = planeGravity(options).normal;
    return normal > kAcross * std::abs(options.gravity) ? capillaryLength(options.liquid, normal) : std::nullopt;
}

double puddleHeight(const SolveOptions& options, double angle, double area)
{
    const bool is_linear = options.model == Model::Linear;
    if (const std::optional<double> layer = bendingLayer(options)) {
        return *layer * (is_linear ? std::tan(angle) : 2.0 * std::sin(0.5 * angle));
    }
    const bool is_ceiling = planeGravity(options).normal < -kAcross * std::abs(options.gravity);
    if (is_ceiling && options.liquid.density > 0.0) {
        return std::numeric_limits<double>::infinity();
    }
    return std::sqrt(area / std::numbers::pi) * (is_linear ? 0.5 * std::tan(angle) : std::tan(0.5 * angle));
}

std::optional<double> maxHeight(const std::vector<const PlanarMesh*>& footprints, const SolveOptions& options)
{
    if (!options.fill.below_puddle || options.fill.by != FillBy::ContactAngle) {
        return std::nullopt;
    }
    double height = 0.0;
    for (const PlanarMesh* footprint : footprints) {
        height = std::max(height, puddleHeight(options, options.fill.amount, area(*footprint)) +
                                      depthBelowRim(*footprint, options.ground));
    }
    return std::isfinite(height) ? std::optional(height) : std::nullopt;
}

}  // namespace droplet
