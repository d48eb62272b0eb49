// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "droplet/image/height_map.h"
#include "droplet/vector.h"

namespace droplet {

/// The ground's height at a point of the plane, and the gradient of it.
struct GroundPoint {
    double height = 0.0;  ///< h, out of the plane [m]
    Vec2 gradient;        ///< ∇h
};

/// The ground a droplet stands on: a height field over the footprint's plane. Made without anything, it is the plane
/// itself.
class BaseSurface {
public:
    /// Guarantees wanted of it: the same point gives the same result on every thread.
    /// Throws Error InvalidArgument where there is no ground.
    using Sample = std::function<GroundPoint(Vec2)>;

    BaseSurface() = default;
    explicit BaseSurface(Sample sample);

    /// A sphere whose top is the plane's origin; there is no ground beyond its radius.
    /// @param radius  [m] ≠ 0; negative: a bowl whose deepest point is there
    /// @throws Error  InvalidArgument
    static BaseSurface sphere(double radius);

    /// A cylinder that touches the plane from below along a line through the origin; there is no ground beyond its
    /// radius from that line.
    /// @param radius  [m] ≠ 0; negative: a gutter
    /// @param axis    of the line in the plane, counter-clockwise from +x [rad]
    /// @throws Error  InvalidArgument
    static BaseSurface cylinder(double radius, double axis);

    /// A picture stretched over the footprint's: height `depth` times its level.
    ///
    /// Guarantees: continuous with its gradient; exact in the pixels' centres, and between them where the levels are
    /// those of a quadratic, but for the outermost two rows and columns. Beyond the outermost centres heights turn
    /// into theirs within one pixel, and stay.
    /// @param map     valid
    /// @param extent  of the picture, centred at the origin [m]; both > 0
    /// @param depth   height of level 1 [m]; not needed of a picture of floats, whose levels are then metres
    /// @throws Error  InvalidArgument; InvalidInput for the map
    static BaseSurface heightMap(HeightMap map, Vec2 extent, std::optional<double> depth = {});

    [[nodiscard]] bool flat() const { return !sample_; }
    [[nodiscard]] GroundPoint at(Vec2 p) const { return sample_ ? sample_(p) : GroundPoint{}; }

    /// Guarantees: returns only when there is ground at all of the points; of a sphere or a cylinder, then also between
    /// them.
    /// @param points  of the plane [m]
    /// @throws Error  InvalidArgument, of the point farthest out where the ground has a radius, else of the first
    void requireAt(std::span<const Vec2> points) const;

private:
    /// How far a point is from where the ground touches the plane [m].
    using Distance = std::function<double(Vec2)>;

    BaseSurface(Sample sample, Distance distance);

    Sample sample_;
    Distance distance_;  ///< empty where the ground has no radius
};

}  // namespace droplet
