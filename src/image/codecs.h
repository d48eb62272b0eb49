// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "image/image.h"
#include "image/image_header.h"

namespace droplet {

// One decoder a format. Each takes a file whose header has been read and found small enough, gives the image
// as stored (not yet upright), and throws Error InvalidInput for one that is damaged, cut short, of another
// size than its header said, or of a kind not read. None prints; none keeps state.
//
// The codecs' own libraries are used rather than cv::imdecode, which (OpenCV 4.6) writes to stderr whatever a
// broken file provokes, accepts JPEGs cut in half, drops the alpha of grey TIFFs and of BMPs, ignores a TIFF
// palette that is missing, needs the whole image as BGRA, and brings 120 shared libraries (GDAL) to every start.

Image decodePng(std::span<const std::byte> encoded, const ImageHeader& header);
Image decodeJpeg(std::span<const std::byte> encoded, const ImageHeader& header);
Image decodeBmp(std::span<const std::byte> encoded, const ImageHeader& header);
Image decodeTiff(std::span<const std::byte> encoded, const ImageHeader& header);
Image decodeWebp(std::span<const std::byte> encoded, const ImageHeader& header);
Image decodePnm(std::span<const std::byte> encoded, const ImageHeader& header);

/// Draws a vector image, which has no pixels of its own. Nothing it refers to is read.
/// @throws Error InvalidInput: damaged, a page without area, more than librsvg or its stack can take
Image decodeSvg(std::span<const std::byte> encoded, const DecodeOptions& options);

/// Whether the samples of a TIFF are floating-point numbers, and one a pixel.
bool isFloatTiff(std::span<const std::byte> encoded);

/// Of one sample a pixel, of 16, 32 or 64 bits; otherwise as decodeTiff.
FloatImage decodeFloatTiff(std::span<const std::byte> encoded, const ImageHeader& header);

}  // namespace droplet
