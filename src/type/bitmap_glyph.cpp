// SPDX-License-Identifier: GPL-3.0-or-later
//
// Glyphs of colour fonts that are pictures (table CBDT). Their opacity is traced like that of any picture.

#include "type/bitmap_glyph.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <utility>

#include "droplet/mask/mask.h"
#include "droplet/outline/outline.h"
#include "type/text_layout.h"

namespace droplet {

GlyphBitmap bitmapOf(const FT_GlyphSlotRec_& slot)
{
    constexpr unsigned kMaxSide = 4096;  // only damaged data exceed it
    const FT_Bitmap& from = slot.bitmap;
    const bool is_known = from.pixel_mode == FT_PIXEL_MODE_BGRA || from.pixel_mode == FT_PIXEL_MODE_GRAY;
    if (!is_known || from.buffer == nullptr || from.width == 0 || from.rows == 0 || from.width > kMaxSide ||
        from.rows > kMaxSide) {
        return {};
    }
    GlyphBitmap bitmap;
    bitmap.width = static_cast<int>(from.width);
    bitmap.height = static_cast<int>(from.rows);
    bitmap.middle = {slot.bitmap_left + 0.5 * bitmap.width, slot.bitmap_top - 0.5 * bitmap.height};
    bitmap.alpha.reserve(std::size_t{from.width} * from.rows);
    const std::ptrdiff_t step = from.pixel_mode == FT_PIXEL_MODE_BGRA ? 4 : 1;
    for (std::ptrdiff_t y = 0; y < bitmap.height; ++y) {
        const unsigned char* const row = from.buffer + y * from.pitch;
        for (std::ptrdiff_t x = 0; x < bitmap.width; ++x) {
            bitmap.alpha.push_back(static_cast<std::uint16_t>(257 * row[step * x + step - 1]));
        }
    }
    return bitmap;
}

std::vector<Contour> tracedContours(const GlyphBitmap& bitmap, double pixel)
{
    if (bitmap.alpha.empty()) {
        return {};
    }
    Mask mask;
    mask.width = bitmap.width;
    mask.height = bitmap.height;
    mask.coverage = bitmap.alpha;
    TraceOptions options;
    options.pixel_size = pixel;
    options.allow_dry = true;
    std::vector<Contour> contours;
    for (Loop& loop : trace(mask, options).loops) {
        contours.push_back(moved(std::move(loop.points), pixel * bitmap.middle));
    }
    return contours;
}

}  // namespace droplet
