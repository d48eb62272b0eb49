// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "droplet/outline/outline.h"
#include "droplet/vector.h"

namespace droplet::testing {

inline double distanceToPiece(Vec2 p, Vec2 a, Vec2 b)
{
    const Vec2 along = b - a;
    const double squared = dot(along, along);
    const double t = squared > 0.0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
    return length(p - (a + t * along));
}

inline double polygonArea(const std::vector<Vec2>& polygon)
{
    double twice = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    }
    return 0.5 * twice;
}

/// Points of loops, without their corners.
inline std::vector<std::vector<Vec2>> pointsOf(const std::vector<Loop>& loops)
{
    std::vector<std::vector<Vec2>> points;
    for (const Loop& loop : loops) {
        points.push_back(loop.points);
    }
    return points;
}

/// Winding number of a polygon around a point.
inline int windingNumber(const std::vector<Vec2>& polygon, Vec2 p)
{
    int winding = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 a = polygon[i];
        const Vec2 b = polygon[(i + 1) % polygon.size()];
        const double side = cross(b - a, p - a);
        winding += (a.y <= p.y && b.y > p.y && side > 0.0) ? 1 : 0;
        winding -= (b.y <= p.y && a.y > p.y && side < 0.0) ? 1 : 0;
    }
    return winding;
}

/// Minimum distance between segments that are not neighbours; 0 if any cross or touch.
inline double minGap(const std::vector<std::vector<Vec2>>& loops)
{
    struct Piece {
        Vec2 a;
        Vec2 b;
        std::size_t loop;
        std::size_t index;
    };
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k < loops.size(); ++k) {
        for (std::size_t i = 0; i < loops[k].size(); ++i) {
            pieces.push_back({loops[k][i], loops[k][(i + 1) % loops[k].size()], k, i});
        }
    }
    double min = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Piece& p = pieces[i];
            const Piece& q = pieces[j];
            const std::size_t count = loops[p.loop].size();
            if (p.loop == q.loop && (p.index == (q.index + 1) % count || q.index == (p.index + 1) % count)) {
                continue;
            }
            const bool cross_p = (cross(p.b - p.a, q.a - p.a) > 0) != (cross(p.b - p.a, q.b - p.a) > 0);
            const bool cross_q = (cross(q.b - q.a, p.a - q.a) > 0) != (cross(q.b - q.a, p.b - q.a) > 0);
            if (cross_p && cross_q) {
                return 0.0;
            }
            min = std::min({min, distanceToPiece(p.a, q.a, q.b), distanceToPiece(p.b, q.a, q.b),
                            distanceToPiece(q.a, p.a, p.b), distanceToPiece(q.b, p.a, p.b)});
        }
    }
    return min;
}

}  // namespace droplet::testing
