// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/puddle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace droplet {
namespace {

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

double puddleHeight(const SolveOptions& options, double angle, double area)
{
    constexpr double kNone = 1e-9;  // of gravity across a wall: the cosine of 90° is not exactly 0
    const double normal = planeGravity(options).normal;
    const bool is_linear = options.model == Model::Linear;
    const double slope = is_linear ? 0.5 * std::tan(angle) : std::tan(0.5 * angle);
    if (std::abs(normal) <= kNone * std::abs(options.gravity)) {
        return slope * std::sqrt(area / std::numbers::pi);
    }
    if (normal < 0.0) {
        return std::numeric_limits<double>::infinity();
    }
    return *capillaryLength(options.liquid, normal) * (is_linear ? std::tan(angle) : 2.0 * std::sin(0.5 * angle));
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
