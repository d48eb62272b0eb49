// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "droplet/surface/surface.h"
#include "droplet/surface/textured_mesh.h"

namespace droplet {

/// The picture that is laid on an object.
struct OntoOptions {
    Vec2 extent;  ///< physical size of the picture [m], as lofted with: it fills uv from (0,0) to (1,1); both > 0

    /// @throws Error InvalidArgument
    void validate() const;
};

/// What became of the droplets.
struct OntoReport {
    std::size_t laid = 0;
    std::size_t outside = 0;             ///< left out: part of it lies on no chart
    std::size_t across = 0;              ///< left out: crosses from one chart to another
    std::size_t folded = 0;              ///< left out: the object is more sharply hollow there than the droplet is thin
    std::size_t mirrored = 0;            ///< of those laid, on charts that show the picture mirrored
    std::size_t flipped_charts = 0;      ///< such charts with a droplet
    std::size_t overlapping_charts = 0;  ///< charts that claim places of droplets laid on a chart before them
    double min_scale = 0.0;              ///< of object to picture, in length, over the droplets laid
    double max_scale = 0.0;
    std::vector<std::string> warnings;  ///< the above in words, a line each; empty when all is well
};

/// Droplets on an object.
struct OntoResult {
    Surface surface;  ///< in the object's coordinates, without the object; uv as before
    OntoReport report;
};

/// Lays droplets solved on the plane onto an object, as a texture is mapped through its uv (thesis 4.2.5): a point at
/// height z over the picture's point uv comes to X(uv) + s(uv)·z·n(uv), X being the object, n its smooth normal and s
/// its local stretch, the length on it per length in the picture.
///
/// A chart is what of the object hangs together in uv and faces one way there. n and s are interpolated between the
/// vertices of a chart, where they are means of what meets there, so neither jumps from triangle to triangle; s is √ of
/// area over area, the geometric mean where the picture is stretched more one way than the other. Normals are those
/// of the map, by its derivatives averaged alike. A droplet goes onto the first chart, in the file's order, that has
/// all its vertices, and otherwise is left out whole; it is not wrapped from u = 1 to u = 0, and no chart repeats
/// beyond (0,0) to (1,1). On mirrored charts triangles are turned, so that they wind outward.
///
/// Guarantees: topology as before; every vertex at z = 0 lies on a triangle of the object, or within 1e-7 of the
/// picture's size. Between vertices a base cuts the object's corners, by at most ℓθ/4 where facets meet at an angle θ
/// and its edges are ℓ long: give droplets a base with the liquid's own triangles, as loft makes on curved ground.
/// @param droplets  valid; z = 0 the ground, uv those of the picture
/// @param object    valid
/// @param options   extent of the picture
/// @throws Error    InvalidArgument; InvalidInput if no triangle of the object has an area in uv; NoSuchDroplet if none
///                  of the droplets can be laid
OntoResult layOnto(const Surface& droplets, const TexturedMesh& object, const OntoOptions& options);

/// Length on the object per unit of uv: √(area / area in uv), the median by area, so that a lid unwrapped small does
/// not count against a wall. A picture of aspect a = width/height has the object's own size if it is √a times as wide
/// [m].
/// @param object  valid
/// @throws Error  InvalidInput if no triangle has an area in uv
double metresPerUv(const TexturedMesh& object);

}  // namespace droplet
