// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// The corners of a triangle in space.
using Corners3 = std::array<Vec3, 3>;

/// The point of a triangle, degenerate or not, that is nearest to p.
Vec3 nearestPoint(Vec3 p, const Corners3& triangle);

inline double distance(Vec3 p, const Corners3& triangle)
{
    return length(p - nearestPoint(p, triangle));
}

/// Triangles to be asked for the nearest to a point, from any number of threads.
class NearestTriangles {
public:
    struct Found {
        double distance = 0.0;
        std::uint32_t triangle = 0;  ///< of several equally near the first
        Vec3 point;                  ///< of that triangle
    };

    /// @param triangles  at least one, all coordinates within [−1, 1]
    explicit NearestTriangles(std::vector<Corners3> triangles);
    ~NearestTriangles();
    NearestTriangles(const NearestTriangles&) = delete;
    NearestTriangles& operator=(const NearestTriangles&) = delete;

    [[nodiscard]] const std::vector<Corners3>& triangles() const { return triangles_; }
    /// Twice a triangle's area times its normal.
    [[nodiscard]] const Vec3& facet(std::uint32_t triangle) const { return facets_[triangle]; }

    /// @param p      within [−1, 1]³
    /// @param guess  a triangle that may be near, which saves time and changes nothing
    [[nodiscard]] Found nearest(Vec3 p, std::uint32_t guess = 0) const;

    /// The nearest among the triangles that face a direction and are no farther than `max`.
    [[nodiscard]] std::optional<Found> nearestFacing(Vec3 p, Vec3 direction, double max) const;

    /// Triangles no farther from p than `max`, in rising order.
    [[nodiscard]] std::vector<std::uint32_t> within(Vec3 p, double max) const;

    /// Triangles whose boxes are no farther from p than `max`, in rising order: all that `within` finds, and more.
    /// Nothing where there are over `limit` of them.
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> boxesWithin(Vec3 p, double max, std::size_t limit) const;

private:
    struct Tree;
    template <typename Visit>
    void visit(Vec3 p, double radius, Visit& visit) const;

    std::vector<Corners3> triangles_;
    std::vector<Vec3> facets_;
    std::unique_ptr<Tree> tree_;
};

}  // namespace droplet
