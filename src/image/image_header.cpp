// SPDX-License-Identifier: GPL-3.0-or-later
// After: Portable Network Graphics (W3C), 11.2.2 and 11.3 (eXIf); ITU-T T.81, B.1 and B.2.2; TIFF 6.0, section 2
// and BigTIFF; EXIF 2.32, 4.5.4 and 4.7.2; WebP container specification.
#include "image/image_header.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>

#include "droplet/error.h"
#include "image/image_bytes.h"

namespace droplet {

namespace {

constexpr std::uint16_t kTagOrientation = 274;

struct Size {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    int orientation = 1;
};

int orientationIn(std::span<const std::byte> tiff)
{
    const std::uint64_t value = tiffField(tiff, kTagOrientation).value_or(1);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
}

/// Orientation from an EXIF block: a TIFF file without pixels, after a mark that JPEG requires and some WebP writers
/// add.
int exifOrientation(std::span<const std::byte> block)
{
    using namespace std::string_view_literals;
    constexpr std::string_view kMark = "Exif\0\0"sv;
    const bool marked = ByteView(block, ImageFormat::Tiff).startsWith(kMark);
    return orientationIn(marked ? block.subspan(kMark.size()) : block);
}

Size pngSize(std::span<const std::byte> encoded)
{
    constexpr std::size_t kSignature = 8;
    constexpr std::size_t kAroundData = 12;  // length and type before the data, checksum after them
    const ByteView view(encoded, ImageFormat::Png);
    if (!view.startsWith("IHDR", kSignature + 4)) {
        throwDamaged(ImageFormat::Png, "it does not begin with a header");
    }
    Size size{view.be32(kSignature + 8), view.be32(kSignature + 12)};
    for (std::size_t chunk = kSignature; view.has(chunk, kAroundData);) {
        const std::size_t length = view.be32(chunk);
        if (!view.has(chunk, kAroundData + length)) {
            break;
        }
        if (view.startsWith("eXIf", chunk + 4)) {
            size.orientation = exifOrientation(encoded.subspan(chunk + 8, length));
        }
        chunk += kAroundData + length;
    }
    return size;
}

Size jpegSize(std::span<const std::byte> encoded)
{
    constexpr std::uint32_t kFirstFrame = 0xC0;
    constexpr std::uint32_t kLastFrame = 0xCF;
    const ByteView view(encoded, ImageFormat::Jpeg);
    int orientation = 1;
    for (std::size_t at = 2;;) {
        if (view.u8(at) != 0xFF) {
            ++at;
            continue;
        }
        const std::uint32_t marker = view.u8(at + 1);
        if (marker == 0xFF) {
            ++at;
            continue;
        }
        at += 2;
        if (marker <= 0x01 || (marker >= 0xD0 && marker <= 0xD8)) {
            continue;  // markers without a segment: stuffing, TEM, restarts, start of image
        }
        if (marker == 0xD9 || marker == 0xDA) {
            throwDamaged(ImageFormat::Jpeg, "it has no frame header");
        }
        const std::size_t length = view.be16(at);
        // C4, C8 and CC are not frame markers but Huffman tables, reserved, and arithmetic conditioning.
        if (marker >= kFirstFrame && marker <= kLastFrame && marker != 0xC4 && marker != 0xC8 && marker != 0xCC) {
            return {view.be16(at + 5), view.be16(at + 3), orientation};
        }
        if (marker == 0xE1 && view.startsWith("Exif", at + 2) && length > 2 && view.has(at, length)) {
            orientation = exifOrientation(encoded.subspan(at + 2, length - 2));
        }
        at += length < 2 ? 2 : length;
    }
}

bool isSpace(std::uint32_t c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Whether a file begins as markup and an svg element follows soon, or whether it is markup in UTF-16.
bool beginsLikeSvg(std::span<const std::byte> encoded)
{
    using namespace std::string_view_literals;
    constexpr std::size_t kSoon = std::size_t{1} << 16;
    const auto bytes = encoded.first(std::min(encoded.size(), kSoon));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string_view start = text.starts_with("\xef\xbb\xbf"sv) ? text.substr(3) : text;
    const auto first = start.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && start[first] == '<') {
        return text.find("<svg") != std::string_view::npos || text.find(":svg") != std::string_view::npos;
    }
    return text.starts_with("\xff\xfe<\0"sv) || text.starts_with("\xfe\xff\0<"sv);
}

/// Whether a file begins with a possible header of a TGA, which has no mark.
bool beginsLikeTga(const ByteView& view)
{
    if (!view.has(0, 18)) {
        return false;
    }
    const auto is_any = [](std::uint32_t value, std::initializer_list<std::uint32_t> of) {
        return std::find(of.begin(), of.end(), value) != of.end();
    };
    const std::uint32_t kind = view.u8(2);
    const std::uint32_t bits = view.u8(16);
    const std::uint32_t alpha_bits = view.u8(17) & 15U;
    const bool has_palette = is_any(kind, {1, 9});
    const bool has_grey = is_any(kind, {3, 11});
    const bool has_colour = is_any(kind, {2, 10});
    const bool palette_fits = has_palette ? view.u8(1) == 1 && is_any(bits, {8, 16}) && view.le16(5) > 0
                                          : view.u8(1) == 0 && view.le16(3) == 0 && view.le16(5) == 0;
    const bool bits_fit =
        has_palette || (has_grey && is_any(bits, {8, 16})) || (has_colour && is_any(bits, {15, 16, 24, 32}));
    return (has_palette || has_grey || has_colour) && palette_fits && bits_fit && is_any(alpha_bits, {0, 1, 8}) &&
           view.u8(17) < 0x40 && view.le16(12) > 0 && view.le16(14) > 0;
}

/// Format that is not read, and what converts it.
struct ForeignFormat {
    const char* name;
    const char* advice;
};

std::optional<ForeignFormat> foreignFormat(std::span<const std::byte> encoded)
{
    using namespace std::string_view_literals;
    constexpr std::size_t kSoon = 1024;
    const ByteView view(encoded, ImageFormat::Pnm);
    const auto bytes = encoded.first(std::min(encoded.size(), kSoon));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());

