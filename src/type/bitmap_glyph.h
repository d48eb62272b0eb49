// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/vector.h"
#include "type/contour_union.h"

struct FT_GlyphSlotRec_;

namespace droplet {

/// Opacity of the pixels of a glyph.
struct GlyphBitmap {
    int width = 0;                     ///< [px]
    int height = 0;                    ///< [px]
    std::vector<std::uint16_t> alpha;  ///< row by row from the top left; 65535 opaque
    Vec2 middle;                       ///< from the glyph's origin [px], y up
};

/// Copies the bitmap of a loaded glyph; without pixels if the glyph has none, or of a kind that is not read.
GlyphBitmap bitmapOf(const FT_GlyphSlotRec_& slot);

/// Traces what is opaque: the outlines of a bitmap in ems, as a mask is traced.
/// @param pixel  edge of a pixel [em]
std::vector<Contour> tracedContours(const GlyphBitmap& bitmap, double pixel);

}  // namespace droplet
