// SPDX-License-Identifier: GPL-3.0-or-later
#include <new>

#include "droplet/footprint/mask.h"
#include "footprint/mask_from_image.h"
#include "image/image_file.h"

namespace droplet {

Mask decodeMask(std::span<const std::byte> encoded, const MaskOptions& options)
{
    try {
        return maskFromImage(decodeImage(encoded, {options.max_pixels, options.vector_long_side}), options);
    } catch (const std::bad_alloc&) {
        throwOutOfMemory();
    }
}

std::vector<std::byte> readImageBytes(const std::filesystem::path& path)
{
    return readImageFile(path);
}

Mask readMask(const std::filesystem::path& path, const MaskOptions& options)
{
    return fromImageFile(path, [&](std::span<const std::byte> encoded) { return decodeMask(encoded, options); });
}

}  // namespace droplet
