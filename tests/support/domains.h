// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "droplet/domain/domain.h"

namespace droplet::testing {

/// Smooth loop of many points, without corners.
inline Loop smoothLoop(std::vector<Vec2> points)
{
    Loop loop{std::move(points), {}};
    loop.corner.assign(loop.points.size(), 0);
    return loop;
}

/// Ellipse about the origin as a fine polygon; the relative error of its area is 1e-7.
inline Loop ellipseLoop(double a, double b)
{
    constexpr std::size_t kPoints = 8192;
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < kPoints; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kPoints;
        points.push_back({a * std::cos(angle), b * std::sin(angle)});
    }
    return smoothLoop(std::move(points));
}

/// Polygon whose vertices are corners, with subdivided sides.
inline Loop polygonLoop(const std::vector<Vec2>& corners)
{
    constexpr std::size_t kPieces = 64;
    Loop loop;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 a = corners[i];
        const Vec2 b = corners[(i + 1) % corners.size()];
        for (std::size_t k = 0; k < kPieces; ++k) {
            loop.points.push_back(a + (static_cast<double>(k) / kPieces) * (b - a));
            loop.corner.push_back(k == 0 ? 1 : 0);
        }
    }
    return loop;
}

inline Loop reversed(const Loop& loop)
{
    return {{loop.points.rbegin(), loop.points.rend()}, {loop.corner.rbegin(), loop.corner.rend()}};
}

/// A domain of one droplet.
inline Domain domainOf(Loop rim, std::vector<Loop> holes = {})
{
    Domain domain;
    domain.droplets.push_back({std::move(rim), std::move(holes)});
    domain.extent = {1.0, 1.0};
    return domain;
}

}  // namespace droplet::testing
