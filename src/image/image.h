// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "image/image_header.h"

namespace droplet {

/// A decoded image, reduced while it is decoded to what a mask can be read from, and colour where that is asked.
/// Two bytes a pixel, four with alpha: 512 MiB or 1 GiB at 16384 × 16384.
/// Invariant: `luma.size() == width * height`; alpha is as long, or empty when the file has none; colour is as long, or
/// empty where it was not asked.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> luma;                  ///< ITU-R BT.601, as stored: no gamma, no colour profile
    std::vector<std::uint16_t> alpha;                 ///< 65535 opaque
    bool premultiplied = false;                       ///< luma and colour are already weighted by alpha
    std::vector<std::array<std::uint8_t, 3>> colour;  ///< red, green, blue, as stored

    std::optional<double> drawn_scale;     ///< as in Mask
    std::optional<double> physical_width;  ///< as in Mask [m]
};

/// An image all black and transparent, of the size in a header, with colour if that is wanted there.
Image blankImage(const ImageHeader& header, bool with_alpha);

/// A run of decoded pixels and where in an image they go.
struct PixelRun {
    std::size_t first = 0;  ///< index of the pixel the run starts at
    std::size_t step = 1;   ///< from one pixel of the run to the next
    int channels = 1;       ///< interleaved samples a pixel: 1 grey, 2 grey+alpha, 3 RGB, 4 RGB+alpha
};

/// Stores a run of samples; 8-bit v becomes 257 v, so that 255 is 65535 and grey stays grey to the bit.
template <class Sample>
void putPixels(Image& image, const PixelRun& run, std::span<const Sample> samples);

/// The image as seen when held by its EXIF (or TIFF) orientation, 1 … 8; needs one more plane of memory.
Image upright(Image image, int orientation);

/// What drawing a vector image may take.
struct DrawingLimits {
    double seconds = 10.0;                      ///< as in MaskOptions [s]
    std::size_t memory = std::size_t{1} << 30;  ///< as in MaskOptions [B]
};

/// How an image becomes pixels.
struct DecodeOptions {
    std::size_t max_pixels = std::size_t{1} << 28;  ///< as in MaskOptions
    int vector_long_side = 2048;                    ///< as in MaskOptions [px]
    bool keeps_colour = false;                      ///< beside luma
    DrawingLimits drawing{};
};

/// Decodes an image of any format this library reads, upright. The size in its header is checked first.
/// @throws Error InvalidInput
Image decodeImage(std::span<const std::byte> encoded, const DecodeOptions& options);

/// What is seen of an image in front of black: its luma, as much of it as is opaque.
std::vector<std::uint16_t> lumaOverBlack(Image image);

/// A decoded image of floating-point samples, one a pixel.
struct FloatImage {
    int width = 0;
    int height = 0;
    std::vector<float> samples;                ///< row by row from the top left, as stored; not all need be finite
    std::vector<std::array<float, 3>> colour;  ///< red, green, blue as stored, where that was asked
};

/// Decodes an image of floating-point samples, upright; none if the samples are integers. The size in its header is
/// checked first.
/// @throws Error InvalidInput
std::optional<FloatImage> decodeFloatImage(std::span<const std::byte> encoded, std::size_t max_pixels,
                                           bool keeps_colour = false);

}  // namespace droplet
