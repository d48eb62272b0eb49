// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "image/image.h"
#include "image/image_header.h"

namespace droplet {

// One decoder per format. Each gets a file whose header has been read and whose size has been checked, and returns the
// image as stored (not yet upright). It throws Error InvalidInput if the file is damaged, cut short, unsupported, or of
// another size than its header says. It does not print and keeps no state.
//
// PNG and JPEG, the formats of nearly all masks, are read with their own libraries. cv::imdecode (OpenCV 4.6) accepts
// JPEGs cut in half, needs the whole image as BGRA, and loads 139 shared libraries.

Image decodePng(std::span<const std::byte> encoded, const ImageHeader& header);
Image decodeJpeg(std::span<const std::byte> encoded, const ImageHeader& header);

/// Draws a vector image. Nothing that it refers to is read.
/// @throws Error InvalidInput: damaged, a page without area, beyond the limits of librsvg or of the options; librsvg or
///               the program that draws with it is not installed
Image decodeSvg(std::span<const std::byte> encoded, const DecodeOptions& options);

/// Decodes the picture of a BMP.
Image decodeBmp(std::span<const std::byte> encoded, const DecodeOptions& options);
/// Decodes the first picture of a GIF.
Image decodeGif(std::span<const std::byte> encoded, const DecodeOptions& options);
/// Decodes the largest picture of an icon or cursor.
Image decodeIco(std::span<const std::byte> encoded, const DecodeOptions& options);
/// Decodes a TGA.
Image decodeTga(std::span<const std::byte> encoded, const DecodeOptions& options);

/// First picture of an animation, as a WebP of its own, and its place.
struct WebpFrame {
    std::vector<std::byte> file;
    PicturePlace canvas;
};

/// First picture of a WebP animation; none of another WebP.
std::optional<WebpFrame> firstWebpFrame(std::span<const std::byte> encoded);

/// Decodes a TIFF, WebP, PBM, PGM, PPM, JPEG 2000, OpenEXR or Radiance HDR, upright, by OpenCV. Its size is
/// checked before memory for its pixels is allocated. Floating-point samples are levels clipped to [0, 1].
/// @throws Error InvalidInput: too large, damaged, unsupported; OpenCV is not installed
Image decodeWithOpenCv(std::span<const std::byte> encoded, ImageFormat format, const DecodeOptions& options);

/// Decodes the same formats with unchanged floating-point samples, colours as their luma; none if samples are integers.
std::optional<FloatImage> decodeFloatsWithOpenCv(std::span<const std::byte> encoded, ImageFormat format,
                                                 std::size_t max_pixels, bool keeps_colour);

}  // namespace droplet
