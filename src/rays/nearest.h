// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/vector.h"
#include "rays/triangle_tree.h"

namespace droplet {

/// Point of a triangle that is nearest to p. The triangle may be degenerate.
Vec3 nearestPoint(Vec3 p, const Corners3& triangle);

inline double distance(Vec3 p, const Corners3& triangle)
{
    return length(p - nearestPoint(p, triangle));
}

/// Finds triangles near a point. Any number of threads may search at the same time.
class NearestTriangles {
public:
    struct Found {
        double distance = 0.0;
        std::uint32_t triangle = 0;  ///< first one of several equally near
        Vec3 point;                  ///< of that triangle
    };

    /// Builds the tree.
    /// @param triangles  at least one, all coordinates within [−1, 1]
    explicit NearestTriangles(std::vector<Corners3> triangles);
    NearestTriangles(const NearestTriangles&) = delete;
    NearestTriangles& operator=(const NearestTriangles&) = delete;

    [[nodiscard]] const std::vector<Corners3>& triangles() const { return triangles_; }
    /// Twice a triangle's area times its normal.
    [[nodiscard]] const Vec3& facet(std::uint32_t triangle) const { return facets_[triangle]; }

    /// The nearest triangle.
    /// @param p      within [−1, 1]³
    /// @param guess  a triangle that may be near; it saves time and does not change the result
    [[nodiscard]] Found nearest(Vec3 p, std::uint32_t guess = 0) const;

    /// The nearest among the triangles that face a direction and are no farther than `max`.
    [[nodiscard]] std::optional<Found> nearestFacing(Vec3 p, Vec3 direction, double max) const;

    /// Triangles no farther from p than `max`, in ascending order.
    [[nodiscard]] std::vector<std::uint32_t> within(Vec3 p, double max) const;

    /// Triangles whose boxes are no farther from p than `max`, in ascending order: all that within() finds, and more.
    /// Empty optional if there are more than `limit`.
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> boxesWithin(Vec3 p, double max, std::size_t limit) const;

private:
    std::vector<Corners3> triangles_;
    std::vector<Vec3> facets_;
    TriangleTree tree_;
};

}  // namespace droplet
