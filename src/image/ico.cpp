// SPDX-License-Identifier: GPL-3.0-or-later
// Icons and cursors: a list of pictures, each a PNG or a bitmap with a mask. The largest one is read.
#include <algorithm>
#include <cstdint>
#include <tuple>

#include "image/codecs.h"
#include "image/dib.h"
#include "image/image_bytes.h"

namespace droplet {

Image decodeIco(std::span<const std::byte> encoded, const DecodeOptions& options)
{
    const ByteView view(encoded, ImageFormat::Ico);
    const std::uint32_t count = view.le16(4);
    constexpr std::uint32_t kSizeOfZero = 256;
    std::tuple<std::uint32_t, std::uint32_t> best{0, 0};
    std::size_t offset = 0;
    std::size_t size = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::size_t entry = 6 + std::size_t{16} * k;
        const auto side = [&](std::size_t at) { return view.u8(at) == 0 ? kSizeOfZero : view.u8(at); };
        const std::tuple rank{side(entry) * side(entry + 1), view.le16(entry + 6)};
        if (rank > best) {
            best = rank;
            size = view.le32(entry + 8);
            offset = view.le32(entry + 12);
        }
    }
    if (!view.has(offset, std::max<std::size_t>(size, 4))) {
        throwDamaged(ImageFormat::Ico, count == 0 ? "it has no picture" : "it ends before its largest picture does");
    }
    const auto picture = encoded.subspan(offset, size);
    if (imageFormat(picture) != ImageFormat::Png) {
        return decodeDib(encoded.first(offset + size), {ImageFormat::Ico, offset, {}}, options);
    }
    ImageHeader header = readImageHeader(picture, ImageFormat::Png, options.max_pixels);
    header.keeps_colour = options.keeps_colour;
    return decodePng(picture, header);
}

}  // namespace droplet
