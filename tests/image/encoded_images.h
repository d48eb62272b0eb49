// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <tiffio.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// jpeglib.h needs FILE from above.
#include <jpeglib.h>

#include "droplet/error.h"
#include "droplet/mask/mask.h"

// Image files of every supported format, written by the formats' own libraries, by OpenCV or by hand.

namespace droplet::encoded {

using Bytes = std::vector<std::byte>;

inline Bytes bytesOf(std::string_view text)
{
    Bytes bytes(text.size());
    std::transform(text.begin(), text.end(), bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
    return bytes;
}

inline Bytes contentOf(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return bytesOf(std::string(std::istreambuf_iterator<char>(file), {}));
}

inline void writeFile(const std::filesystem::path& path, const Bytes& bytes)
{
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// Temporary folder of a test.
class Folder {
public:
    Folder()
    {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        std::string leaf = std::string(test->test_suite_name()) + "." + test->name() + std::to_string(getpid());
        std::replace(leaf.begin(), leaf.end(), '/', '_');
        path_ = std::filesystem::path(testing::TempDir()) / leaf;
        std::filesystem::create_directories(path_);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path_); }

    [[nodiscard]] std::filesystem::path operator/(const char* name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

/// Samples before they are encoded.
struct Raster {
    int width = 0;
    int height = 0;
    int channels = 1;
    int bits = 8;
    std::vector<unsigned> samples;

    [[nodiscard]] unsigned white() const { return (1U << bits) - 1U; }
    [[nodiscard]] unsigned at(int x, int y, int c) const
    {
        const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        return samples[pixel * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)];
    }
    [[nodiscard]] double level(int x, int y, int c) const { return at(x, y, c) / double(white()); }
};

/// Random levels that include both ends of the range; the sides are odd, so that padding matters.
inline Raster noise(int channels, int bits, int width = 13, int height = 7)
{
    Raster raster{width, height, channels, bits, {}};
    unsigned state = 12345;
    for (int i = 0; i < width * height * channels; ++i) {
        state = state * 1664525U + 1013904223U;
        raster.samples.push_back(i % 17 == 0 ? 0 : i % 13 == 0 ? raster.white() : state >> (32 - bits));
    }
    return raster;
}

/// One row, most significant bit first, 16 bits in the given byte order.
inline std::vector<std::uint8_t> packedRow(const Raster& raster, int y, std::endian order = std::endian::big,
                                           int only_channel = -1)
{
    std::vector<std::uint8_t> row;
    int bit = 0;
    for (int x = 0; x < raster.width; ++x) {
        for (int c = 0; c < raster.channels; ++c) {
            if (only_channel >= 0 && c != only_channel) {
                continue;
            }
            const unsigned sample = raster.at(x, y, c);
            if (raster.bits == 16) {
                const unsigned swapped = order == std::endian::big ? (sample >> 8 | sample << 8) : sample;
                row.push_back(static_cast<std::uint8_t>(swapped & 255U));
                row.push_back(static_cast<std::uint8_t>(swapped >> 8 & 255U));
                continue;
            }
            if (bit % 8 == 0) {
                row.push_back(0);
            }
            row.back() = static_cast<std::uint8_t>(row.back() | sample << (8 - raster.bits - bit % 8));
            bit += raster.bits;
        }
    }
    return row;
}

inline MaskOptions only(Channel channel)
{
    MaskOptions options;
    options.channel = channel;
    return options;
}

inline std::string messageOf(const std::function<void()>& call)
{
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return "";
}

inline std::string messageOf(const Bytes& encoded, const MaskOptions& options = {})
{
    return messageOf([&] { decodeMask(encoded, options); });
}

inline std::uint32_t crc32(std::span<const std::byte> bytes)
{
    std::uint32_t crc = ~0U;
    for (const std::byte byte : bytes) {
        crc ^= std::to_integer<std::uint32_t>(byte);
        for (int i = 0; i < 8; ++i) {
            crc = crc >> 1 ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
        }
    }
    return ~crc;
}

inline void appendBig(Bytes& bytes, std::uint32_t value, int count = 4)
{
    for (int i = count - 1; i >= 0; --i) {
        bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
    }
}

inline void appendLittle(Bytes& bytes, std::uint64_t value, int count)
{
    for (int i = 0; i < count; ++i) {
        bytes.push_back(static_cast<std::byte>(value & 255U));
        value >>= 8;
    }
}

inline Bytes pngChunk(std::string_view type, const Bytes& data)
{
    Bytes typed = bytesOf(type);
    typed.insert(typed.end(), data.begin(), data.end());
    Bytes chunk;
    appendBig(chunk, static_cast<std::uint32_t>(data.size()));
    chunk.insert(chunk.end(), typed.begin(), typed.end());
    appendBig(chunk, crc32(typed));
    return chunk;
}

struct PngKind {
    int colour_type = PNG_COLOR_TYPE_GRAY;
    bool interlaced = false;
    std::vector<png_color> palette;
    std::vector<png_byte> palette_alpha;
    const png_color_16* transparent = nullptr;
};

inline Bytes encodePng(const Raster& raster, const PngKind& kind)
{
    Bytes bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &bytes,
        [](png_structp self, png_bytep data, std::size_t count) {
            auto& to = *static_cast<Bytes*>(png_get_io_ptr(self));
            const auto* from = reinterpret_cast<const std::byte*>(data);
            to.insert(to.end(), from, from + count);
        },
        [](png_structp) {});
    png_set_IHDR(png, info, static_cast<png_uint_32>(raster.width), static_cast<png_uint_32>(raster.height),
                 raster.bits, kind.colour_type, kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (!kind.palette.empty()) {
        png_set_PLTE(png, info, kind.palette.data(), static_cast<int>(kind.palette.size()));
    }
    if (!kind.palette_alpha.empty()) {
        png_set_tRNS(png, info, kind.palette_alpha.data(), static_cast<int>(kind.palette_alpha.size()), nullptr);
    }
    if (kind.transparent != nullptr) {
        png_set_tRNS(png, info, nullptr, 0, kind.transparent);
    }
    png_write_info(png, info);
    const auto height = static_cast<std::size_t>(raster.height);
    std::vector<std::vector<std::uint8_t>> rows(height);
    std::vector<png_bytep> pointers(height);
    for (std::size_t y = 0; y < height; ++y) {
        rows[y] = packedRow(raster, static_cast<int>(y));
        pointers[y] = rows[y].data();
    }
    png_write_image(png, pointers.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

struct TiffKind {
    std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
    std::vector<std::uint16_t> extra_samples;
    std::uint16_t compression = COMPRESSION_NONE;
    bool separate = false;
    int tile = 0;
    const char* mode = "wl";  ///< byte order, BigTIFF
    std::uint16_t orientation = 0;
    std::vector<std::uint16_t> palette;  ///< reds, greens, blues
    std::uint16_t sample_format = 0;
};

inline Bytes encodeTiff(const Raster& raster, const TiffKind& kind)
{
    const Folder folder;
    const std::string path = (folder / "image.tif").string();
    TIFF* tiff = TIFFOpen(path.c_str(), kind.mode);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, raster.width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, raster.height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, raster.bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, raster.channels);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, kind.photometric);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, kind.compression);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, kind.separate ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
    if (!kind.extra_samples.empty()) {
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, kind.extra_samples.size(), kind.extra_samples.data());
    }
    if (kind.orientation != 0) {
        TIFFSetField(tiff, TIFFTAG_ORIENTATION, kind.orientation);
    }
    if (kind.sample_format != 0) {
        TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, kind.sample_format);
    }
    std::vector<std::uint16_t> palette = kind.palette;
    if (!palette.empty()) {
        const std::size_t third = palette.size() / 3;
        TIFFSetField(tiff, TIFFTAG_COLORMAP, palette.data(), palette.data() + third, palette.data() + 2 * third);
    }
    const int planes = kind.separate ? raster.channels : 1;
    if (kind.tile == 0) {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 3);
        for (int plane = 0; plane < planes; ++plane) {
            for (int y = 0; y < raster.height; ++y) {
                auto row = packedRow(raster, y, std::endian::native, kind.separate ? plane : -1);
                TIFFWriteScanline(tiff, row.data(), static_cast<std::uint32_t>(y), static_cast<std::uint16_t>(plane));
            }
        }
    } else {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, kind.tile);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, kind.tile);
        for (int plane = 0; plane < planes; ++plane) {
            for (int y0 = 0; y0 < raster.height; y0 += kind.tile) {
                for (int x0 = 0; x0 < raster.width; x0 += kind.tile) {
                    Raster tile{kind.tile, kind.tile, raster.channels, raster.bits, {}};
                    for (int y = y0; y < y0 + kind.tile; ++y) {
                        for (int x = x0; x < x0 + kind.tile; ++x) {
                            for (int c = 0; c < raster.channels; ++c) {
                                const bool inside = x < raster.width && y < raster.height;
                                tile.samples.push_back(inside ? raster.at(x, y, c) : 0);
                            }
                        }
                    }
                    std::vector<std::uint8_t> buffer;
                    for (int y = 0; y < kind.tile; ++y) {
                        const auto row = packedRow(tile, y, std::endian::native, kind.separate ? plane : -1);
                        buffer.insert(buffer.end(), row.begin(), row.end());
                    }
                    TIFFWriteTile(tiff, buffer.data(), static_cast<std::uint32_t>(x0), static_cast<std::uint32_t>(y0),
                                  0, static_cast<std::uint16_t>(plane));
                }
            }
        }
    }
    TIFFClose(tiff);
    return contentOf(path);
}

