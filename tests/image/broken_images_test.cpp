// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of files that are cut at every length, damaged at every byte, or state a wrong size.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <iostream>
#include <thread>

#include "image/encoded_images.h"

namespace droplet {
namespace {

using namespace encoded;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// One small file of every format.
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
    palette.palette.resize(6, 40000);
    TiffKind tiled;
    tiled.tile = 16;
    tiled.mode = "w8";
    tiled.compression = COMPRESSION_ADOBE_DEFLATE;
    BmpKind runs{40, 8, 1, false, 2, {}};
    appendLittle(runs.after_header, 0x00ffffff00000000U, 8);
    Bytes run_bmp = bmpHeader(5, 2, runs);
    appendLittle(run_bmp, 0x0105'0000'0005U, 6);
    appendLittle(run_bmp, 0x0100, 2);
    Bytes true_bmp = bmpHeader(3, 2, {40, 24, 0, false, 0, {}});
    true_bmp.resize(true_bmp.size() + 24, std::byte{0x5a});
    Bytes tga_runs = tgaHeader(5, 2, {10, 24, 0x20, {}});
    appendLittle(tga_runs, 0x50ff00'84U, 4);
    appendLittle(tga_runs, 0x808080'84U, 4);
    Bytes ico_bitmap = bmpHeader(2, 4, {40, 24, 0, false, 0, {}});
    ico_bitmap.erase(ico_bitmap.begin(), ico_bitmap.begin() + 14);
    ico_bitmap.resize(ico_bitmap.size() + 24, std::byte{0x5a});
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
        {"gif", encodeGif(noise(1, 2), {15, 9, 1, 1, true, 3})},
        {"tga", encodeTga(noise(4, 8))},
        {"tga runs", tga_runs},
        {"ico", encodeIco({{2, ico_bitmap}})},
        {"ico png", encodeIco({{9, encodePng(noise(4, 8), {PNG_COLOR_TYPE_RGB_ALPHA, false, {}, {}, nullptr})}})},
        {"webp animation", webpAnimation(encodeWebp(noise(4, 8), 80), 13, 7, {15, 9, 2, 2, false, -1})},
        {"tiff grey", encodeTiff(noise(1, 16), {})},
        {"tiff lzw", encodeTiff(noise(4, 8), lzw)},
        {"tiff fax", encodeTiff(noise(1, 1), fax)},
        {"tiff palette", encodeTiff(noise(1, 1), palette)},
        {"tiff big, tiled", encodeTiff(noise(1, 8), tiled)},
        {"webp", encodeWebp(noise(3, 8), 80)},
        {"webp alpha", encodeWebp(noise(4, 8), 80)},
        {"webp lossless", encodeWebp(noise(4, 8))},
        {"webp exif", webpWithExif(encodeWebp(noise(3, 8)), 13, 7, exifBlock(3, std::endian::little))},
        {"pbm plain", bytesOf("P1 3 2\n101\n010\n")},
        {"pgm plain", bytesOf("P2 2 2 255 12 200 255 1\n")},
        {"ppm raw", bytesOf("P6 2 1 255 abcdef")},
        {"jpeg 2000", encodeWithOpenCv(fields(3, 4, 4), ".jp2")},
        {"openexr", encodeMat(cv::Mat(5, 4, CV_32FC3, cv::Scalar(0.1, 0.5, 1)), ".exr")},
        {"hdr", encodeMat(cv::Mat(5, 4, CV_32FC3, cv::Scalar(0.1, 0.5, 1)), ".hdr")},
    };
}

TEST(BrokenImages, CutFilesAreReadWholeOrRejectedWithoutOutput)
{
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    for (const auto& [name, file] : smallFiles()) {
        SCOPED_TRACE(name);
        const Mask whole = decodeMask(file, only(Channel::Luma));
        for (std::size_t size = 0; size < file.size(); ++size) {
            // This is a copy, so that a sanitizer detects reads past the end.
            const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
            try {
                const Mask mask = decodeMask(cut, only(Channel::Luma));
                EXPECT_EQ(mask.coverage, whole.coverage) << size << " of " << file.size();
                // Only bytes after the last pixel may be missing, and only where no field shows it: TIFF's pointer to
                // the next image, the end of a line, the mark that ends run lengths.
                EXPECT_LE(file.size() - size, name.starts_with("tiff")  ? 8U
                                              : name.ends_with("plain") ? 1U
                                              : name == "bmp runs"      ? 2U
                                              : name == "gif"           ? 4U
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

TEST(BrokenImages, DamagedFilesAreReadOrRejectedWithoutOutput)
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

// Images that OpenCV decodes are rejected when it allocates memory for the pixels.
TEST(ImageBombs, OfEveryFormatAreRejectedByTheirHeader)
{
    const auto refusal = [](std::uint64_t width, std::uint64_t height, std::size_t limit = std::size_t{1} << 28) {
        return AllOf(HasSubstr(std::to_string(width) + " x " + std::to_string(height)),
                     HasSubstr("limit of " + std::to_string(limit)));
    };
    constexpr std::uint32_t kHuge = 100000;
    EXPECT_THAT(messageOf(pngClaiming(kHuge, kHuge)), refusal(kHuge, kHuge));
    EXPECT_THAT(messageOf(pngClaiming(0x7fffffff, 0x7fffffff)), refusal(0x7fffffff, 0x7fffffff));
    EXPECT_THAT(messageOf(jpegClaiming(65535, 65534)), refusal(65535, 65534));
    EXPECT_THAT(messageOf(bmpHeader(20000, 15000, {})), refusal(20000, 15000));
    EXPECT_THAT(messageOf(bytesOf("P5 20000 15000 255 a")), refusal(20000, 15000));
    EXPECT_THAT(messageOf(bytesOf("P5 100000 100000 255 a")), HasSubstr("over 2^20 pixels a side or 2^30 in all"));
    EXPECT_THAT(messageOf(bytesOf("P2 4294967297 4294967297 255 1")), HasSubstr("too large"));

    MaskOptions options;
    options.max_pixels = 90;
    for (const char* extension : {".tif", ".webp", ".bmp", ".pgm"}) {
        EXPECT_THAT(messageOf(encodeWithOpenCv(noise(1, 8), extension), options), refusal(13, 7, 90)) << extension;
    }
    EXPECT_THAT(messageOf(encodeWithOpenCv(fields(1, 4, 4), ".jp2"), options), refusal(32, 32, 90));
    for (const char* extension : {".exr", ".hdr"}) {
        const cv::Mat image(7, 13, CV_32FC3, cv::Scalar(0.1, 0.5, 1));
        EXPECT_THAT(messageOf(encodeMat(image, extension), options), refusal(13, 7, 90)) << extension;
    }
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

TEST(ImageBombs, SizesOfZeroAreRejected)
{
    for (const auto& [width, height] : {std::pair{0U, 5U}, std::pair{5U, 0U}}) {
        EXPECT_THAT(messageOf(pngClaiming(width, height)), HasSubstr("zero"));
        EXPECT_THAT(messageOf(jpegClaiming(width, height)), HasSubstr("zero"));
        EXPECT_THAT(messageOf(bmpHeader(static_cast<int>(width), static_cast<int>(height), {})), HasSubstr("BMP"));
    }
}

TEST(ImageMessages, OpenCvsBecomeReasonsAndThoseOfOtherThreadsPass)
{
    testing::internal::CaptureStderr();
    std::atomic<bool> ends = false;
    std::thread other([&] {
        while (!ends) {
            std::cerr << "own words\n";
        }
    });
    const Bytes whole = encodeWithOpenCv(noise(1, 16), ".pgm");
    for (int i = 0; i < 20; ++i) {
        EXPECT_THAT(messageOf(Bytes(whole.begin(), whole.end() - 1)),
                    HasSubstr("unsupported PBM/PGM/PPM image: Unexpected end of input stream"));
    }
    ends = true;
    other.join();
    std::cerr << "own words\n";
    std::string captured = testing::internal::GetCapturedStderr();
    for (std::size_t at = 0; at < captured.size(); at += 10) {
        ASSERT_EQ(captured.substr(at, 10), "own words\n");
    }
    EXPECT_GT(captured.size(), 0U);
}

}  // namespace
}  // namespace droplet
