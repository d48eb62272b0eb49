// SPDX-License-Identifier: GPL-3.0-or-later
// Device-independent bitmaps, the pixels of BMP and ICO files. After: Windows GDI, BITMAPCOREHEADER, BITMAPINFOHEADER,
// BITMAPV4HEADER and BITMAPV5HEADER.
//
// Bitmaps whose rows have run lengths are unpacked into indices of the palette first. All others are read row by row.
#include "image/dib.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "image/codecs.h"
#include "image/image_bytes.h"

namespace droplet {
namespace {

constexpr std::uint32_t kOldHeader = 12;
constexpr std::uint32_t kRunLengths8 = 1;
constexpr std::uint32_t kRunLengths4 = 2;
constexpr std::uint32_t kMasks = 3;
constexpr std::uint32_t kMasksWithAlpha = 6;

using Rgba = std::array<std::uint8_t, 4>;

/// One sample of a pixel's bits.
struct SampleMask {
    std::uint32_t bits = 0;

    [[nodiscard]] std::uint8_t of(std::uint32_t pixel) const
    {
        if (bits == 0) {
            return 0;
        }
        const std::uint64_t max = bits >> std::countr_zero(bits);
        const std::uint64_t value = (pixel & bits) >> std::countr_zero(bits);
        return static_cast<std::uint8_t>((value * 255 + max / 2) / max);
    }
};

/// Bitmap in a file.
class Dib {
public:
    Dib(std::span<const std::byte> encoded, const DibPlace& place, std::size_t max_pixels)
        : view_(encoded, place.format), format_(place.format)
    {
        const std::size_t at = place.header;
        const std::uint32_t header = view_.le32(at);
        const bool is_old = header == kOldHeader;
        if (!is_old && header < 40) {
            throwDamaged(format_, "its header has " + std::to_string(header) + " bytes");
        }
        readSize(at, is_old);
        checkSize(format_, static_cast<std::uint64_t>(width_), static_cast<std::uint64_t>(height_), max_pixels);
        bits_ = view_.le16(at + (is_old ? 10 : 14));
        compression_ = is_old ? 0 : view_.le32(at + 16);
        const std::size_t masks_at = at + 40;
        const bool has_masks = compression_ == kMasks || compression_ == kMasksWithAlpha;
        const std::size_t extra = has_masks && header == 40 ? (compression_ == kMasks ? 12 : 16) : 0;
        checkKind(has_masks);
        if (has_masks) {
            const bool with_alpha = header >= 56 || compression_ == kMasksWithAlpha;
            for (std::size_t k = 0; k < (with_alpha ? 4U : 3U); ++k) {
                masks_.at(k).bits = view_.le32(masks_at + 4 * k);
            }
        } else if (bits_ == 16) {
            masks_ = {{{0x7c00}, {0x03e0}, {0x001f}, {0}}};
        } else if (bits_ == 32) {
            masks_ = {{{0xff0000}, {0xff00}, {0xff}, {0xff000000}}};
        }
        std::size_t palette_end = at + header + extra;
        if (bits_ <= 8) {
            palette_end = readPalette(palette_end, is_old ? 0 : view_.le32(at + 32), is_old);
        }
        pixels_ = place.pixels.value_or(palette_end);
    }

    [[nodiscard]] Image decode(bool keeps_colour)
    {
        if (compression_ == kRunLengths8 || compression_ == kRunLengths4) {
            unpackRuns();
        } else if (!view_.has(pixels_, stride(bits_) * rows())) {
            throwDamaged(format_, "it ends before its pixels do");
        }
        const std::optional<std::size_t> mask = maskOfIcon();
        const bool has_alpha = usesAlpha();
        Image image = blankImage({format_, width_, height_, 1, keeps_colour}, has_alpha || mask);
        const std::size_t channels = image.alpha.empty() ? 3 : 4;
        std::vector<std::uint8_t> row(channels * columns());
        for (std::size_t y = 0; y < rows(); ++y) {
            for (std::size_t x = 0; x < columns(); ++x) {
                Rgba pixel = colourAt(x, y);
                if (!has_alpha) {
                    const bool is_hidden = mask && bitAt(*mask + stored(y) * stride(1), x);
                    pixel[3] = is_hidden ? 0 : 255;
                }
                std::copy_n(pixel.begin(), channels, row.begin() + static_cast<std::ptrdiff_t>(channels * x));
            }
            putPixels(image, {y * columns(), 1, static_cast<int>(channels)}, std::span<const std::uint8_t>(row));
        }
        return image;
    }

private:
    [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(width_); }
    [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(height_); }
    /// Place of a row in the file; most bitmaps begin with the lowest.
    [[nodiscard]] std::size_t stored(std::size_t y) const { return is_top_down_ ? y : rows() - 1 - y; }
    /// Bytes of a row, which ends at a multiple of 4.
    [[nodiscard]] std::size_t stride(std::uint32_t bits) const { return (columns() * bits + 31) / 32 * 4; }

