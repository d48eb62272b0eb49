// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/capsule_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace droplet {
namespace {

/// Place on the rim: a point of the axis, and the direction from there.
struct RimPlace {
    double axis = 0.0;
    Vec2 direction;
};

/// @param way  along the rim from +x, 0 … half the rim's length
RimPlace rimPlace(const RunningShape& shape, double way)
{
    const double quarter = 0.5 * std::numbers::pi * shape.contact_radius;
    const double straight = 2.0 * shape.half_length;
    if (way > quarter && way < quarter + straight) {
        return {shape.half_length - (way - quarter), {0.0, 1.0}};
    }
    const bool is_ahead = way <= quarter;
    const double angle = (is_ahead ? way : way - straight) / shape.contact_radius;
    return {is_ahead ? shape.half_length : -shape.half_length, {std::cos(angle), std::sin(angle)}};
}

}  // namespace

BodyGrid capsuleGrid(const RunningShape& shape)
{
    constexpr std::size_t kHalf = kBodySlices / 2;
    const double half_rim = std::numbers::pi * shape.contact_radius + 2.0 * shape.half_length;
    const double widest = std::atan2(shape.contact_radius, -shape.centre_height);  // polar angle of the rim
    struct Level {
        double out = 0.0;
        double height = 0.0;
        double axis = 1.0;  ///< share of the axis: above the widest place rings shrink towards the middle
    };
    std::array<Level, kBodyRings> levels{{{shape.contact_radius, 0.0, 1.0}}};
    for (std::size_t k = 1; k < kBodyRings; ++k) {
        const double polar = widest * (1.0 - static_cast<double>(k) / static_cast<double>(kBodyRings));
        levels[k] = {shape.radius * std::sin(polar), shape.centre_height + shape.radius * std::cos(polar), 1.0};
        if (polar < 0.5 * std::numbers::pi) {
            levels[k].axis = levels[k].out / shape.silhouette();
        }
    }
    BodyGrid grid;
    for (std::size_t j = 0; j < kBodySlices; ++j) {
        const std::size_t mirrored = j <= kHalf ? j : kBodySlices - j;
        RimPlace place = rimPlace(shape, half_rim * static_cast<double>(mirrored) / static_cast<double>(kHalf));
        if (mirrored == 0 || mirrored == kHalf) {
            place.direction.y = 0.0;
        }
        place.direction.y = mirrored == j ? place.direction.y : -place.direction.y;
        for (std::size_t k = 0; k < kBodyRings; ++k) {
            const Level& level = levels[k];
            const Vec2 p{level.axis * place.axis + level.out * place.direction.x, level.out * place.direction.y};
            double height = level.height;
            if (level.axis < 1.0) {
                const double beyond = std::max(std::abs(p.x) - shape.half_length, 0.0);
                const double far = std::hypot(beyond, p.y);
                height = shape.centre_height + std::sqrt(shape.radius * shape.radius - far * far);
            }
            grid.set(k, j, {p.x, p.y, height});
        }
        grid.inward[j] = {-std::cos(widest) * place.direction.x, -std::cos(widest) * place.direction.y,
                          std::sin(widest)};
    }
    grid.apex = {0.0, 0.0, shape.height()};
    return grid;
}

}  // namespace droplet
