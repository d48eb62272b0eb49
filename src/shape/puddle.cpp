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

/// Difference between the highest and the lowest ground under a footprint [m].
double reliefUnder(const PlanarMesh& footprint, const BaseSurface& ground)
{
    if (ground.flat()) {
        return 0.0;
    }
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (const Vec2& place : footprint.vertices) {
        const double height = ground.at(place).height;
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    return highest - lowest;
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
                                      reliefUnder(*footprint, options.ground));
    }
    return std::isfinite(height) ? std::optional(height) : std::nullopt;
}

}  // namespace droplet
