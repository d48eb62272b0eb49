// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "image/image.h"

namespace droplet {

/// Place of a device-independent bitmap in a file.
struct DibPlace {
    ImageFormat format = ImageFormat::Bmp;  ///< Bmp, or Ico, whose bitmap is followed by its mask of transparent pixels
    std::size_t header = 0;                 ///< offset of its header
    std::optional<std::size_t> pixels;      ///< offset of its pixels [after header and palette]
};

/// Decodes a bitmap of 1, 2, 4, 8, 16, 24 or 32 bits, with or without run lengths. The fourth sample of 32 bits, or the
/// one with an alpha mask, is alpha, unless all pixels have the same.
/// @throws Error InvalidInput: damaged, unsupported, more than max_pixels
Image decodeDib(std::span<const std::byte> encoded, const DibPlace& place, const DecodeOptions& options);

}  // namespace droplet