/// Fields of 8 × 8 pixels, the unit that JPEG transforms; at quality 100 each keeps its colour.
inline Raster fields(int channels, int columns, int rows)
{
    Raster raster{8 * columns, 8 * rows, channels, 8, {}};
    for (int y = 0; y < raster.height; ++y) {
        for (int x = 0; x < raster.width; ++x) {
            for (int c = 0; c < channels; ++c) {
                raster.samples.push_back(static_cast<unsigned>((x / 8 * 83 + y / 8 * 59 + c * 101 + 20) % 256));
            }
        }
    }
    return raster;
}

struct JpegKind {
    bool progressive = false;
    bool adobe = true;
    int quality = 100;
    std::vector<jpeg_scan_info> scans;  ///< scans instead of the usual progression; empty for the latter
};

inline Bytes encodeJpeg(const Raster& raster, const JpegKind& kind = {})
{
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* buffer = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &buffer, &size);
    info.image_width = static_cast<JDIMENSION>(raster.width);
    info.image_height = static_cast<JDIMENSION>(raster.height);
    info.input_components = raster.channels;
    info.in_color_space = raster.channels == 1 ? JCS_GRAYSCALE : raster.channels == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, kind.quality, TRUE);
    if (kind.progressive) {
        jpeg_simple_progression(&info);
    }
    if (!kind.scans.empty()) {
        info.scan_info = kind.scans.data();
        info.num_scans = static_cast<int>(kind.scans.size());
    }
    if (!kind.adobe) {
        info.write_Adobe_marker = FALSE;
    }
    jpeg_start_compress(&info, TRUE);
    for (int y = 0; y < raster.height; ++y) {
        auto row = packedRow(raster, y);
        JSAMPROW pointer = row.data();
        jpeg_write_scanlines(&info, &pointer, 1);
    }
    jpeg_finish_compress(&info);
    const auto* first = reinterpret_cast<const std::byte*>(buffer);
    Bytes bytes(first, first + size);
    jpeg_destroy_compress(&info);
    std::free(buffer);
    return bytes;
}

