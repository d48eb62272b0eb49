// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "droplet/liquid2d/fluid_scene.h"

namespace droplet {

/// Whether a region contains a point.
bool contains(const Region& region, Vec2 point);

/// Interior of a region, for many points.
class Interior {
public:
    explicit Interior(const Region& region);

    /// As contains(), in time that does not grow with the number of sides.
    [[nodiscard]] bool contains(Vec2 point) const;

private:
    struct Side {
        Vec2 a;
        Vec2 b;
    };
    [[nodiscard]] std::size_t strip(double y) const;

    std::vector<Side> sides_;
    double low_ = 1e300;
    double high_ = -1e300;
    std::vector<std::vector<std::uint32_t>> strips_;  ///< sides that meet each strip of equal height
};

/// Signed area of a region's loops and the centroid of the region.
struct RegionMoments {
    double area = 0.0;  ///< [m²], ≥ 0
    Vec2 centroid;      ///< [m]
};

/// Area and centroid, by the even-odd rule.
RegionMoments momentsOf(const Region& region);

/// Part of a lattice.
struct LatticePart {
    double spacing = 0.0;  ///< the lattice has one point per spacing² [m]
    Vec2 lower;            ///< corners of the box that holds the part [m]
    Vec2 upper;
};

/// Calls visit(point) for the points of latticeIn() in a box; the rest of the region costs nothing.
void visitLattice(const Region& region, const LatticePart& part, const std::function<void(Vec2)>& visit);

/// Likewise for points in rings about the middle of a disc within the box, one per spacing²: a regular polygon of many
/// corners. Other regions have those of the lattice.
void visitRings(const Region& region, const LatticePart& part, const std::function<void(Vec2)>& visit);

/// Points of the hexagonal lattice with one point per spacing² that lie in a region. The lowest row is half a row above
/// the region's lowest point.
std::vector<Vec2> latticeIn(const Region& region, double spacing);

/// Whether the solid of a loop's region lies on the loop's left.
bool isInsideOnLeft(const Region& region, const std::vector<Vec2>& loop);

}  // namespace droplet
