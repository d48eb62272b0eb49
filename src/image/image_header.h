// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace droplet {

enum class ImageFormat { Png, Jpeg, Svg, Bmp, Tiff, Webp, Pnm, Jpeg2000, OpenExr, RadianceHdr };

/// The name a format has in messages.
const char* name(ImageFormat format);

/// What a file says of itself, read without a codec and without memory.
struct ImageHeader {
    ImageFormat format = ImageFormat::Png;
    int width = 0;              ///< [px] ≥ 1, as stored
    int height = 0;             ///< [px] ≥ 1
    int orientation = 1;        ///< 1 … 8, from EXIF or TIFF; 1 is upright
    bool keeps_colour = false;  ///< wanted of the decoder, beside luma
};

/// The format that the first bytes of a file announce; 16 bytes are enough, but for SVG, which may begin with comments
/// and then takes up to 64 KiB. Compressed data count as SVG.
std::optional<ImageFormat> imageFormat(std::span<const std::byte> encoded);

/// The same, of what must be an image.
/// @throws Error InvalidInput: unknown format
ImageFormat knownFormat(std::span<const std::byte> encoded);

/// Of a PNG or JPEG.
/// @throws Error InvalidInput: header cut short, no size or more than max_pixels
ImageHeader readImageHeader(std::span<const std::byte> encoded, ImageFormat format, std::size_t max_pixels);

/// @throws Error InvalidInput: more pixels than that
void checkSize(ImageFormat format, std::uint64_t width, std::uint64_t height, std::size_t max_pixels);

/// 1 … 8, from the EXIF block of a WebP.
int webpOrientation(std::span<const std::byte> encoded);

/// Level of white of a PBM (255, as it is decoded), PGM or PPM; none where its header is damaged.
std::optional<std::uint64_t> pnmWhite(std::span<const std::byte> encoded);

/// First value of a field in the first directory of a TIFF file (or EXIF block), classic or BigTIFF; none of a field of
/// other than unsigned integers.
std::optional<std::uint64_t> tiffField(std::span<const std::byte> tiff, std::uint16_t tag);

}  // namespace droplet