struct BmpKind {
    int header = 40;
    unsigned bits = 24;
    unsigned compression = 0;
    bool top_down = false;
    unsigned colours = 0;
    Bytes after_header;  ///< masks beyond the header, palette
};

inline Bytes bmpHeader(int width, int height, const BmpKind& kind)
{
    Bytes bytes = bytesOf("BM");
    appendLittle(bytes, 0, 8);
    appendLittle(bytes, static_cast<unsigned>(14 + kind.header) + kind.after_header.size(), 4);
    appendLittle(bytes, static_cast<unsigned>(kind.header), 4);
    const int size_bytes = kind.header == 12 ? 2 : 4;
    appendLittle(bytes, static_cast<std::uint64_t>(width), size_bytes);
    appendLittle(bytes, static_cast<std::uint64_t>(kind.top_down ? -height : height), size_bytes);
    appendLittle(bytes, 1, 2);
    appendLittle(bytes, kind.bits, 2);
    if (kind.header >= 40) {
        appendLittle(bytes, kind.compression, 4);
        appendLittle(bytes, 0, 12);
        appendLittle(bytes, kind.colours, 4);
        appendLittle(bytes, 0, 4);
    }
    bytes.insert(bytes.end(), kind.after_header.begin(), kind.after_header.end());
    return bytes;
}

