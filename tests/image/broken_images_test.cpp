// SPDX-License-Identifier: GPL-3.0-or-later
// Files cut at every length, damaged at every byte, lying about their size.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "image/encoded_images.h"

namespace droplet {
namespace {

using namespace encoded;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// One small file of every kind.
std::vector<std::pair<std::string, Bytes>> smallFiles()
{
    png_color_16 key{};
    key.gray = 3;
    TiffKind lzw;
    lzw.photometric = PHOTOMETRIC_RGB;
    lzw.extra_samples = {EXTRASAMPLE_UNASSALPHA};
    lzw.compression = COMPRESSION_LZW;
    TiffKind fax;
    fax.compression = COMPRESSION_CCITTFAX4;
    TiffKind palette;
    palette.photometric = PHOTOMETRIC_PALETTE;
    palette.palette.resize(12, 40000);
    TiffKind tiled;
    tiled.tile = 16;
    tiled.mode = "w8";
    tiled.compression = COMPRESSION_ADOBE_DEFLATE;
    TiffKind separate = lzw;
    separate.separate = true;
    separate.mode = "wb";
    separate.compression = COMPRESSION_NONE;
    BmpKind runs{40, 8, 1, false, 2, {}};
    appendLittle(runs.after_header, 0x00ffffff00000000U, 8);
    Bytes run_bmp = bmpHeader(5, 2, runs);
    appendLittle(run_bmp, 0x0105'0000'0005U, 6);
    appendLittle(run_bmp, 0x0100, 2);
    Bytes true_bmp = bmpHeader(3, 2, {40, 24, 0, false, 0, {}});
    true_bmp.resize(true_bmp.size() + 24, std::byte{0x5a});
    return {
        {"png grey", encodePng(noise(1, 16), {PNG_COLOR_TYPE_GRAY, false, {}, {}, nullptr})},
        {"png rgba interlaced", encodePng(noise(4, 8), {PNG_COLOR_TYPE_RGB_ALPHA, true, {}, {}, nullptr})},
        {"png transparent grey", encodePng(noise(1, 2), {PNG_COLOR_TYPE_GRAY, false, {}, {}, &key})},
        {"png palette",
         encodePng(noise(1, 1), {PNG_COLOR_TYPE_PALETTE, false, {{9, 9, 9}, {200, 20, 2}}, {7}, nullptr})},
        {"jpeg", encodeJpeg(fields(3, 2, 2), {false, true, 80, {}})},
        {"jpeg progressive", encodeJpeg(fields(1, 2, 2), {true, true, 80, {}})},
        {"jpeg cmyk", encodeJpeg(fields(4, 1, 2), {false, true, 80, {}})},
        {"jpeg exif", jpegWithExif(encodeJpeg(fields(1, 1, 2)), exifBlock(6, std::endian::big))},
        {"bmp 24", true_bmp},
        {"bmp runs", run_bmp},
        {"tiff grey", encodeTiff(noise(1, 16), {})},
        {"tiff lzw", encodeTiff(noise(4, 8), lzw)},
        {"tiff fax", encodeTiff(noise(1, 1), fax)},
        {"tiff palette", encodeTiff(noise(1, 2), palette)},
        {"tiff big, tiled", encodeTiff(noise(1, 8), tiled)},
        {"tiff separate", encodeTiff(noise(4, 16), separate)},
        {"webp", encodeWebp(noise(3, 8), 80)},
        {"webp alpha", encodeWebp(noise(4, 8), 80)},
        {"webp lossless", encodeWebp(noise(4, 8))},
        {"webp exif", webpWithExif(encodeWebp(noise(3, 8)), 13, 7, exifBlock(3, std::endian::little))},
        {"pbm plain", bytesOf("P1 3 2\n101\n010\n")},
        {"pgm plain", bytesOf("P2 2 2 255 12 200 255 1\n")},
        {"ppm raw", bytesOf("P6 2 1 255 abcdef")},
    };
}

TEST(BrokenImages, CutAtEveryLengthAreReadWholeOrNotAtAllAndInSilence)
{
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    for (const auto& [name, file] : smallFiles()) {
        SCOPED_TRACE(name);
        const Mask whole = decodeMask(file, only(Channel::Luma));
        for (std::size_t size = 0; size < file.size(); ++size) {
            // A copy, so that a sanitizer sees a read past the end.
            const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
            try {
                const Mask mask = decodeMask(cut, only(Channel::Luma));
                EXPECT_EQ(mask.coverage, whole.coverage) << size << " of " << file.size();
                // Only what follows the last pixel may be missing, and only where nothing tells: TIFF's pointer to
                // the next image, the end of a line, the mark that ends run lengths.
                EXPECT_LE(file.size() - size, name.starts_with("tiff")  ? 8U
                                              : name.ends_with("plain") ? 1U
                                              : name == "bmp runs"      ? 2U
                                                                        : 0U);
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
                EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
            }
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(BrokenImages, DamagedAtEveryByteAreReadOrRefusedInSilence)
{
    testing::internal::CaptureStderr();
    MaskOptions options;
    options.max_pixels = 1 << 16;
    for (const auto& [name, file] : smallFiles()) {
        SCOPED_TRACE(name);
        for (std::size_t at = 0; at < file.size(); ++at) {
            for (const std::byte flip : {std::byte{0x01}, std::byte{0x80}, std::byte{0xff}}) {
                Bytes damaged = file;
                damaged[at] ^= flip;
                try {
                    const Mask mask = decodeMask(damaged, options);
                    const auto pixels = static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height);
                    EXPECT_EQ(mask.coverage.size(), pixels);
                } catch (const Error& error) {
                    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
                }
            }
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

Bytes pngClaiming(std::uint32_t width, std::uint32_t height)
{
    Bytes header;
    appendBig(header, width);
    appendBig(header, height);
    appendBig(header, 0x08000000);
    header.push_back(std::byte{0});
    Bytes png = bytesOf("\x89PNG\r\n\x1a\n");
    const Bytes chunk = pngChunk("IHDR", header);
    png.insert(png.end(), chunk.begin(), chunk.end());
    return png;
}

Bytes jpegClaiming(std::uint32_t width, std::uint32_t height)
{
    Bytes jpeg = bytesOf("\xff\xd8\xff\xc0");
    appendBig(jpeg, 11, 2);
    appendBig(jpeg, 8, 1);
    appendBig(jpeg, height, 2);
    appendBig(jpeg, width, 2);
    appendBig(jpeg, 0x01011100, 4);
    return jpeg;
}

Bytes tiffClaiming(std::uint32_t width, std::uint32_t height, std::endian order)
{
    Bytes tiff = bytesOf(order == std::endian::little ? "II" : "MM");
    const auto put = [&](std::uint32_t value, int count) {
        order == std::endian::little ? appendLittle(tiff, value, count) : appendBig(tiff, value, count);
    };
    put(42, 2);
    put(8, 4);
    put(2, 2);
    for (const auto& [tag, value] : {std::pair{256U, width}, std::pair{257U, height}}) {
        put(tag, 2);
        put(4, 2);
        put(1, 4);
        put(value, 4);
    }
    put(0, 4);
    return tiff;
}

Bytes bigTiffClaiming(std::uint64_t width, std::uint64_t height)
{
    Bytes tiff = bytesOf("II");
    appendLittle(tiff, 43, 2);
    appendLittle(tiff, 8, 2);
    appendLittle(tiff, 0, 2);
    appendLittle(tiff, 16, 8);
    appendLittle(tiff, 2, 8);
    for (const auto& [tag, value] : {std::pair<unsigned, std::uint64_t>{256U, width}, {257U, height}}) {
        appendLittle(tiff, tag, 2);
        appendLittle(tiff, 16, 2);
        appendLittle(tiff, 1, 8);
        appendLittle(tiff, value, 8);
    }
    return tiff;
}

Bytes webpClaiming(std::string_view chunk, std::uint32_t width, std::uint32_t height)
{
    Bytes webp = bytesOf("RIFF");
    appendLittle(webp, 30, 4);
    for (const std::string_view part : {std::string_view("WEBP"), chunk}) {
        const Bytes more = bytesOf(part);
        webp.insert(webp.end(), more.begin(), more.end());
    }
    appendLittle(webp, 10, 4);
    if (chunk == "VP8X") {
        appendLittle(webp, 0, 4);
        appendLittle(webp, width - 1, 3);
        appendLittle(webp, height - 1, 3);
    } else if (chunk == "VP8L") {
        appendLittle(webp, 0x2f, 1);
        appendLittle(webp, (width - 1) | (height - 1) << 14, 4);
    } else {
        appendLittle(webp, 0x2a019d000000U, 6);
        appendLittle(webp, width, 2);
        appendLittle(webp, height, 2);
    }
    webp.resize(64);
    return webp;
}

TEST(ImageBombs, OfEveryFormatAreRefusedByTheirHeader)
{
    const auto refusal = [](std::uint64_t width, std::uint64_t height, std::size_t limit = std::size_t{1} << 28) {
        return AllOf(HasSubstr(std::to_string(width) + " x " + std::to_string(height)),
                     HasSubstr("limit of " + std::to_string(limit)));
    };
    constexpr std::uint32_t kHuge = 100000;
    EXPECT_THAT(messageOf(pngClaiming(kHuge, kHuge)), refusal(kHuge, kHuge));
    EXPECT_THAT(messageOf(pngClaiming(0x7fffffff, 0x7fffffff)), refusal(0x7fffffff, 0x7fffffff));
    EXPECT_THAT(messageOf(jpegClaiming(65535, 65534)), refusal(65535, 65534));
    EXPECT_THAT(messageOf(bmpHeader(kHuge, kHuge, {})), refusal(kHuge, kHuge));
    EXPECT_THAT(messageOf(bmpHeader(kHuge, kHuge, {40, 24, 0, true, 0, {}})), refusal(kHuge, kHuge));
    EXPECT_THAT(messageOf(bmpHeader(65535, 65535, {12, 1, 0, false, 0, {}})), refusal(65535, 65535));
    EXPECT_THAT(messageOf(tiffClaiming(kHuge, kHuge, std::endian::little)), refusal(kHuge, kHuge));
    EXPECT_THAT(messageOf(tiffClaiming(kHuge, kHuge, std::endian::big)), refusal(kHuge, kHuge));
    EXPECT_THAT(messageOf(bigTiffClaiming(std::uint64_t{1} << 62, 4)), refusal(std::uint64_t{1} << 62, 4));
    EXPECT_THAT(messageOf(webpClaiming("VP8X", kHuge, kHuge + 1)), refusal(kHuge, kHuge + 1));
    EXPECT_THAT(messageOf(bytesOf("P5 100000 100000 255 a")), refusal(kHuge, kHuge));
    EXPECT_THAT(messageOf(bytesOf("P2 4294967297 4294967297 255 1")), refusal(4294967297U, 4294967297U));

    MaskOptions options;
    options.max_pixels = 1 << 20;
    EXPECT_THAT(messageOf(webpClaiming("VP8L", 16383, 16384), options), refusal(16383, 16384, 1 << 20));
    EXPECT_THAT(messageOf(webpClaiming("VP8 ", 16383, 16382), options), refusal(16383, 16382, 1 << 20));
}

TEST(ImageBombs, TheLimitItselfIsAllowed)
{
    MaskOptions options;
    options.max_pixels = 6;
    EXPECT_NO_THROW(decodeMask(bytesOf("P1 3 2 101010\n"), options));
    EXPECT_THAT(messageOf(bytesOf("P1 7 1 1010101\n"), options), HasSubstr("7 x 1"));
    options.max_pixels = 0;
    EXPECT_THAT(messageOf(bytesOf("P1 1 1 1\n"), options), HasSubstr("limit of 0"));
}

TEST(ImageBombs, SizesOfZeroAreRefused)
{
    for (const auto& [width, height] : {std::pair{0U, 5U}, std::pair{5U, 0U}}) {
        const std::vector<Bytes> files{
            pngClaiming(width, height),
            jpegClaiming(width, height),
            bmpHeader(static_cast<int>(width), static_cast<int>(height), {}),
            tiffClaiming(width, height, std::endian::little),
            bigTiffClaiming(width, height),
            webpClaiming("VP8 ", width, height),
            bytesOf("P5 " + std::to_string(width) + " " + std::to_string(height) + " 255 abcdef"),
        };
        for (const Bytes& file : files) {
            EXPECT_THAT(messageOf(file), HasSubstr("zero"));
        }
    }
    Bytes negative = bmpHeader(-5, 5, {});
    EXPECT_THAT(messageOf(negative), HasSubstr("zero"));
}

TEST(ImageBombs, TileFarLargerThanItsImageIsRefused)
{
    TiffKind kind;
    kind.tile = 16;
    Bytes tiff = encodeTiff(noise(1, 8), kind);
    for (const std::uint8_t tag : {std::uint8_t{0x42}, std::uint8_t{0x43}}) {  // TileWidth, TileLength
        const Bytes field{std::byte{tag}, std::byte{0x01}, std::byte{3}, std::byte{0}};
        const auto at = std::search(tiff.begin(), tiff.end(), field.begin(), field.end());
        ASSERT_NE(at, tiff.end());
        *(at + 9) = std::byte{0xf0};
    }
    EXPECT_THAT(messageOf(tiff), HasSubstr("61456 x 61456"));
}

}  // namespace
}  // namespace droplet
