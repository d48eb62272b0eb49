// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// How exactly two surfaces are compared.
struct CompareOptions {
    /// The bounds of a largest distance are narrowed until they differ by less than this share of the upper one, in
    /// (0, 1).
    double share = 0.01;
    /// They are narrowed further until it is certain whether the distance is over this [m], ≥ 0.
    std::optional<double> tolerance = {};
    /// Pieces of triangles each search may look at before it leaves its bounds as they are, which are bounds still.
    std::size_t max_pieces = std::size_t{1} << 22;
};

/// How far the points of one surface lie from the other.
struct SurfaceDistance {
    double lower = 0.0;  ///< of the largest distance [m]: that of the point `at`
    double upper = 0.0;  ///< of the largest distance [m]: no point of the surface is farther
    Vec3 at;             ///< [m]
    Vec3 nearest;        ///< on the other surface [m]
    double mean = 0.0;   ///< by area [m]
    double rms = 0.0;    ///< by area [m]
};

/// Angles between normals of one surface and those of the other at the nearest points.
struct NormalDeviation {
    double largest = 0.0;  ///< of all points looked at [rad]
    double rms = 0.0;      ///< by area [rad]
    Vec3 at;               ///< where the largest is [m]
};

/// Contact angles along a surface's rim.
struct ContactAngleRange {
    double min = 0.0;   ///< [rad]
    double mean = 0.0;  ///< along the rim [rad]
    double max = 0.0;   ///< [rad]
};

/// What a surface measures by itself.
struct SurfaceMeasures {
    std::size_t vertices = 0;  ///< copies of a place counted one by one
    std::size_t triangles = 0;
    Vec3 lowest;          ///< corner of the box around all triangles [m]
    Vec3 highest;         ///< its opposite corner [m]
    double area = 0.0;    ///< [m²]
    double volume = 0.0;  ///< as enclosedVolume [m³]
    Topology topology;
    std::optional<ContactAngleRange> contact_angle;  ///< where the surface has angles that are not 0
};

/// Two surfaces side by side.
struct Comparison {
    SurfaceMeasures a;
    SurfaceMeasures b;
    SurfaceDistance from_a;     ///< of the points of a from b
    SurfaceDistance from_b;     ///< of the points of b from a
    SurfaceDistance symmetric;  ///< the larger largest distance; mean and rms over both surfaces' area
    NormalDeviation normals_of_a;
    NormalDeviation normals_of_b;
    NormalDeviation normals;  ///< the larger largest angle; rms over both surfaces' area
    bool same_topology = false;

    /// Volume of b less that of a, over the volume of a; nothing where a has none.
    [[nodiscard]] std::optional<double> relativeVolume() const;
};

/// Compares two surfaces as sets of points, however they are triangulated.
///
/// The largest distance of a surface's points from the other is bounded from both sides over all of its points, not
/// over vertices or samples: what is thinner than any sampling is found (Tang, Lee and Kim 2009). Means are by
/// quadrature of degree 4 on every triangle, triangles longer than 1/25 of the bounding box being cut.
///
/// Normals are those between the vertices' ones. They are compared with the other surface's at the nearest point of
/// its triangles that face the same way, if there is one no farther than twice the largest distance, else of all;
/// where triangles meet at that point, with the nearest of their normals. So a crisp rim, which has two normals at
/// every place, differs from itself by nothing, and a thin edge's upper side is not compared with its lower one.
///
/// Guarantees: compare(b, a) is compare(a, b) with a and b exchanged; the same bits at any number of threads; distances
/// are exact up to 1e-12 of the size of the box around both, and round-off of the coordinates. Triangles without area
/// count for the largest distance, not for means and normals.
/// @throws Error InvalidArgument for invalid surfaces and options
Comparison compare(const Surface& a, const Surface& b, const CompareOptions& options = {});

/// The distance of every vertex of a from b, negative where it is on the inner side of b [m].
///
/// The side is that of the normals of all triangles around the nearest point, weighted by their angles there
/// (Bærentzen and Aanæs 2005): for closed surfaces inner is inside.
/// @throws Error InvalidArgument for invalid surfaces
std::vector<double> signedDistances(const Surface& a, const Surface& b);

}  // namespace droplet
