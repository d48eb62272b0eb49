// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/footprint/clean.h"
#include "droplet/footprint/mask.h"
#include "droplet/vector.h"

namespace droplet {

/// A closed curve of straight pieces, liquid on its left (outer loops run counter-clockwise, holes clockwise).
/// Invariant: at least three points, the first not repeated at the end, no two consecutive points equal;
/// `corner.size() == points.size()`.
struct Loop {
    std::vector<Vec2> points;          ///< [m], y up
    std::vector<std::uint8_t> corner;  ///< 1 where the curve turns sharply and must stay crisp
};

/// Signed area enclosed by a loop, positive when it runs counter-clockwise [m²].
double signedArea(const Loop& loop);

/// The rims of everything liquid in a mask, in metres.
///
/// Origin at the centre of the image, x to the right, y up. Guarantees: loops do not cross or touch one
/// another or themselves, whatever the mask.
struct Outline {
    std::vector<Loop> loops;
    Vec2 extent;                     ///< physical width and height of the whole image [m]
    double pixel_size = 0.0;         ///< edge of a pixel [m]
    bool anti_aliased = false;       ///< whether grey levels gave the sub-pixel place of the rim
    std::size_t specks_dropped = 0;  ///< liquid or dry loops smaller than the speck size
    double largest_speck_px = 0.0;   ///< area of the largest loop dropped [px²]
};

/// How a mask becomes an outline.
struct TraceOptions {
    double threshold = 0.5;            ///< coverage at which liquid begins, in (0, 1)
    double width = 20e-3;              ///< physical width of the image [m], > 0; ignored if pixel_size is set
    std::optional<double> pixel_size;  ///< edge of a pixel of the image's file [m], > 0; of SVG a CSS px
    double speck_size = 3.0;           ///< loops that enclose less than this are dropped [px²], ≥ 0
    bool corners = true;               ///< keep sharp corners sharp; otherwise everything is faired
    CleanOptions clean = {};           ///< what is done to the mask first
    bool may_be_dry = false;           ///< without liquid: an outline without loops, not an error

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Edge of a pixel of the mask, as the options size the image [m].
double pixelSize(const Mask& mask, const TraceOptions& options);

/// Traces the rims of the liquid in a mask, to a fraction of a pixel.
///
/// The curve crosses every grid edge between a liquid and a dry pixel centre once and no other, so its topology is that
/// of the mask: liquid is 8-connected (pixels that touch at a corner are one droplet), dry 4-connected. Only the tip of
/// a corner may take in the centre of the one pixel it stands in. Anti-aliased masks place the crossing by the coverage
/// itself; for hard ones the curve is the fairest that separates the same pixel centres. Time and memory are linear in
/// the number of pixels.
/// @param mask     valid
/// @param options  threshold, physical size, speck size
/// @throws Error   InvalidArgument for options; InvalidInput if the mask holds no liquid, or specks only, unless it may
///                 be dry, or if one of its borders is longer than 2²¹ sides of
///                 pixels, or all are longer than 3·2²⁰
Outline trace(const Mask& mask, const TraceOptions& options = {});

}  // namespace droplet
