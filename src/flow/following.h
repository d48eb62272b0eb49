// SPDX-License-Identifier: GPL-3.0-or-later
// What is on a face of a surface goes with it when the surface takes another shape.
#pragma once

#include <array>
#include <cmath>

#include "droplet/flow/flow_surface.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/vector.h"

namespace droplet {

/// Weights of a triangle's corners at a place in its plane; their sum is 1.
inline std::array<double, 3> weightsOn(const std::array<Vec3, 3>& corners, Vec3 place)
{
    const Vec3 p = corners[1] - corners[0];
    const Vec3 q = corners[2] - corners[0];
    const Vec3 across = cross(p, q);
    const Vec3 d = place - corners[0];
    const double v = dot(cross(d, q), across) / dot(across, across);
    const double w = dot(cross(p, d), across) / dot(across, across);
    return {1.0 - v - w, v, w};
}

/// Mean of the values at a triangle's corners.
inline Vec3 mixed(const std::array<Vec3, 3>& values, const std::array<double, 3>& weights)
{
    return weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2];
}

/// Where a place on a face is in another shape of this face.
inline Vec3 followed(const FlowSurface::Face& from, const FlowSurface::Face& to, Vec3 place)
{
    return from.corners == to.corners ? place : mixed(to.corners, weightsOn(from.corners, place));
}

/// How much longer what lies on a face is in another shape of this face, on average over directions.
inline double stretchOf(const FlowSurface::Face& from, const FlowSurface::Face& to)
{
    return std::sqrt(areaOf(to) / areaOf(from));
}

/// A direction that turns with a face: its normal stays one, and along the face it turns as the sides do on average.
inline Vec3 turnedWith(const FlowSurface::Face& from, const FlowSurface::Face& to, Vec3 direction)
{
    if (from.corners == to.corners) {
        return direction;
    }
    struct Axes {
        explicit Axes(const FlowSurface::Face& face) : normal(face.normal)
        {
            const Vec3 side = face.corners[1] - face.corners[0];
            along = (1.0 / length(side)) * side;
            across = cross(normal, along);
        }
        [[nodiscard]] Vec2 of(Vec3 v) const { return {dot(v, along), dot(v, across)}; }
        Vec3 normal;
        Vec3 along;
        Vec3 across;
    };
    const Axes a(from);
    const Axes b(to);
    double cosine = 0.0;
    double sine = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 p = a.of(from.corners[(k + 1) % 3] - from.corners[k]);
        const Vec2 q = b.of(to.corners[(k + 1) % 3] - to.corners[k]);
        cosine += dot(p, q);
        sine += cross(p, q);
    }
    const double size = std::hypot(cosine, sine);
    const Vec2 flat = a.of(direction);
    const double along = (cosine * flat.x - sine * flat.y) / size;
    const double across = (sine * flat.x + cosine * flat.y) / size;
    return along * b.along + across * b.across + dot(direction, a.normal) * b.normal;
}

}  // namespace droplet
