// SPDX-License-Identifier: GPL-3.0-or-later
// Windows and OS/2 bitmaps: BITMAPCOREHEADER, BITMAPINFOHEADER and its successors up to version 5; 1, 2, 4, 8, 16,
// 24 and 32 bits, run lengths (BI_RLE8, BI_RLE4), colour masks (BI_BITFIELDS).
#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "image/codecs.h"
#include "image/image_bytes.h"

namespace droplet {

namespace {

constexpr std::uint32_t kCoreHeader = 12;
constexpr std::uint32_t kInfoHeader = 40;
constexpr std::size_t kFileHeader = 14;

enum class Compression : std::uint32_t { None = 0, Runs8 = 1, Runs4 = 2, Masks = 3, MasksWithAlpha = 6 };

using Rgb = std::array<std::uint8_t, 3>;

/// One channel of a pixel of 16 or 32 bits.
struct Field {
    std::uint32_t mask = 0;

    [[nodiscard]] std::uint16_t level(std::uint32_t pixel) const
    {
        if (mask == 0) {
            return 0;
        }
        const auto shift = static_cast<unsigned>(std::countr_zero(mask));
        const std::uint64_t white = mask >> shift;
        return static_cast<std::uint16_t>((std::uint64_t{(pixel & mask) >> shift} * 65535U + white / 2) / white);
    }
};

/// What follows from the headers.
struct Bitmap {
    std::uint32_t bits = 0;
    Compression compression = Compression::None;
    bool top_down = false;
    std::size_t payload = 0;
    std::vector<Rgb> palette;
    std::array<Field, 4> fields{};  ///< red, green, blue, alpha
};

void readPalette(Bitmap& bitmap, const ByteView& view, std::size_t at, std::size_t entry_size)
{
    const bool core = entry_size == 3;
    const std::size_t named = core ? 0 : view.le32(46);
    const std::size_t most = std::size_t{1} << bitmap.bits;
    std::size_t count = named == 0 ? most : std::min(named, most);
    // Old writers leave the count out and stop early, where the pixels begin.
    if (bitmap.payload > at) {
        count = std::min(count, (bitmap.payload - at) / entry_size);
    }
    for (std::size_t i = 0; i < count; ++i, at += entry_size) {
        bitmap.palette.push_back({static_cast<std::uint8_t>(view.u8(at + 2)),
                                  static_cast<std::uint8_t>(view.u8(at + 1)), static_cast<std::uint8_t>(view.u8(at))});
    }
}

void readFields(Bitmap& bitmap, const ByteView& view, std::uint32_t header_size)
{
    const bool masks = bitmap.compression == Compression::Masks || bitmap.compression == Compression::MasksWithAlpha;
    if (!masks) {
        // The fourth byte is "reserved", yet most programs that write it mean alpha; see decodeBmp.
        bitmap.fields = bitmap.bits == 16 ? std::array<Field, 4>{{{0x7c00}, {0x03e0}, {0x001f}, {0}}}
                                          : std::array<Field, 4>{{{0xff0000}, {0xff00}, {0xff}, {0xff000000}}};
        return;
    }
    constexpr std::size_t kMasks = 54;  // behind a header of 40 bytes, within a longer one: the same place
    constexpr std::uint32_t kHeaderWithAlpha = 56;
    const bool alpha = header_size >= kHeaderWithAlpha || bitmap.compression == Compression::MasksWithAlpha;
    for (std::size_t i = 0; i < (alpha ? 4U : 3U); ++i) {
        const std::uint32_t mask = view.le32(kMasks + 4 * i);
        const std::uint32_t run = mask == 0 ? 0 : mask >> std::countr_zero(mask);
        if ((run & (run + 1)) != 0) {
            throwDamaged(ImageFormat::Bmp, "a colour mask with gaps");
        }
        bitmap.fields[i].mask = mask;
    }
}

bool isKnown(std::uint32_t bits, Compression compression)
{
    switch (compression) {
        case Compression::None:
            return bits == 1 || bits == 2 || bits == 4 || bits == 8 || bits == 16 || bits == 24 || bits == 32;
        case Compression::Runs8:
            return bits == 8;
        case Compression::Runs4:
            return bits == 4;
        case Compression::Masks:
        case Compression::MasksWithAlpha:
            return bits == 16 || bits == 32;
    }
    return false;  // any other number in the file
}

Bitmap readBitmap(const ByteView& view)
{
    Bitmap bitmap;
    const std::uint32_t header_size = view.le32(kFileHeader);
    const bool core = header_size == kCoreHeader;
    if (!core && header_size < kInfoHeader) {
        throwUnsupported(ImageFormat::Bmp, "a header of " + std::to_string(header_size) + " bytes");
    }
    bitmap.payload = view.le32(10);
    bitmap.bits = view.le16(core ? 24 : 28);
    if (!core) {
        const std::uint32_t compression = view.le32(30);
        bitmap.compression = static_cast<Compression>(compression);
        bitmap.top_down = (view.le32(22) & 0x80000000U) != 0;
    }
    if (!isKnown(bitmap.bits, bitmap.compression)) {
        throwUnsupported(ImageFormat::Bmp, "compression " +
                                               std::to_string(static_cast<std::uint32_t>(bitmap.compression)) +
                                               " with " + std::to_string(bitmap.bits) + " bits per pixel");
    }
    if (bitmap.bits <= 8) {
        readPalette(bitmap, view, kFileHeader + header_size, core ? 3 : 4);
    } else if (bitmap.bits != 24) {
        readFields(bitmap, view, header_size);
    }
    return bitmap;
}

/// Unpacks run lengths into one palette index a pixel, in the file's order of rows. Pixels that the runs skip
/// are index 0.
std::vector<std::uint8_t> readRuns(const Bitmap& bitmap, const ByteView& view, std::size_t width, std::size_t height)
{
    const bool nibbles = bitmap.compression == Compression::Runs4;
    std::vector<std::uint8_t> indices(width * height);
    std::size_t x = 0;
    std::size_t y = 0;
    const auto put = [&](std::uint32_t index) {
        // Runs may reach past the row's end, for the padding.
        if (x < width && y < height) {
            indices[y * width + x] = static_cast<std::uint8_t>(index);
        }
        ++x;
    };
    const auto half = [&](std::uint32_t byte, std::size_t i) {
        return nibbles ? (i % 2 == 0 ? byte >> 4 : byte & 15U) : byte;
    };
    for (std::size_t at = bitmap.payload;;) {
        if (!view.has(at, 2) && y + 1 >= height && (x >= width || y >= height)) {
            return indices;  // all there; only the mark of the end is missing
        }
        const std::uint32_t count = view.u8(at);
        const std::uint32_t value = view.u8(at + 1);
        at += 2;
        if (count > 0) {
            for (std::size_t i = 0; i < count; ++i) {
                put(half(value, i));
            }
        } else if (value == 0) {
            x = 0;
            ++y;
        } else if (value == 1) {
            return indices;
        } else if (value == 2) {
            x += view.u8(at);
            y += view.u8(at + 1);
            at += 2;
        } else {
            for (std::size_t i = 0; i < value; ++i) {
                put(half(view.u8(at + (nibbles ? i / 2 : i)), i));
            }
            const std::size_t bytes = nibbles ? (value + 1) / 2 : value;
            at += bytes + bytes % 2;
        }
    }
}

const Rgb& colour(const Bitmap& bitmap, std::size_t index)
{
    if (index >= bitmap.palette.size()) {
        throwDamaged(ImageFormat::Bmp,
                     "colour " + std::to_string(index) + " of a palette of " + std::to_string(bitmap.palette.size()));
    }
    return bitmap.palette[index];
}

}  // namespace

Image decodeBmp(std::span<const std::byte> encoded, const ImageHeader& header)
{
    const ByteView view(encoded, ImageFormat::Bmp);
    const Bitmap bitmap = readBitmap(view);
    const auto width = static_cast<std::size_t>(header.width);
    const auto height = static_cast<std::size_t>(header.height);
    const bool runs = bitmap.compression == Compression::Runs8 || bitmap.compression == Compression::Runs4;
    const std::size_t stride = (width * bitmap.bits + 31) / 32 * 4;
    if (!view.has(bitmap.payload, runs ? 0 : stride * height)) {
        throwDamaged(ImageFormat::Bmp, "it ends too early");
    }
    const std::vector<std::uint8_t> indices =
        runs ? readRuns(bitmap, view, width, height) : std::vector<std::uint8_t>();

    const bool direct = bitmap.bits == 16 || bitmap.bits == 32;
    const bool has_alpha = direct && bitmap.fields[3].mask != 0;
    const int channels = has_alpha ? 4 : 3;
    Image image = blankImage(header, has_alpha);
    std::vector<std::uint8_t> row(width * 3);
    std::vector<std::uint16_t> deep_row(direct ? width * static_cast<std::size_t>(channels) : 0);
    for (std::size_t stored = 0; stored < height; ++stored) {
        const std::size_t y = bitmap.top_down ? stored : height - 1 - stored;
        const std::size_t at = bitmap.payload + stored * stride;
        if (direct) {
            for (std::size_t x = 0; x < width; ++x) {
                const std::uint32_t pixel = bitmap.bits == 16 ? view.le16(at + 2 * x) : view.le32(at + 4 * x);
                for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
                    deep_row[x * static_cast<std::size_t>(channels) + c] = bitmap.fields[c].level(pixel);
                }
            }
            putPixels(image, {y * width, 1, channels}, std::span<const std::uint16_t>(deep_row));
            continue;
        }
        for (std::size_t x = 0; x < width; ++x) {
            Rgb rgb{};
            if (bitmap.bits == 24) {
                for (std::size_t c = 0; c < 3; ++c) {
                    rgb[c] = static_cast<std::uint8_t>(view.u8(at + 3 * x + 2 - c));
                }
            } else if (runs) {
                rgb = colour(bitmap, indices[stored * width + x]);
            } else {
                const std::size_t bit = x * bitmap.bits;
                const std::uint32_t byte = view.u8(at + bit / 8);
                rgb = colour(bitmap, byte >> (8 - bitmap.bits - bit % 8) & ((1U << bitmap.bits) - 1U));
            }
            std::copy(rgb.begin(), rgb.end(), row.begin() + static_cast<std::ptrdiff_t>(3 * x));
        }
        putPixels(image, {y * width, 1, channels}, std::span<const std::uint8_t>(row));
    }
    // Alpha that is zero everywhere is a reserved byte left at zero, not a picture of nothing.
    if (std::all_of(image.alpha.begin(), image.alpha.end(), [](std::uint16_t alpha) { return alpha == 0; })) {
        image.alpha = {};
    }
    return image;
}

}  // namespace droplet
