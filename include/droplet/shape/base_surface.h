// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "droplet/image/height_map.h"
#include "droplet/vector.h"

namespace droplet {

/// Height and slope of the ground at a point of the plane.
struct GroundPoint {
    double height = 0.0;  ///< h, out of the plane [m]
    Vec2 gradient;        ///< ∇h
};

/// Ground under a droplet: a height field over the footprint's plane. The default is the plane itself.
class BaseSurface {
public:
    /// Function that gives the ground at a point, or nothing where there is none; the same on every thread.
    using Sample = std::function<std::optional<GroundPoint>(Vec2)>;

    /// Flat ground: the plane itself.
    BaseSurface() = default;
    /// Ground of any shape.
    /// @param sample  ground at every point; empty: flat
    explicit BaseSurface(Sample sample);

    /// Sphere whose top is the plane's origin. The ground ends at its radius.
    /// @param radius  [m] ≠ 0; negative: a bowl whose deepest point is the origin
    /// @throws Error  InvalidArgument
    static BaseSurface sphere(double radius);

    /// Cylinder that touches the plane from below along a line through the origin. The ground ends at its radius from
    /// that line.
    /// @param radius  [m] ≠ 0; negative: a gutter
    /// @param axis    direction of the line in the plane, counter-clockwise from +x [rad]
    /// @throws Error  InvalidArgument
    static BaseSurface cylinder(double radius, double axis);

    /// Height map, stretched over the footprint's picture: the height is `depth` times the level.
    ///
    /// Guarantees: height and gradient are continuous. Heights are exact at pixel centres; for levels of a quadratic
    /// function also between them, except in the outermost two rows and columns. Beyond the outermost centres the
    /// height levels off within one pixel to the height of the nearest centre.
    /// @param map     valid
    /// @param extent  size of the picture, centred at the origin [m]; both > 0
    /// @param depth   height of level 1 [m]; may be empty for a picture of floats, whose levels are then metres
    /// @throws Error  InvalidArgument; InvalidInput for the map
    static BaseSurface heightMap(HeightMap map, Vec2 extent, std::optional<double> depth = {});

    /// Whether the ground is the plane itself.
    [[nodiscard]] bool flat() const { return !sample_; }
    /// Ground at a point of the plane [m].
    /// @return  none where there is no ground
    [[nodiscard]] std::optional<GroundPoint> find(Vec2 p) const { return sample_ ? sample_(p) : GroundPoint{}; }
    /// Ground at a point of the plane [m] that has some.
    /// @throws Error InvalidArgument where there is no ground
    [[nodiscard]] GroundPoint at(Vec2 p) const;

    /// Checks that there is ground at all points; for a sphere or a cylinder there is then ground between them, too.
    /// @param points  points of the plane [m]
    /// @throws Error  InvalidArgument, for the outermost point if the ground has a radius, otherwise for the first one
    void requireAt(std::span<const Vec2> points) const;

private:
    /// Where round ground ends.
    struct Bounds {
        std::function<double(Vec2)> distance;  ///< of a point from where the ground touches the plane [m]
        double radius = 0.0;                   ///< ground is nearer than that [m] > 0
        const char* body = "";                 ///< words on what has the radius
        const char* middle = "";               ///< name of where it touches the plane
    };

    BaseSurface(Sample sample, Bounds bounds);

    Sample sample_;
    std::optional<Bounds> bounds_;
};

}  // namespace droplet
