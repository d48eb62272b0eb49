// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image/image_header.h"

namespace droplet {

/// Decoded image, reduced during decoding to what a mask needs, with colour on request. It takes two bytes a pixel,
/// four with alpha: 512 MiB or 1 GiB at 16384 × 16384.
/// Invariant: `luma.size() == width * height`; alpha has the same size, or is empty if the file has none; colour has
/// the same size, or is empty if it was not requested.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> luma;                  ///< ITU-R BT.601, as stored: no gamma, no colour profile
    std::vector<std::uint16_t> alpha;                 ///< 65535 opaque
    bool premultiplied = false;                       ///< luma and colour are already weighted by alpha
    std::vector<std::array<std::uint8_t, 3>> colour;  ///< red, green, blue, as stored

    std::optional<double> raster_scale;    ///< as in Mask
    std::optional<double> physical_width;  ///< as in Mask [m]
    std::string lacking;                   ///< as in Mask
};

/// Checks that a drawing shows something.
/// @throws Error InvalidInput: an SVG image that is transparent everywhere
void requireInk(const Image& image);

/// Black, transparent image of the size in a header, with colour if the header requests it.
Image blankImage(const ImageHeader& header, bool with_alpha);

/// Run of decoded pixels and their place in an image.
struct PixelRun {
    std::size_t first = 0;  ///< index of the run's first pixel
    std::size_t step = 1;   ///< step from one pixel of the run to the next
    int channels = 1;       ///< interleaved samples a pixel: 1 grey, 2 grey+alpha, 3 RGB, 4 RGB+alpha
};

/// Stores a run of samples. An 8-bit v becomes 257 v, so that 255 becomes 65535 and grey stays exactly grey.
template <class Sample>
void putPixels(Image& image, const PixelRun& run, std::span<const Sample> samples);

/// Turns an image upright by its EXIF or TIFF orientation, 1 … 8. Needs one more plane of memory.
Image upright(Image image, int orientation);

/// A canvas, and the place of a picture on it.
struct PicturePlace {
    int width = 0;   ///< [px] ≥ 1
    int height = 0;  ///< [px] ≥ 1
    int x = 0;       ///< of the picture's left side [px] ≥ 0
    int y = 0;       ///< of its upper side [px] ≥ 0
};

/// Puts a picture on a transparent canvas, which cuts it off; unchanged if it covers just the canvas.
Image placedOn(const PicturePlace& canvas, Image picture);

/// Limits for drawing a vector image.
struct DrawingLimits {
    double seconds = 10.0;                      ///< as in MaskOptions [s]
    std::size_t memory = std::size_t{1} << 30;  ///< as in MaskOptions [B]
};

/// Options of decoding.
struct DecodeOptions {
    std::size_t max_pixels = std::size_t{1} << 28;  ///< as in MaskOptions
    int vector_long_side = 2048;                    ///< as in MaskOptions [px]
    bool keeps_colour = false;                      ///< keep colour beside luma
    DrawingLimits drawing{};
};

/// Decodes an image of any supported format, upright. The size in its header is checked first.
/// @throws Error InvalidInput
Image decodeImage(std::span<const std::byte> encoded, const DecodeOptions& options);

/// Luma of an image in front of black: luma weighted by alpha.
std::vector<std::uint16_t> lumaOverBlack(Image image);

/// Decoded image of floating-point samples, one per pixel.
struct FloatImage {
    int width = 0;
    int height = 0;
    std::vector<float> samples;                ///< row by row from the top left, as stored; some may not be finite
    std::vector<std::array<float, 3>> colour;  ///< red, green, blue as stored, if requested
};

/// Decodes an image of floating-point samples, upright; none if the samples are integers. The size in its header is
/// checked first.
/// @throws Error InvalidInput
std::optional<FloatImage> decodeFloatImage(std::span<const std::byte> encoded, std::size_t max_pixels,
                                           bool keeps_colour = false);

}  // namespace droplet
