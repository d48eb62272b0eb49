// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/error.h"
#include "droplet/image/height_map.h"
#include "droplet/mask/mask.h"
#include "fuzz/targets.h"

namespace droplet {

void fuzzMask(std::span<const std::byte> bytes)
{
    MaskOptions options;
    options.max_pixels = std::size_t{1} << 20;  // spend time on headers, not on pixels
    options.vector_long_side = 32;
    for (const Channel channel : {Channel::Auto, Channel::Alpha}) {
        options.channel = channel;
        try {
            decodeMask(bytes, options).validate();
        } catch (const Error&) {
            // Broken files must be refused.
        }
    }
    try {
        decodeHeightMap(bytes, options.max_pixels).validate();
    } catch (const Error&) {
        // Broken files must be refused.
    }
}

}  // namespace droplet
