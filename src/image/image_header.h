// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace droplet {

enum class ImageFormat { Png, Jpeg, Bmp, Tiff, Webp, Pnm, Svg };

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

/// Of any format but SVG, whose size is known to librsvg alone.
/// @throws Error InvalidInput: unknown format, header cut short, no size or more than max_pixels
ImageHeader readImageHeader(std::span<const std::byte> encoded, std::size_t max_pixels);

/// First value of a field in the first directory of a TIFF file (or EXIF block), classic or BigTIFF.
/// Of a field with several values only the presence means something.
std::optional<std::uint64_t> tiffField(std::span<const std::byte> tiff, std::uint16_t tag);

/// The header of a PBM, PGM or PPM.
struct PnmHeader {
    int kind = 1;  ///< the digit after P: 1 … 6
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    std::uint32_t maximum = 1;  ///< level of white, 1 … 65535
    std::size_t payload = 0;    ///< where the pixels begin
};

/// @throws Error InvalidInput
PnmHeader readPnmHeader(std::span<const std::byte> encoded);

}  // namespace droplet
