// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "image/image.h"
#include "image/image_header.h"

namespace droplet {

// One decoder a format. Each takes a file whose header has been read and found small enough, gives the image
// as stored (not yet upright), and throws Error InvalidInput for one that is damaged, cut short, of another
// size than its header said, or of a kind not read. None prints; none keeps state.
//
// PNG and JPEG, which nearly all masks are, are read with the codecs' own libraries: cv::imdecode (OpenCV 4.6) accepts
// JPEGs cut in half, needs the whole image as BGRA, and brings 139 shared libraries.

Image decodePng(std::span<const std::byte> encoded, const ImageHeader& header);
Image decodeJpeg(std::span<const std::byte> encoded, const ImageHeader& header);

/// Draws a vector image, which has no pixels of its own. Nothing it refers to is read.
/// @throws Error InvalidInput: damaged, a page without area, more than librsvg can take or the options admit; the
/// program
///               that draws, or librsvg, is not installed
Image decodeSvg(std::span<const std::byte> encoded, const DecodeOptions& options);

/// Decodes a TIFF, WebP, BMP, PBM, PGM, PPM, JPEG 2000, OpenEXR or Radiance HDR, upright, by OpenCV. Its size is
/// checked before memory for its pixels is taken. Floating-point samples are levels of 0 to 1, what lies beyond is cut
/// off.
/// @throws Error InvalidInput: too large, damaged, of a kind not read; OpenCV is not installed
Image decodeWithOpenCv(std::span<const std::byte> encoded, ImageFormat format, const DecodeOptions& options);

/// The same of floating-point samples as they are, colours by their luma; none if they are integers.
std::optional<FloatImage> decodeFloatsWithOpenCv(std::span<const std::byte> encoded, ImageFormat format,
                                                 std::size_t max_pixels, bool keeps_colour);

}  // namespace droplet