/// Place of a picture on the screen of a GIF, and how it is stored.
struct GifKind {
    int screen_width = 0;
    int screen_height = 0;
    int x = 0;
    int y = 0;
    bool interlaced = false;
    int transparent = -1;  ///< index
};

/// GIF of indices; index k of the palette is grey k · 255 / (2^bits − 1).
inline Bytes encodeGif(const Raster& indices, const GifKind& kind)
{
    Bytes bytes = bytesOf("GIF89a");
    const auto flags = static_cast<unsigned>(0x80 | (indices.bits - 1));
    appendLittle(bytes, static_cast<unsigned>(kind.screen_width), 2);
    appendLittle(bytes, static_cast<unsigned>(kind.screen_height), 2);
    appendLittle(bytes, flags, 3);
    for (unsigned k = 0; k <= indices.white(); ++k) {
        appendLittle(bytes, 0x010101U * (k * 255 / indices.white()), 3);
    }
    const Bytes comment = bytesOf(std::string_view("\x21\xfe\x02hi\0", 6));
    bytes.insert(bytes.end(), comment.begin(), comment.end());
    if (kind.transparent >= 0) {
        appendLittle(bytes, 0x0104f921, 4);
        appendLittle(bytes, static_cast<unsigned>(kind.transparent) << 16, 4);
    }
    bytes.push_back(std::byte{0x2c});
    for (const int number : {kind.x, kind.y, indices.width, indices.height}) {
        appendLittle(bytes, static_cast<unsigned>(number), 2);
    }
    bytes.push_back(static_cast<std::byte>(kind.interlaced ? 0x40 : 0));
    const int first_bits = std::max(2, indices.bits);
    bytes.push_back(static_cast<std::byte>(first_bits));

    std::vector<unsigned> sequence;
    const auto add_rows = [&](int first, int step) {
        for (int y = first; y < indices.height; y += step) {
            for (int x = 0; x < indices.width; ++x) {
                sequence.push_back(indices.at(x, y, 0));
            }
        }
    };
    if (kind.interlaced) {
        add_rows(0, 8);
        add_rows(4, 8);
        add_rows(2, 4);
        add_rows(1, 2);
    } else {
        add_rows(0, 1);
    }
    Bytes packed;
    unsigned buffer = 0;
    int held = 0;
    int bits = first_bits + 1;
    const auto put = [&](unsigned code) {
        buffer |= code << held;
        for (held += bits; held >= 8; held -= 8, buffer >>= 8) {
            packed.push_back(static_cast<std::byte>(buffer & 255U));
        }
    };
    const unsigned clear = 1U << first_bits;
    std::map<std::pair<unsigned, unsigned>, unsigned> table;
    put(clear);
    unsigned string = sequence.front();
    for (std::size_t k = 1; k < sequence.size(); ++k) {
        const auto known = table.find({string, sequence[k]});
        if (known != table.end()) {
            string = known->second;
            continue;
        }
        put(string);
        const auto next = clear + 2 + static_cast<unsigned>(table.size());
        if (next == 4095) {
            put(clear);
            table.clear();
            bits = first_bits + 1;
        } else {
            table[{string, sequence[k]}] = next;
            bits += next == 1U << bits ? 1 : 0;
        }
        string = sequence[k];
    }
    put(string);
    bits += clear + 2 + table.size() == 1U << bits && bits < 12 ? 1 : 0;
    put(clear + 1);
    held > 0 ? packed.push_back(static_cast<std::byte>(buffer)) : void();
    for (std::size_t at = 0; at < packed.size(); at += 255) {
        const std::size_t size = std::min<std::size_t>(255, packed.size() - at);
        bytes.push_back(static_cast<std::byte>(size));
        bytes.insert(bytes.end(), packed.begin() + static_cast<std::ptrdiff_t>(at),
                     packed.begin() + static_cast<std::ptrdiff_t>(at + size));
    }
    appendLittle(bytes, 0x3b00, 2);
    return bytes;
}

