// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Options of compare().
struct CompareOptions {
    /// Largest difference of both bounds of a distance, as a share of the upper one, in (0, 1).
    double share = 0.01;
    /// Distance tolerance [m], ≥ 0: the bounds are narrowed until both are on one side of it.
    std::optional<double> tolerance = {};
    /// Largest number of pieces of triangles per search. A search that reaches it returns the bounds it has; they hold.
    std::size_t max_pieces = std::size_t{1} << 22;
};

/// Distance of the points of one surface from the other.
struct SurfaceDistance {
    double lower = 0.0;  ///< lower bound of the largest distance [m]: the distance of `at`
    double upper = 0.0;  ///< upper bound of the largest distance [m]
    Vec3 at;             ///< farthest point found [m]
    Vec3 nearest;        ///< point of the other surface nearest to it [m]
    double mean = 0.0;   ///< mean distance by area [m]
    double rms = 0.0;    ///< root mean square distance by area [m]
};

/// Angles between the normals of one surface and those of the other at the nearest points.
struct NormalDeviation {
    double largest = 0.0;  ///< largest angle at a quadrature point [rad]
    double rms = 0.0;      ///< root mean square by area [rad]
    Vec3 at;               ///< point of the largest angle [m]
};

/// Contact angles along a surface's rim.
struct ContactAngleRange {
    double min = 0.0;   ///< smallest angle [rad]
    double mean = 0.0;  ///< mean by rim length [rad]
    double max = 0.0;   ///< largest angle [rad]
};

/// Figures of one surface.
struct SurfaceMeasures {
    std::size_t vertices = 0;                        ///< number of vertices, with all copies
    std::size_t triangles = 0;                       ///< number of triangles
    Vec3 lowest;                                     ///< lower corner of the bounding box [m]
    Vec3 highest;                                    ///< upper corner of the bounding box [m]
    double area = 0.0;                               ///< area of all triangles [m²]
    double volume = 0.0;                             ///< volume by enclosedVolume() [m³]
    Topology topology;                               ///< with copies of a vertex welded
    std::optional<ContactAngleRange> contact_angle;  ///< empty if the surface has no angles
};

/// Result of comparing two surfaces.
struct Comparison {
    SurfaceMeasures a;             ///< figures of the first surface
    SurfaceMeasures b;             ///< figures of the second surface
    SurfaceDistance from_a;        ///< distance of the points of a from b
    SurfaceDistance from_b;        ///< distance of the points of b from a
    SurfaceDistance symmetric;     ///< the larger of both distances; mean and rms over both areas
    NormalDeviation normals_of_a;  ///< angles at the points of a
    NormalDeviation normals_of_b;  ///< angles at the points of b
    NormalDeviation normals;       ///< the larger of both angles; rms over both areas
    bool same_topology = false;    ///< whether all members of both topologies are equal

    /// Difference of the volumes, (b − a)/a; empty if a has no volume.
    [[nodiscard]] std::optional<double> relativeVolume() const;
};

/// Compares two surfaces as sets of points; their triangulations do not matter.
///
/// The bounds of the largest distance hold for all points of a surface, not only for vertices or samples, so it finds
/// features thinner than any sampling (Tang, Lee and Kim 2009). Means are by quadrature of degree 4 on every triangle;
/// triangles longer than 1/25 of the bounding box are cut first.
///
/// Normals are interpolated between vertices. They are compared at the nearest point of those triangles of the other
/// surface that face the same way, or of all triangles if that point is farther than twice the largest distance. If
/// several triangles meet at that point, the most similar normal is taken. So a rim with two normals at every point has
/// no deviation from itself, and the upper side of a thin edge is not compared with its lower side.
///
/// Guarantees: compare(b, a) is compare(a, b) with a and b exchanged; the same bits at any number of threads; distances
/// are exact to 1e-12 of the size of the box around both, and round-off of the coordinates. Triangles without area
/// count for the largest distance, but not for means and normals.
/// @throws Error InvalidArgument: invalid surfaces or options
Comparison compare(const Surface& a, const Surface& b, const CompareOptions& options = {});

/// Measures the distance of every vertex of a from b [m]; negative on the inner side of b.
///
/// The normals of all triangles at the nearest point, weighted by their angles there, decide the side (Bærentzen and
/// Aanæs 2005). The inner side of a closed surface is its inside.
/// @throws Error InvalidArgument: invalid surfaces
std::vector<double> signedDistances(const Surface& a, const Surface& b);

}  // namespace droplet