    if (view.startsWith("ftyp", 4)) {
        const std::size_t size = view.has(0, 4) ? view.be32(0) : 0;
        const std::string_view brands = text.substr(8, std::max<std::size_t>(size, 8) - 8);
        for (const auto brand : {"avif"sv, "avis"sv}) {
            if (brands.find(brand) != std::string_view::npos) {
                return ForeignFormat{"AVIF", "avifdec (Debian's package libavif-bin) converts it to PNG"};
            }
        }
        for (const auto brand : {"heic"sv, "heix"sv, "heim"sv, "heis"sv, "hevc"sv, "hevx"sv, "mif1"sv, "msf1"sv}) {
            if (brands.find(brand) != std::string_view::npos) {
                return ForeignFormat{"HEIC", "heif-convert (Debian's package libheif-examples) converts it to PNG"};
            }
        }
    }
    if (text.find("%PDF-") != std::string_view::npos) {
        return ForeignFormat{"PDF (or Illustrator)",
                             "pdftocairo -svg (Debian's package poppler-utils) converts a page to SVG"};
    }
    if (view.startsWith("%!PS"sv) || view.startsWith("\xc5\xd0\xd3\xc6"sv)) {
        return ForeignFormat{"EPS (or Illustrator)",
                             "ps2pdf -dEPSCrop (Debian's package ghostscript) converts it to PDF, and pdftocairo -svg "
                             "(poppler-utils) that to SVG"};
    }
    if (view.startsWith("\xff\x0a"sv) || view.startsWith("\0\0\0\x0cJXL "sv)) {
        return ForeignFormat{"JPEG XL", "djxl (Debian's package libjxl-tools) converts it to PNG"};
    }
    if (view.startsWith("8BPS"sv)) {
        return ForeignFormat{"Photoshop", "GIMP exports it as PNG"};
    }
    if (view.startsWith("gimp xcf"sv)) {
        return ForeignFormat{"GIMP", "export it as PNG"};
    }
    return std::nullopt;
}

}  // namespace