/// Header of a TGA and its palette.
struct TgaKind {
    unsigned kind = 2;
    unsigned bits = 24;
    unsigned descriptor = 0;  ///< bits of alpha; 0x10 from the right, 0x20 from the top
    Bytes palette;            ///< of 24 bits
};

inline Bytes tgaHeader(int width, int height, const TgaKind& kind)
{
    Bytes bytes;
    appendLittle(bytes, 2, 1);
    appendLittle(bytes, kind.palette.empty() ? 0 : 1, 1);
    appendLittle(bytes, kind.kind, 1);
    appendLittle(bytes, 0, 2);
    appendLittle(bytes, kind.palette.size() / 3, 2);
    appendLittle(bytes, kind.palette.empty() ? 0 : 24, 1);
    appendLittle(bytes, 0, 4);
    appendLittle(bytes, static_cast<unsigned>(width), 2);
    appendLittle(bytes, static_cast<unsigned>(height), 2);
    appendLittle(bytes, kind.bits, 1);
    appendLittle(bytes, kind.descriptor, 1);
    appendLittle(bytes, 0x6968, 2);  // its name
    bytes.insert(bytes.end(), kind.palette.begin(), kind.palette.end());
    return bytes;
}

/// TGA of colours, from the bottom, without run lengths.
inline Bytes encodeTga(const Raster& raster)
{
    Bytes bytes = tgaHeader(raster.width, raster.height,
                            {2, static_cast<unsigned>(8 * raster.channels), raster.channels == 4 ? 8U : 0U, {}});
    for (int y = raster.height - 1; y >= 0; --y) {
        for (int x = 0; x < raster.width; ++x) {
            for (int c = 0; c < raster.channels; ++c) {
                bytes.push_back(static_cast<std::byte>(raster.at(x, y, c < 3 ? 2 - c : c)));
            }
        }
    }
    return bytes;
}

/// Icon of several pictures: their sides and their PNG files, or bitmaps.
inline Bytes encodeIco(const std::vector<std::pair<int, Bytes>>& pictures)
{
    Bytes bytes;
    appendLittle(bytes, 0x10000, 4);
    appendLittle(bytes, pictures.size(), 2);
    std::size_t offset = 6 + 16 * pictures.size();
    for (const auto& [side, file] : pictures) {
        appendLittle(bytes, static_cast<unsigned>(side % 256) * 0x101U, 4);
        appendLittle(bytes, 0x200001, 4);
        appendLittle(bytes, file.size(), 4);
        appendLittle(bytes, offset, 4);
        offset += file.size();
    }
    for (const auto& [side, file] : pictures) {
        bytes.insert(bytes.end(), file.begin(), file.end());
    }
    return bytes;
}

inline Bytes encodeMat(const cv::Mat& image, const std::string& extension, const std::vector<int>& parameters = {})
{
    std::vector<std::uint8_t> buffer;
    EXPECT_TRUE(cv::imencode(extension, image, buffer, parameters));
    const auto* first = reinterpret_cast<const std::byte*>(buffer.data());
    return {first, first + buffer.size()};
}

inline Bytes encodeWithOpenCv(const Raster& raster, const std::string& extension,
                              const std::vector<int>& parameters = {})
{
    const int depth = raster.bits == 16 ? CV_16U : CV_8U;
    cv::Mat image(raster.height, raster.width, CV_MAKETYPE(depth, raster.channels));
    for (int y = 0; y < raster.height; ++y) {
        for (int x = 0; x < raster.width; ++x) {
            for (int c = 0; c < raster.channels; ++c) {
                const int swapped = raster.channels >= 3 && c < 3 ? 2 - c : c;
                const int column = x * raster.channels + swapped;
                if (raster.bits == 16) {
                    image.ptr<std::uint16_t>(y)[column] = static_cast<std::uint16_t>(raster.at(x, y, c));
                } else {
                    image.ptr<std::uint8_t>(y)[column] = static_cast<std::uint8_t>(raster.at(x, y, c));
                }
            }
        }
    }
    return encodeMat(image, extension, parameters);
}

