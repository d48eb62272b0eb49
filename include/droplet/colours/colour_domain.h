// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/colours/colour_regions.h"
#include "droplet/domain/domain.h"
#include "droplet/outline/outline.h"

namespace droplet {

/// Options of traceColours().
struct ColourTraceOptions {
    TraceOptions trace = {};          ///< size, speck_size and corners; the rest only with a gap, and not clean
    double gap = 0.0;                 ///< dry width between neighbours [m], ≥ 0
    std::optional<double> edge = {};  ///< longest edge of the boundary between neighbours [m], > 0, as of the triangles
                                      ///< that will stand on it; empty: every traced point is kept

    /// @throws Error InvalidArgument if a value is out of its range
    void validate() const;
};

/// Footprints of a picture's regions of one colour.
struct ColourDomain {
    Domain domain;                    ///< by colour, in the order of the palette; then by their place in the picture
    std::vector<std::size_t> colour;  ///< of every droplet: index in the palette
    std::vector<std::size_t> lost;   ///< colours without a droplet, because all their regions are too small for the gap
    double pixel_size = 0.0;         ///< as in Outline [m]
    bool anti_aliased = false;       ///< as in Outline
    std::size_t specks_dropped = 0;  ///< regions smaller than the speck size; they became part of a neighbour
    double largest_speck_px = 0.0;   ///< area of the largest of them [px²]
};

/// Edge of a pixel [m], from the size in the options.
double pixelSize(const ColourRegions& regions, const TraceOptions& options);

/// Traces the rims of all regions to a fraction of a pixel.
///
/// The boundary of two neighbours is traced and faired once, from junction to junction, and is part of both footprints:
/// their points are equal bit for bit, so neither a gap nor an overlap is between them. These points, and junctions,
/// are corners, so that triangulate() keeps them in place. With a gap, footprints end at half of it from the boundary.
/// Pixels of a colour that touch at a corner are connected; of two such pairs the rarer colour's is.
/// @param regions  as from decodeColours
/// @param options  size, gap, length of edges
/// @throws Error   InvalidArgument for options; InvalidInput if only specks are in the picture, all regions are too
/// small
///                 for the gap, or all borders together are longer than 3·2²⁰ sides of pixels
ColourDomain traceColours(const ColourRegions& regions, const ColourTraceOptions& options = {});

}  // namespace droplet