const char* name(ImageFormat format)
{
    switch (format) {
        case ImageFormat::Png:
            return "PNG";
        case ImageFormat::Jpeg:
            return "JPEG";
        case ImageFormat::Bmp:
            return "BMP";
        case ImageFormat::Gif:
            return "GIF";
        case ImageFormat::Ico:
            return "ICO";
        case ImageFormat::Tga:
            return "TGA";
        case ImageFormat::Tiff:
            return "TIFF";
        case ImageFormat::Webp:
            return "WebP";
        case ImageFormat::Svg:
            return "SVG";
        case ImageFormat::Pnm:
            return "PBM/PGM/PPM";
        case ImageFormat::Jpeg2000:
            return "JPEG 2000";
        case ImageFormat::OpenExr:
            return "OpenEXR";
        case ImageFormat::RadianceHdr:
            break;
    }
    return "Radiance HDR";
}

std::optional<ImageFormat> imageFormat(std::span<const std::byte> encoded)
{
    using namespace std::string_view_literals;
    const ByteView view(encoded, ImageFormat::Pnm);
    if (view.startsWith("\x89PNG\r\n\x1a\n"sv)) {
        return ImageFormat::Png;
    }
    if (view.startsWith("\xff\xd8\xff"sv)) {
        return ImageFormat::Jpeg;
    }
    for (const auto magic : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv}) {
        if (view.startsWith(magic)) {
            return ImageFormat::Tiff;
        }
    }
    if (view.startsWith("RIFF"sv) && view.startsWith("WEBP"sv, 8)) {
        return ImageFormat::Webp;
    }
    if (view.startsWith("BM"sv)) {
        return ImageFormat::Bmp;
    }
    if (view.startsWith("P"sv) && view.has(0, 3) && view.u8(1) >= '1' && view.u8(1) <= '6' &&
        (isSpace(view.u8(2)) || view.u8(2) == '#')) {
        return ImageFormat::Pnm;
    }
    if (view.startsWith("\0\0\0\x0cjP  \r\n\x87\n"sv) || view.startsWith("\xff\x4f\xff\x51"sv)) {
        return ImageFormat::Jpeg2000;
    }
    if (view.startsWith("\x76\x2f\x31\x01"sv)) {
        return ImageFormat::OpenExr;
    }
    if (view.startsWith("#?RADIANCE"sv) || view.startsWith("#?RGBE"sv)) {
        return ImageFormat::RadianceHdr;
    }
    if (view.startsWith("GIF87a"sv) || view.startsWith("GIF89a"sv)) {
        return ImageFormat::Gif;
    }
    if (view.startsWith("\x1f\x8b"sv) || beginsLikeSvg(encoded)) {
        return ImageFormat::Svg;
    }
    if ((view.startsWith("\0\0\1\0"sv) || view.startsWith("\0\0\2\0"sv)) && view.has(4, 2) && view.le16(4) > 0) {
        return ImageFormat::Ico;
    }
    if (beginsLikeTga(view)) {
        return ImageFormat::Tga;
    }
    return std::nullopt;
}

ImageFormat knownFormat(std::span<const std::byte> encoded)
{
    const auto format = imageFormat(encoded);
    if (const auto foreign = format ? std::nullopt : foreignFormat(encoded)) {
        throw Error(ErrorCode::InvalidInput, std::string(foreign->name) + " files are not read; " + foreign->advice);
    }
    if (!format) {
        throw Error(ErrorCode::InvalidInput,
                    encoded.empty() ? "empty, not an image"
                                    : "not an image this program reads (PNG, JPEG, SVG, BMP, GIF, ICO, TGA, TIFF, "
                                      "WebP, PBM/PGM/PPM, JPEG 2000, OpenEXR, Radiance HDR)");
    }
    return *format;
}

ImageHeader readImageHeader(std::span<const std::byte> encoded, ImageFormat format, std::size_t max_pixels)
{
    const Size size = format == ImageFormat::Png ? pngSize(encoded) : jpegSize(encoded);
    if (size.width == 0 || size.height == 0) {
        throwDamaged(format, "its header claims a width or height of zero");
    }
    checkSize(format, size.width, size.height, max_pixels);
    return {format, static_cast<int>(size.width), static_cast<int>(size.height), size.orientation};
}

void checkSize(ImageFormat format, std::uint64_t width, std::uint64_t height, std::size_t max_pixels)
{
    constexpr auto kLongest = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
    if (width > kLongest || height > kLongest || width > max_pixels / height) {
        throw Error(ErrorCode::InvalidInput, std::string(name(format)) + " image of " + std::to_string(width) + " x " +
                                                 std::to_string(height) + " pixels, more than the limit of " +
                                                 std::to_string(max_pixels));
    }
}

