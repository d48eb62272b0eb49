// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/mask/clean.h"
#include "droplet/mask/mask.h"
#include "droplet/vector.h"

namespace droplet {

/// Closed polyline with liquid on its left: outer loops run counter-clockwise, holes clockwise.
/// Invariant: at least three points, the first not repeated at the end, no two consecutive points equal; `corner.size()
/// == points.size()`.
struct Loop {
    std::vector<Vec2> points;          ///< [m], y up
    std::vector<std::uint8_t> corner;  ///< 1 where the curve turns sharply and must stay sharp
};

/// Signed area that a loop encloses [m²]; positive if the loop runs counter-clockwise.
double signedArea(const Loop& loop);

/// All rims of a mask.
///
/// Origin at the centre of the image, x to the right, y up. Guarantees for every mask: loops do not cross or touch one
/// another or themselves.
struct Outline {
    std::vector<Loop> loops;         ///< rims of droplets and of holes
    Vec2 extent;                     ///< physical width and height of the whole image [m]
    double pixel_size = 0.0;         ///< edge of a pixel [m]
    bool anti_aliased = false;       ///< whether the rim's sub-pixel place comes from grey levels
    std::size_t specks_dropped = 0;  ///< number of dropped loops, liquid or dry, smaller than the speck size
    double largest_speck_px = 0.0;   ///< area of the largest dropped loop [px²]
};

/// Options of trace().
struct TraceOptions {
    double threshold = 0.5;            ///< coverage at which liquid begins, in (0, 1)
    double width = 20e-3;              ///< physical width of the image [m], > 0; ignored if pixel_size is set
    std::optional<double> pixel_size;  ///< edge of a pixel of the image's file [m], > 0; for SVG, of a CSS px
    double speck_size = 3.0;           ///< area below which loops are dropped [px²], ≥ 0
    bool corners = true;               ///< keep sharp corners sharp; if false, the whole rim is faired
    CleanOptions clean = {};           ///< changes made to the mask first
    bool allow_dry = false;            ///< a mask without liquid gives an outline without loops instead of an error

    /// @throws Error InvalidArgument if a value is out of its range
    void validate() const;
};

/// Edge of a pixel of the mask [m], from the size in the options.
double pixelSize(const Mask& mask, const TraceOptions& options);

/// Traces the rims of a mask to a fraction of a pixel.
///
/// The curve crosses every grid edge between a liquid and a dry pixel centre once, and no other edge. So its topology
/// is that of the mask, where liquid is 8-connected (pixels that touch at a corner are one droplet) and dry is
/// 4-connected. The one exception: the tip of a corner may enclose the centre of the pixel it stands in. In
/// anti-aliased masks, coverage gives the place of each crossing. In hard masks, the curve is the fairest one that
/// separates the same pixel centres. Time and memory are linear in the number of pixels.
/// @param mask     valid
/// @param options  threshold, physical size, speck size
/// @throws Error   InvalidArgument for options; InvalidInput if the mask holds no liquid or only specks, unless
///                 allow_dry; InvalidInput if a border is longer than 2²¹ sides of pixels, or all borders together are
///                 longer than 3·2²⁰
Outline trace(const Mask& mask, const TraceOptions& options = {});

}  // namespace droplet
