// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/vector.h"

namespace droplet::testing {

/// Surface of triangles without attributes.
struct TriangleMesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
};

inline double volume(const TriangleMesh& mesh)
{
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
        sum += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6.0;
    }
    return sum;
}

inline double area(const TriangleMesh& mesh)
{
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.vertices[t[0]];
        sum += 0.5 * length(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
    }
    return sum;
}

/// Distance of a point from a segment.
inline double distance(Vec3 p, Vec3 a, Vec3 b)
{
    const Vec3 ab = b - a;
    const double squared = dot(ab, ab);
    const double t = squared > 0.0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
    return length(p - (a + t * ab));
}

/// Distance of a point from a triangle: from its plane if the point is above it, otherwise from its nearest side.
inline double distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c)
{
    const Vec3 normal = cross(b - a, c - a);
    const double size = length(normal);
    const bool over = size > 0.0 && dot(cross(b - a, p - a), normal) >= 0.0 &&
                      dot(cross(c - b, p - b), normal) >= 0.0 && dot(cross(a - c, p - c), normal) >= 0.0;
    return over ? std::abs(dot(p - a, normal)) / size
                : std::min({distance(p, a, b), distance(p, b, c), distance(p, c, a)});
}

/// Distances of the points of a surface from another one.
struct Distance {
    double mean = 0.0;
    double largest = 0.0;
};

/// Distance of one surface from another: mean over the triangles' centres weighted by area, maximum also over vertices.
inline Distance strays(const TriangleMesh& from, const TriangleMesh& to)
{
    struct Ball {
        Vec3 centre;
        double radius;
    };
    const auto corners = [](const TriangleMesh& mesh, const Triangle& t) {
        return std::array<Vec3, 3>{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    };
    std::vector<Ball> balls;
    for (const Triangle& t : to.triangles) {
        const auto [a, b, c] = corners(to, t);
        const Vec3 centre = (1.0 / 3.0) * (a + b + c);
        balls.push_back({centre, std::max({length(a - centre), length(b - centre), length(c - centre)})});
    }
    const auto nearest = [&](Vec3 p) {
        double min = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < balls.size(); ++k) {
            const Vec3 away = p - balls[k].centre;
            const double reach = min + balls[k].radius;
            if (dot(away, away) < reach * reach) {
                const auto [a, b, c] = corners(to, to.triangles[k]);
                min = std::min(min, distance(p, a, b, c));
            }
        }
        return min;
    };
    Distance result;
    const double whole = area(from);
    for (const Triangle& t : from.triangles) {
        const auto [a, b, c] = corners(from, t);
        const double away = nearest((1.0 / 3.0) * (a + b + c));
        result.mean += 0.5 * length(cross(b - a, c - a)) * away / whole;
        result.largest = std::max(result.largest, away);
    }
    for (const Vec3 p : from.vertices) {
        result.largest = std::max(result.largest, nearest(p));
    }
    return result;
}

/// Difference of two surfaces, independent of their triangulations.
struct Difference {
    Distance distance;    ///< the larger one of both directions, in the surfaces' unit
    double volume = 0.0;  ///< relative to the second
    double area = 0.0;    ///< relative to the second
};

inline Difference compare(const TriangleMesh& found, const TriangleMesh& wanted)
{
    const Distance there = strays(found, wanted);
    const Distance back = strays(wanted, found);
    return {{std::max(there.mean, back.mean), std::max(there.largest, back.largest)},
            volume(found) / volume(wanted) - 1.0,
            area(found) / area(wanted) - 1.0};
}

}  // namespace droplet::testing
