// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace droplet {

enum class ImageFormat { Png, Jpeg, Svg, Bmp, Gif, Ico, Tga, Tiff, Webp, Pnm, Jpeg2000, OpenExr, RadianceHdr };

/// Name of a format in messages.
const char* name(ImageFormat format);

/// Properties of an image, read from its file without a codec and without memory.
struct ImageHeader {
    ImageFormat format = ImageFormat::Png;
    int width = 0;              ///< [px] ≥ 1, as stored
    int height = 0;             ///< [px] ≥ 1
    int orientation = 1;        ///< 1 … 8, from EXIF or TIFF; 1 is upright
    bool keeps_colour = false;  ///< request to the decoder: keep colour beside luma
};

/// Format of a file by its first bytes. 18 bytes are enough, except for SVG, which may begin with comments of up to 64
/// KiB. Compressed data count as SVG.
std::optional<ImageFormat> imageFormat(std::span<const std::byte> encoded);

/// Format of a file that must be an image.
/// @throws Error InvalidInput: unknown format
ImageFormat knownFormat(std::span<const std::byte> encoded);

/// Reads the header of a PNG or JPEG.
/// @throws Error InvalidInput: header cut short, no size, or more than max_pixels
ImageHeader readImageHeader(std::span<const std::byte> encoded, ImageFormat format, std::size_t max_pixels);

/// Checks the size of an image.
/// @throws Error InvalidInput: more than max_pixels
void checkSize(ImageFormat format, std::uint64_t width, std::uint64_t height, std::size_t max_pixels);

/// Orientation from the EXIF block of a WebP, 1 … 8.
int webpOrientation(std::span<const std::byte> encoded);

/// Level of white in the samples that OpenCV 4.6 returns for a PBM, PGM or PPM; 0 if it is the largest value of 8 or 16
/// bits.
std::uint32_t pnmWhite(std::span<const std::byte> encoded);

/// First value of a field in the first directory of a TIFF file (or EXIF block), classic or BigTIFF; none if the field
/// does not hold unsigned integers.
std::optional<std::uint64_t> tiffField(std::span<const std::byte> tiff, std::uint16_t tag);

}  // namespace droplet