    void readSize(std::size_t at, bool is_old)
    {
        const auto side = [&](std::size_t old_offset, std::size_t offset) {
            return is_old ? std::int64_t{view_.le16(at + old_offset)}
                          : std::int64_t{static_cast<std::int32_t>(view_.le32(at + offset))};
        };
        const std::int64_t width = side(4, 4);
        std::int64_t height = side(6, 8);
        is_top_down_ = height < 0;
        height = height < 0 ? -height : height;
        if (format_ == ImageFormat::Ico) {
            height /= 2;  // the mask lies below
        }
        constexpr std::int64_t kLongest = 0x7fffffff;
        if (width < 1 || height < 1 || height > kLongest) {
            throwDamaged(format_, "its header claims a width or height of zero or less");
        }
        width_ = static_cast<int>(width);
        height_ = static_cast<int>(height);
    }

    void checkKind(bool has_masks) const
    {
        const auto is_any = [](std::uint32_t value, std::initializer_list<std::uint32_t> of) {
            return std::find(of.begin(), of.end(), value) != of.end();
        };
        if (!is_any(bits_, {1, 2, 4, 8, 16, 24, 32})) {
            throwUnsupported(format_, std::to_string(bits_) + " bits per pixel");
        }
        const bool fits = compression_ == 0 || (compression_ == kRunLengths8 && bits_ == 8) ||
                          (compression_ == kRunLengths4 && bits_ == 4) || (has_masks && is_any(bits_, {16, 32}));
        if (!fits) {
            throwUnsupported(format_, "compression " + std::to_string(compression_) + " of " + std::to_string(bits_) +
                                          " bits per pixel");
        }
    }

    /// Reads the palette, and returns the offset of its end.
    std::size_t readPalette(std::size_t at, std::uint32_t stated, bool is_old)
    {
        const std::uint32_t all = 1U << bits_;
        const std::uint32_t count = stated == 0 ? all : std::min(stated, all);
        const std::size_t entry = is_old ? 3 : 4;
        palette_.assign(all, Rgba{0, 0, 0, 255});
        for (std::uint32_t k = 0; k < count; ++k) {
            for (std::size_t c = 0; c < 3; ++c) {
                palette_[k].at(2 - c) = static_cast<std::uint8_t>(view_.u8(at + entry * k + c));
            }
        }
        return at + entry * count;
    }

    /// Whether the fourth sample says what is transparent: pixels differ in it.
    [[nodiscard]] bool usesAlpha() const
    {
        if (masks_[3].bits == 0) {
            return false;
        }
        const std::uint8_t first = masks_[3].of(bitsAt(0, 0));
        for (std::size_t y = 0; y < rows(); ++y) {
            for (std::size_t x = 0; x < columns(); ++x) {
                if (masks_[3].of(bitsAt(x, y)) != first) {
                    return true;
                }
            }
        }
        return false;
    }

    /// Offset of an icon's mask, if it has one.
    [[nodiscard]] std::optional<std::size_t> maskOfIcon() const
    {
        const std::size_t at = pixels_ + stride(bits_) * rows();
        const bool has_mask = format_ == ImageFormat::Ico && view_.has(at, stride(1) * rows());
        return has_mask ? std::optional(at) : std::nullopt;
    }