/// OpenCV writes lossless WebP above quality 100. Fully transparent pixels lose their colour there.
inline Bytes encodeWebp(const Raster& raster, int quality = 101)
{
    return encodeWithOpenCv(raster, ".webp", {cv::IMWRITE_WEBP_QUALITY, quality});
}

/// WebP animation that shows a picture so many times on a canvas.
/// @param still  a WebP without animation, of width × height
inline Bytes webpAnimation(const Bytes& still, int width, int height, const GifKind& place, int frames = 1)
{
    Bytes frame;
    for (const int number : {place.x / 2, place.y / 2, width - 1, height - 1, 100}) {
        appendLittle(frame, static_cast<unsigned>(number), 3);
    }
    frame.push_back(std::byte{0});
    // Pictures with an alpha of their own are extended files.
    const std::string_view text(reinterpret_cast<const char*>(still.data()), still.size());
    const std::ptrdiff_t first = text.substr(12, 4) == "VP8X" ? 30 : 12;
    frame.insert(frame.end(), still.begin() + first, still.end());
    Bytes bytes = bytesOf("WEBPVP8X");
    appendLittle(bytes, 10, 4);
    appendLittle(bytes, 0x12, 4);
    appendLittle(bytes, static_cast<unsigned>(place.screen_width - 1), 3);
    appendLittle(bytes, static_cast<unsigned>(place.screen_height - 1), 3);
    const Bytes loop = bytesOf(std::string_view("ANIM\6\0\0\0\0\0\0\0\0\0", 14));
    bytes.insert(bytes.end(), loop.begin(), loop.end());
    for (int k = 0; k < frames; ++k) {
        const Bytes mark = bytesOf("ANMF");
        bytes.insert(bytes.end(), mark.begin(), mark.end());
        appendLittle(bytes, frame.size(), 4);
        bytes.insert(bytes.end(), frame.begin(), frame.end());
        bytes.resize(bytes.size() + frame.size() % 2);
    }
    Bytes file = bytesOf("RIFF");
    appendLittle(file, bytes.size(), 4);
    file.insert(file.end(), bytes.begin(), bytes.end());
    return file;
}

inline Bytes exifBlock(int orientation, std::endian order)
{
    const bool little = order == std::endian::little;
    Bytes block = bytesOf(little ? "II" : "MM");
    const auto put = [&](std::uint32_t value, int count) {
        little ? appendLittle(block, value, count) : appendBig(block, value, count);
    };
    put(42, 2);
    put(8, 4);
    put(1, 2);
    put(274, 2);
    put(3, 2);
    put(1, 4);
    put(static_cast<std::uint32_t>(orientation), 2);
    put(0, 2);
    put(0, 4);
    return block;
}

inline Bytes inserted(Bytes bytes, std::size_t at, const Bytes& more)
{
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), more.begin(), more.end());
    return bytes;
}

inline Bytes jpegWithExif(const Bytes& jpeg, const Bytes& block)
{
    Bytes segment;
    appendBig(segment, 0xffe1, 2);
    appendBig(segment, static_cast<std::uint32_t>(block.size()) + 8, 2);
    const Bytes mark = bytesOf(std::string_view("Exif\0\0", 6));
    segment.insert(segment.end(), mark.begin(), mark.end());
    segment.insert(segment.end(), block.begin(), block.end());
    return inserted(jpeg, 2, segment);
}

inline Bytes webpWithExif(const Bytes& webp, int width, int height, const Bytes& block)
{
    Bytes extended = bytesOf("VP8X");
    appendLittle(extended, 10, 4);
    appendLittle(extended, 0x08, 4);
    appendLittle(extended, static_cast<std::uint64_t>(width - 1), 3);
    appendLittle(extended, static_cast<std::uint64_t>(height - 1), 3);
    Bytes bytes = inserted(webp, 12, extended);
    const Bytes type = bytesOf("EXIF");
    bytes.insert(bytes.end(), type.begin(), type.end());
    appendLittle(bytes, block.size(), 4);
    bytes.insert(bytes.end(), block.begin(), block.end());
    Bytes size;
    appendLittle(size, bytes.size() - 8, 4);
    std::copy(size.begin(), size.end(), bytes.begin() + 4);
    return bytes;
}

}  // namespace droplet::encoded
