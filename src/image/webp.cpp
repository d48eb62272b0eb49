// SPDX-License-Identifier: GPL-3.0-or-later
// WebP (container specification, RFC 6386, lossless bitstream) through libwebp. It decodes whole images only:
// up to 8 bytes a pixel at its peak, for a format that ends at 16383 × 16383.
#include <webp/decode.h>

#include <string>

#include "image/codecs.h"
#include "image/image_bytes.h"

namespace droplet {

Image decodeWebp(std::span<const std::byte> encoded, const ImageHeader& header)
{
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(encoded.data());
    WebPDecoderConfig config;
    if (WebPInitDecoderConfig(&config) == 0 || WebPGetFeatures(bytes, encoded.size(), &config.input) != VP8_STATUS_OK) {
        throwDamaged(ImageFormat::Webp, "its header cannot be read");
    }
    if (config.input.has_animation != 0) {
        throwUnsupported(ImageFormat::Webp, "an animation");
    }
    if (config.input.width != header.width || config.input.height != header.height) {
        throwDamaged(ImageFormat::Webp, "it names two sizes");
    }
    const bool has_alpha = config.input.has_alpha != 0;
    const int channels = has_alpha ? 4 : 3;
    const auto width = static_cast<std::size_t>(header.width);
    const auto height = static_cast<std::size_t>(header.height);
    const std::size_t stride = width * static_cast<std::size_t>(channels);
    std::vector<std::uint8_t> pixels(stride * height);
    config.output.colorspace = has_alpha ? MODE_RGBA : MODE_RGB;
    config.output.is_external_memory = 1;
    config.output.u.RGBA = {pixels.data(), static_cast<int>(stride), pixels.size()};
    const VP8StatusCode status = WebPDecode(bytes, encoded.size(), &config);
    WebPFreeDecBuffer(&config.output);
    if (status != VP8_STATUS_OK) {
        throwDamaged(ImageFormat::Webp,
                     status == VP8_STATUS_NOT_ENOUGH_DATA || status == VP8_STATUS_SUSPENDED
                         ? "it ends too early"
                         : "its pixels cannot be decoded (status " + std::to_string(static_cast<int>(status)) + ")");
    }
    Image image = blankImage(header, has_alpha);
    putPixels(image, {0, 1, channels}, std::span<const std::uint8_t>(pixels));
    return image;
}

}  // namespace droplet
