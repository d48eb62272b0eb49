// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest point of a triangle: C. Ericson, "Real-Time Collision Detection" (2005), section 5.1.5. Sides are examined
// one by one, which also handles triangles without area.
#include "rays/nearest.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace droplet {
namespace {

// Ratio of area to the square of the longest side at which a triangle counts as its sides: round-off of coordinates.
constexpr double kSliver = 1e-12;

Vec3 nearestOnSide(Vec3 p, Vec3 a, Vec3 b)
{
    const Vec3 side = b - a;
    const double squared = dot(side, side);
    return squared > 0.0 ? a + std::clamp(dot(p - a, side) / squared, 0.0, 1.0) * side : a;
}

}  // namespace

Vec3 nearestPoint(Vec3 p, const Corners3& triangle)
{
    const auto& [a, b, c] = triangle;
    const Vec3 normal = cross(b - a, c - a);
    const double squared = dot(normal, normal);
    const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
    if (squared > kSliver * kSliver * longest * longest && dot(cross(b - a, p - a), normal) >= 0.0 &&
        dot(cross(c - b, p - b), normal) >= 0.0 && dot(cross(a - c, p - c), normal) >= 0.0) {
        return p - (dot(p - a, normal) / squared) * normal;
    }
    Vec3 nearest = nearestOnSide(p, a, b);
    for (const Vec3 other : {nearestOnSide(p, b, c), nearestOnSide(p, c, a)}) {
        if (dot(p - other, p - other) < dot(p - nearest, p - nearest)) {
            nearest = other;
        }
    }
    return nearest;
}

NearestTriangles::NearestTriangles(std::vector<Corners3> triangles)
    : triangles_(std::move(triangles)), tree_(triangles_)
{
    facets_.reserve(triangles_.size());
    for (const auto& [a, b, c] : triangles_) {
        facets_.push_back(cross(b - a, c - a));
    }
}

NearestTriangles::Found NearestTriangles::nearest(Vec3 p, std::uint32_t guess) const
{
    Found found;
    const auto look = [&](std::uint32_t triangle) {
        const Vec3 point = nearestPoint(p, triangles_[triangle]);
        return Found{length(p - point), triangle, point};
    };
    found = look(guess);
    auto visitor = [&](std::uint32_t triangle) {
        const Found here = look(triangle);
        if (here.distance < found.distance || (here.distance == found.distance && triangle < found.triangle)) {
            found = here;
        }
        return found.distance;
    };
    tree_.visit(p, found.distance, std::ref(visitor));
    return found;
}

std::optional<NearestTriangles::Found> NearestTriangles::nearestFacing(Vec3 p, Vec3 direction, double max) const
{
    std::optional<Found> found;
    auto visitor = [&](std::uint32_t triangle) {
        if (dot(facets_[triangle], direction) > 0.0) {
            const Vec3 point = nearestPoint(p, triangles_[triangle]);
            const double away = length(p - point);
            if (found ? away < found->distance || (away == found->distance && triangle < found->triangle)
                      : away <= max) {
                found = {away, triangle, point};
            }
        }
        return found ? found->distance : max;
    };
    tree_.visit(p, max, std::ref(visitor));
    return found;
}

std::vector<std::uint32_t> NearestTriangles::within(Vec3 p, double max) const
{
    std::vector<std::uint32_t> found;
    auto visitor = [&](std::uint32_t triangle) {
        if (distance(p, triangles_[triangle]) <= max) {
            found.push_back(triangle);
        }
        return max;
    };
    tree_.visit(p, max, std::ref(visitor));
    std::sort(found.begin(), found.end());
    return found;
}

std::optional<std::vector<std::uint32_t>> NearestTriangles::boxesWithin(Vec3 p, double max, std::size_t limit) const
{
    std::vector<std::uint32_t> found;
    auto visitor = [&](std::uint32_t triangle) {
        const auto& [a, b, c] = triangles_[triangle];
        const auto gap = [](double x, double u, double v, double w) {
            return std::max({0.0, std::min({u, v, w}) - x, x - std::max({u, v, w})});
        };
        const Vec3 away{gap(p.x, a.x, b.x, c.x), gap(p.y, a.y, b.y, c.y), gap(p.z, a.z, b.z, c.z)};
        if (found.size() <= limit && dot(away, away) <= max * max) {
            found.push_back(triangle);
        }
        return found.size() <= limit ? max : 0.0;
    };
    tree_.visit(p, max, std::ref(visitor));
    if (found.size() > limit) {
        return std::nullopt;
    }
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace droplet