    [[nodiscard]] bool bitAt(std::size_t row, std::size_t x) const
    {
        return (view_.u8(row + x / 8) >> (7 - x % 8) & 1U) != 0;
    }

    /// Bits of a pixel of 16 or 32 bits.
    [[nodiscard]] std::uint32_t bitsAt(std::size_t x, std::size_t y) const
    {
        const std::size_t row = pixels_ + stored(y) * stride(bits_);
        return bits_ == 16 ? view_.le16(row + 2 * x) : view_.le32(row + 4 * x);
    }

    [[nodiscard]] Rgba colourAt(std::size_t x, std::size_t y) const
    {
        if (!unpacked_.empty()) {
            return palette_[unpacked_[stored(y) * columns() + x]];
        }
        if (bits_ == 16 || bits_ == 32) {
            const std::uint32_t pixel = bitsAt(x, y);
            return {masks_[0].of(pixel), masks_[1].of(pixel), masks_[2].of(pixel), masks_[3].of(pixel)};
        }
        const std::size_t row = pixels_ + stored(y) * stride(bits_);
        if (bits_ == 24) {
            const auto sample = [&](std::size_t c) { return static_cast<std::uint8_t>(view_.u8(row + 3 * x + c)); };
            return {sample(2), sample(1), sample(0), 255};
        }
        const std::size_t bit = x * bits_;
        return palette_[view_.u8(row + bit / 8) >> (8 - bits_ - bit % 8) & ((1U << bits_) - 1U)];
    }

    /// Unpacks run lengths. Pixels that are skipped have the first colour.
    void unpackRuns()
    {
        unpacked_.assign(columns() * rows(), 0);
        std::size_t x = 0;
        std::size_t y = 0;
        const auto put = [&](std::uint32_t index) {
            if (x < columns() && y < rows()) {
                unpacked_[y * columns() + x] = static_cast<std::uint8_t>(index);
            }
            ++x;
        };
        const auto nibble = [](std::uint32_t pair, std::size_t k) { return k % 2 == 0 ? pair >> 4 : pair & 15U; };
        const auto is_complete = [&] { return y >= rows() || (y + 1 == rows() && x >= columns()); };
        std::size_t at = pixels_;
        while (!is_complete() || view_.has(at, 2)) {
            const std::uint32_t count = view_.u8(at);
            const std::uint32_t value = view_.u8(at + 1);
            at += 2;
            if (count > 0) {
                for (std::uint32_t k = 0; k < count; ++k) {
                    put(bits_ == 8 ? value : nibble(value, k));
                }
            } else if (value == 0) {
                x = 0;
                ++y;
            } else if (value == 1) {
                return;
            } else if (value == 2) {
                x += view_.u8(at);
                y += view_.u8(at + 1);
                at += 2;
            } else {
                for (std::uint32_t k = 0; k < value; ++k) {
                    put(bits_ == 8 ? view_.u8(at + k) : nibble(view_.u8(at + k / 2), k));
                }
                const std::size_t bytes = bits_ == 8 ? value : (value + 1) / 2;
                at += bytes + bytes % 2;
            }
        }
    }

    ByteView view_;
    ImageFormat format_;
    int width_ = 0;
    int height_ = 0;
    bool is_top_down_ = false;
    std::uint32_t bits_ = 0;
    std::uint32_t compression_ = 0;
    std::array<SampleMask, 4> masks_{};   ///< red, green, blue, alpha of 16 or 32 bits
    std::vector<Rgba> palette_;           ///< of up to 8 bits: a colour for each index
    std::size_t pixels_ = 0;              ///< offset
    std::vector<std::uint8_t> unpacked_;  ///< indices of run lengths, rows as stored
};

}  // namespace

Image decodeDib(std::span<const std::byte> encoded, const DibPlace& place, const DecodeOptions& options)
{
    return Dib(encoded, place, options.max_pixels).decode(options.keeps_colour);
}

Image decodeBmp(std::span<const std::byte> encoded, const DecodeOptions& options)
{
    return decodeDib(encoded, {ImageFormat::Bmp, 14, std::size_t{ByteView(encoded, ImageFormat::Bmp).le32(10)}},
                     options);
}

}  // namespace droplet