int webpOrientation(std::span<const std::byte> encoded)
{
    const ByteView view(encoded, ImageFormat::Webp);
    for (std::size_t chunk = 12; view.has(chunk, 8);) {
        const std::size_t length = view.le32(chunk + 4);
        if (!view.has(chunk + 8, length)) {
            break;
        }
        if (view.startsWith("EXIF", chunk)) {
            return exifOrientation(encoded.subspan(chunk + 8, length));
        }
        chunk += 8 + length + length % 2;
    }
    return 1;
}

std::uint32_t pnmWhite(std::span<const std::byte> encoded)
{
    const ByteView view(encoded, ImageFormat::Pnm);
    const std::uint32_t kind = view.u8(1) - '0';
    if (kind == 1 || kind == 4) {
        return 0;
    }
    std::uint32_t value = 0;
    std::size_t at = 2;
    for (int numbers = 0; numbers < 3; ++numbers) {
        bool comment = false;
        for (; view.has(at, 1) && (comment || isSpace(view.u8(at)) || view.u8(at) == '#'); ++at) {
            comment = view.u8(at) == '#' || (comment && view.u8(at) != '\n' && view.u8(at) != '\r');
        }
        value = 0;
        for (; view.has(at, 1) && view.u8(at) >= '0' && view.u8(at) <= '9' && value < 65536; ++at) {
            value = 10 * value + (view.u8(at) - '0');
        }
    }
    // OpenCV itself stretches plain files of 8 bits.
    const bool plain = kind <= 3;
    return (plain && value < 256) || value == 255 || value >= 65535 ? 0 : value;
}

std::optional<std::uint64_t> tiffField(std::span<const std::byte> tiff, std::uint16_t tag)
{
    const ByteView view(tiff, ImageFormat::Tiff);
    if (!view.has(0, 8)) {
        return std::nullopt;
    }
    const bool little = view.startsWith("II");
    const auto number = [&](std::uint64_t offset, int bytes) {
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i) {
            const int place = little ? bytes - 1 - i : i;
            value = value << 8 | view.u8(static_cast<std::size_t>(offset) + static_cast<std::size_t>(place));
        }
        return value;
    };
    // BigTIFF is the classic layout with every offset and count twice or four times as wide.
    const bool big = number(2, 2) == 43;
    const int wide = big ? 8 : 4;
    const int entry_size = big ? 20 : 12;
    const std::uint64_t directory_at = big ? 8 : 4;
    const auto fits = [&](std::uint64_t offset, int bytes) {
        return offset <= tiff.size() && static_cast<std::uint64_t>(bytes) <= tiff.size() - offset;
    };
    if (!fits(directory_at, wide)) {
        return std::nullopt;
    }
    const std::uint64_t directory = number(directory_at, wide);
    const int count_bytes = big ? 8 : 2;
    if (!fits(directory, count_bytes)) {
        return std::nullopt;
    }
    const std::uint64_t entries = number(directory, count_bytes);
    std::uint64_t entry = directory + static_cast<std::uint64_t>(count_bytes);
    for (std::uint64_t i = 0; i < entries && fits(entry, entry_size); ++i) {
        if (number(entry, 2) == tag) {
            constexpr std::uint64_t kByte = 1;
            constexpr std::uint64_t kShort = 3;
            constexpr std::uint64_t kLong = 4;
            constexpr std::uint64_t kLong8 = 16;
            const std::uint64_t type = number(entry + 2, 2);
            const int bytes = type == kByte           ? 1
                              : type == kShort        ? 2
                              : type == kLong         ? 4
                              : type == kLong8 && big ? 8
                                                      : 0;
            const std::uint64_t inside = entry + 4 + static_cast<std::uint64_t>(wide);
            const bool fits_inside =
                number(entry + 4, wide) * static_cast<std::uint64_t>(bytes) <= static_cast<std::uint64_t>(wide);
            const std::uint64_t value_at = fits_inside ? inside : number(inside, wide);
            return bytes > 0 && fits(value_at, bytes) ? std::optional(number(value_at, bytes)) : std::nullopt;
        }
        entry += static_cast<std::uint64_t>(entry_size);
    }
    return std::nullopt;
}

}  // namespace droplet
