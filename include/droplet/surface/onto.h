// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "droplet/surface/surface.h"
#include "droplet/surface/textured_mesh.h"

namespace droplet {

/// Options of placeOnto().
struct OntoOptions {
    Vec2 extent;  ///< size of the picture [m], as for loft(): it fills uv from (0,0) to (1,1); both > 0
    /// Whether the object is there, at a uv of one of its triangles; no droplet lies where it is not, as at a hole that
    /// the alpha of a texture cuts. Called from several threads. Empty: it is there everywhere
    std::function<bool(std::uint32_t triangle, Vec2 uv)> is_there = {};

    /// Checks the extent.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// Counts of droplets and charts, and scales.
struct OntoReport {
    std::size_t laid = 0;                ///< droplets on the object
    std::size_t outside = 0;             ///< droplets left out because a part lies beside all charts
    std::size_t across = 0;              ///< droplets left out because they cross from one chart to another
    std::size_t folded = 0;              ///< droplets left out because they are too high for the hollow below them
    std::size_t cut_out = 0;             ///< droplets left out because a part of the object below them is cut out
    std::size_t mirrored = 0;            ///< droplets on the object, on charts that mirror the picture
    std::size_t flipped_charts = 0;      ///< charts that mirror the picture and have droplets
    std::size_t overlapping_charts = 0;  ///< charts whose uv contain points of a droplet on an earlier chart
    double min_scale = 0.0;              ///< smallest length on the object per length in the picture, at a droplet
    double max_scale = 0.0;              ///< largest such ratio
    std::vector<std::string> warnings;   ///< one line each
};

/// Droplets on an object.
struct OntoResult {
    Surface surface;    ///< droplets in the object's coordinates, without the object; uv do not change
    OntoReport report;  ///< counts and scales
};

/// Maps droplets that were solved on the plane onto an object, through the uv of its texture (thesis 4.2.5).
///
/// A point at height z over the point uv of the picture moves to X(uv) + s(uv)·z·n(uv). X is the object, n its smooth
/// normal, and s its local stretch: length on the object per length in the picture, √ of the ratio of areas. A chart is
/// a part of the object that is connected in uv and faces one way there. n and s are means at the vertices of a chart
/// and interpolated between them, so they are continuous. Normals are those of the map, from derivatives averaged in
/// the same way. A droplet is placed on the first chart, in the file's order, that contains all its vertices; otherwise
/// it is left out as a whole, and so it is where a part of the object below a vertex is cut out. It does not wrap from
/// u = 1 to u = 0, and charts do not repeat beyond (0,0) to (1,1). On charts that mirror the picture, triangles are
/// reversed so that they wind outward.
///
/// Guarantees: topology does not change; every vertex at z = 0 lies on a triangle of the object, to 1e-7 of the
/// picture's size. Between its vertices a base leaves the object by at most ℓθ/4, where facets meet at an angle θ and
/// edges of the base are ℓ long. A base with the triangles of the liquid, as loft() makes it on curved ground, keeps
/// this small.
/// @param droplets  valid; z = 0 is the ground, uv are those of the picture
/// @param object    valid
/// @param options   extent of the picture
/// @throws Error    InvalidArgument; InvalidInput: no triangle of the object has an area in uv; NoSuchDroplet: all
///                  droplets are left out
OntoResult placeOnto(const Surface& droplets, const TexturedMesh& object, const OntoOptions& options);

/// Measures the length on the object per unit of uv [m]: √(area / area in uv), the median weighted by area, so that a
/// lid unwrapped small does not count as much as a wall. A picture with the aspect a = width/height has the size of the
/// object's texture if it is √a times this length wide.
/// @param object  valid
/// @throws Error  InvalidInput: no triangle has an area in uv
double metresPerUv(const TexturedMesh& object);

}  // namespace droplet
