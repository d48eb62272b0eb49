// SPDX-License-Identifier: GPL-3.0-or-later
// After: Graphics Interchange Format, version 89a (CompuServe, 1990), with its appendix F on LZW.
//
// Of an animation, the first picture is read. It lies on a canvas, the logical screen; what it does not cover is
// transparent.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "image/codecs.h"
#include "image/image_bytes.h"

namespace droplet {
namespace {

/// Bits of codes that are spread over blocks of up to 255 bytes.
class CodeReader {
public:
    CodeReader(const ByteView& view, std::size_t at) : view_(view), at_(at) {}

    /// Next code of so many bits, lowest bit first; none after the last block.
    std::optional<std::uint32_t> next(int bits)
    {
        while (held_ < bits) {
            if (left_ == 0) {
                left_ = view_.u8(at_++);
                if (left_ == 0) {
                    return std::nullopt;
                }
            }
            buffer_ |= view_.u8(at_++) << held_;
            held_ += 8;
            --left_;
        }
        const std::uint32_t code = buffer_ & ((1U << bits) - 1U);
        buffer_ >>= bits;
        held_ -= bits;
        return code;
    }

private:
    const ByteView& view_;
    std::size_t at_;
    std::uint32_t left_ = 0;  ///< bytes of the block that were not read
    std::uint32_t buffer_ = 0;
    int held_ = 0;  ///< bits in the buffer
};

constexpr int kMaxBits = 12;

/// Unpacks so many indices.
std::vector<std::uint8_t> unpack(const ByteView& view, std::size_t at, std::size_t count)
{
    const auto first_bits = static_cast<int>(view.u8(at));
    if (first_bits < 1 || first_bits >= kMaxBits) {
        throwDamaged(ImageFormat::Gif, "its codes begin with " + std::to_string(first_bits) + " bits");
    }
    const std::uint32_t clear = 1U << first_bits;
    const std::uint32_t end = clear + 1;
    struct Entry {
        std::uint16_t prefix = 0;
        std::uint16_t length = 0;
        std::uint8_t last = 0;
        std::uint8_t first = 0;
    };
    std::array<Entry, 1U << kMaxBits> table{};
    for (std::uint32_t k = 0; k < clear; ++k) {
        table.at(k) = {0, 1, static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(k)};
    }
    std::vector<std::uint8_t> indices;
    indices.reserve(count);
    CodeReader codes(view, at + 1);
    std::uint32_t used = end + 1;  // entries of the table
    int bits = first_bits + 1;
    std::uint32_t previous = 0;
    bool has_previous = false;
    while (indices.size() < count) {
        const auto code = codes.next(bits);
        if (!code || code == end) {
            throwDamaged(ImageFormat::Gif, "its pixels end too early");
        }
        if (code == clear) {
            used = end + 1;
            bits = first_bits + 1;
            has_previous = false;
            continue;
        }
        if (*code > used || (*code == used && !has_previous) || (*code >= clear && *code <= end)) {
            throwDamaged(ImageFormat::Gif, "it has an unknown code");
        }
        if (has_previous && used < table.size()) {
            const Entry& before = table.at(previous);
            const std::uint8_t first = *code == used ? before.first : table.at(*code).first;
            table.at(used++) = {static_cast<std::uint16_t>(previous), static_cast<std::uint16_t>(before.length + 1),
                                first, before.first};
        }
        const std::size_t begin = indices.size();
        const std::size_t length = table.at(*code).length;
        indices.resize(begin + length);
        for (std::uint32_t entry = *code, k = 0; k < length; ++k, entry = table.at(entry).prefix) {
            indices[begin + length - 1 - k] = table.at(entry).last;
        }
        if (used == 1U << bits && bits < kMaxBits) {
            ++bits;
        }
        previous = *code;
        has_previous = true;
    }
    return indices;
}

/// Row of the n-th row that is stored.
std::size_t rowOf(std::size_t n, std::size_t rows, bool is_interlaced)
{
    struct Pass {
        std::size_t first;
        std::size_t step;
    };
    if (is_interlaced) {
        for (const Pass pass : {Pass{0, 8}, Pass{4, 8}, Pass{2, 4}, Pass{1, 2}}) {
            const std::size_t count = rows <= pass.first ? 0 : (rows - pass.first + pass.step - 1) / pass.step;
            if (n < count) {
                return pass.first + pass.step * n;
            }
            n -= count;
        }
    }
    return n;
}

/// Offset after blocks of up to 255 bytes.
std::size_t skipBlocks(const ByteView& view, std::size_t at)
{
    while (view.u8(at) != 0) {
        at += 1 + view.u8(at);
    }
    return at + 1;
}

constexpr std::uint32_t kHasPalette = 0x80;

std::size_t paletteSize(std::uint32_t flags)
{
    return (flags & kHasPalette) != 0 ? std::size_t{3} << ((flags & 7U) + 1) : 0;
}

}  // namespace

Image decodeGif(std::span<const std::byte> encoded, const DecodeOptions& options)
{
    const ByteView view(encoded, ImageFormat::Gif);
    constexpr std::size_t kScreen = 6;
    std::size_t at = kScreen + 7 + paletteSize(view.u8(kScreen + 4));
    std::optional<std::uint32_t> transparent;
    for (; view.u8(at) != 0x2c; at = skipBlocks(view, at + 2)) {
        if (view.u8(at) != 0x21) {
            throwDamaged(ImageFormat::Gif, "it has no picture");
        }
        if (view.u8(at + 1) == 0xf9 && view.u8(at + 2) >= 4) {
            transparent = (view.u8(at + 3) & 1U) != 0 ? std::optional(view.u8(at + 6)) : std::nullopt;
        }
    }
    const auto side = [&](std::size_t offset) { return static_cast<int>(view.le16(offset)); };
    const int width = side(at + 5);
    const int height = side(at + 7);
    const std::uint32_t flags = view.u8(at + 9);
    if (width == 0 || height == 0) {
        throwDamaged(ImageFormat::Gif, "its first picture has no size");
    }
    checkSize(ImageFormat::Gif, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height),
              options.max_pixels);
    PicturePlace canvas{side(kScreen), side(kScreen + 2), side(at + 1), side(at + 3)};
    if (canvas.width == 0 || canvas.height == 0) {
        canvas = {width, height, 0, 0};
    }
    checkSize(ImageFormat::Gif, static_cast<std::uint64_t>(canvas.width), static_cast<std::uint64_t>(canvas.height),
              options.max_pixels);
    const bool has_own = (flags & kHasPalette) != 0;
    const std::size_t palette = has_own ? at + 10 : kScreen + 7;
    const std::size_t palette_bytes = paletteSize(has_own ? flags : view.u8(kScreen + 4));
    const auto columns = static_cast<std::size_t>(width);
    const auto rows = static_cast<std::size_t>(height);
    const std::vector<std::uint8_t> indices = unpack(view, at + 10 + (has_own ? palette_bytes : 0), columns * rows);

    Image image = blankImage({ImageFormat::Gif, width, height, 1, options.keeps_colour}, transparent.has_value());
    const std::size_t channels = transparent ? 4 : 3;
    std::vector<std::uint8_t> row(channels * columns);
    for (std::size_t n = 0; n < rows; ++n) {
        for (std::size_t x = 0; x < columns; ++x) {
            const std::uint32_t index = indices[n * columns + x];
            for (std::size_t c = 0; c < 3; ++c) {
                const bool is_known = std::size_t{3} * index + c < palette_bytes;
                row[channels * x + c] =
                    static_cast<std::uint8_t>(is_known ? view.u8(palette + std::size_t{3} * index + c) : 0);
            }
            if (transparent) {
                row[channels * x + 3] = index == *transparent ? 0 : 255;
            }
        }
        putPixels(image, {rowOf(n, rows, (flags & 0x40U) != 0) * columns, 1, static_cast<int>(channels)},
                  std::span<const std::uint8_t>(row));
    }
    return placedOn(canvas, std::move(image));
}

}  // namespace droplet
