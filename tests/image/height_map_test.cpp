// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/image/height_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "image/encoded_images.h"

namespace droplet {
namespace {

using namespace encoded;
using testing::HasSubstr;
using testing::Not;

std::string errorOf(const Bytes& file, std::size_t max_pixels = kMaxHeightMapPixels)
{
    return messageOf([&] { (void)decodeHeightMap(file, max_pixels); });
}

void expectLevels(const HeightMap& map, const Raster& raster, int channel = 0)
{
    ASSERT_NO_THROW(map.validate());
    ASSERT_EQ(map.width, raster.width);
    ASSERT_EQ(map.height, raster.height);
    EXPECT_FALSE(map.in_floats);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            ASSERT_EQ(map.at(x, y), static_cast<float>(raster.level(x, y, channel))) << x << " " << y;
        }
    }
}

/// Heights of 13 × 7 pixels that a half represents exactly.
std::vector<double> someHeights()
{
    std::vector<double> heights;
    for (int i = 0; i < 13 * 7; ++i) {
        heights.push_back((i % 11 - 5) * std::ldexp(1.0, i % 23 - 14));
    }
    return heights;
}

struct FloatKind {
    int bits = 32;
    int channels = 1;
    int tile = 0;
    const char* mode = "wl";
    std::uint16_t compression = COMPRESSION_NONE;
    std::uint16_t predictor = 0;
    std::uint16_t orientation = 0;
    std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
};

/// Converts to a half; exact for the heights above.
std::uint16_t halfOf(double value)
{
    if (value == 0.0) {
        return 0;
    }
    int exponent = 0;
    const double fraction = std::frexp(std::abs(value), &exponent);  // [½, 1)
    const std::uint32_t sign = value < 0.0 ? 0x8000U : 0U;
    if (exponent < -13) {
        return static_cast<std::uint16_t>(sign | static_cast<std::uint32_t>(std::ldexp(std::abs(value), 24)));
    }
    return static_cast<std::uint16_t>(sign | static_cast<std::uint32_t>(exponent + 14) << 10 |
                                      (static_cast<std::uint32_t>(std::ldexp(fraction, 11)) & 0x3ffU));
}

template <class Number>
void append(std::vector<std::uint8_t>& bytes, Number number)
{
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof number);
    std::memcpy(bytes.data() + at, &number, sizeof number);
}

void appendSample(std::vector<std::uint8_t>& bytes, double value, int bits)
{
    if (bits == 16) {
        append(bytes, halfOf(value));
    } else if (bits == 32) {
        append(bytes, static_cast<float>(value));
    } else {
        append(bytes, value);
    }
}

Bytes floatTiff(const std::vector<double>& heights, const FloatKind& kind = {}, int width = 13, int height = 7)
{
    const Folder folder;
    const std::string path = (folder / "heights.tif").string();
    TIFF* tiff = TIFFOpen(path.c_str(), kind.mode);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, kind.bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, kind.channels);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, kind.photometric);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, kind.compression);
    if (kind.predictor != 0) {
        TIFFSetField(tiff, TIFFTAG_PREDICTOR, kind.predictor);
    }
    if (kind.orientation != 0) {
        TIFFSetField(tiff, TIFFTAG_ORIENTATION, kind.orientation);
    }
    const auto at = [&](int x, int y) {
        const bool inside = x < width && y < height;
        return inside ? heights[static_cast<std::size_t>(y * width + x)] : 99.0;
    };
    const int columns = kind.tile == 0 ? width : kind.tile;
    const int rows = kind.tile == 0 ? 1 : kind.tile;
    if (kind.tile != 0) {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, kind.tile);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, kind.tile);
    } else {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 3);
    }
    for (int y0 = 0; y0 < height; y0 += rows) {
        for (int x0 = 0; x0 < width; x0 += columns) {
            std::vector<std::uint8_t> bytes;
            for (int y = y0; y < y0 + rows; ++y) {
                for (int x = x0; x < x0 + columns; ++x) {
                    for (int c = 0; c < kind.channels; ++c) {
                        appendSample(bytes, at(x, y), kind.bits);
                    }
                }
            }
            // For this predictor libtiff's writer (4.5), unlike its reader, swaps the samples of files in the other
            // byte order.
            if (kind.predictor == PREDICTOR_FLOATINGPOINT && std::string(kind.mode) == "wb") {
                const auto size = static_cast<std::ptrdiff_t>(kind.bits / 8);
                for (auto sample = bytes.begin(); sample != bytes.end(); sample += size) {
                    std::reverse(sample, sample + size);
                }
            }
            if (kind.tile != 0) {
                TIFFWriteTile(tiff, bytes.data(), static_cast<std::uint32_t>(x0), static_cast<std::uint32_t>(y0), 0, 0);
            } else {
                TIFFWriteScanline(tiff, bytes.data(), static_cast<std::uint32_t>(y0), 0);
            }
        }
    }
    TIFFClose(tiff);
    return contentOf(path);
}

TEST(HeightMap, GreyIsAShareOfWhite)
{
    for (const int bits : {8, 16}) {
        const Raster raster = noise(1, bits);
        expectLevels(decodeHeightMap(encodePng(raster, {})), raster);
        expectLevels(decodeHeightMap(encodeTiff(raster, {})), raster);
    }
    // Levels are not processed as by Channel::Auto of a mask.
    EXPECT_EQ(decodeHeightMap(bytesOf("P5 1 1 255 \x33")).levels, std::vector<float>{0.2F});
}

TEST(HeightMap, EveryFormatOfAMaskIsRead)
{
    const Raster grey = fields(1, 2, 2);
    const Raster colour = fields(3, 2, 2);
    for (const Bytes& file :
         {encodeJpeg(grey), encodeJpeg(colour), encodeWebp(noise(3, 8)), encodeWithOpenCv(noise(3, 8), ".bmp"),
          encodeTga(noise(3, 8)), encodeGif(noise(1, 8), {13, 7, 0, 0, false, -1}), bytesOf("P6 2 1 255 abcdef"),
          bytesOf("P4 2 1 \x40"), encodeWithOpenCv(fields(3, 4, 4), ".jp2")}) {
        const HeightMap map = decodeHeightMap(file);
        ASSERT_NO_THROW(map.validate());
        const Mask mask = decodeMask(file, only(Channel::Luma));
        ASSERT_EQ(map.levels.size(), mask.coverage.size());
        for (std::size_t i = 0; i < map.levels.size(); ++i) {
            ASSERT_EQ(map.levels[i], static_cast<float>(mask.coverage[i]) / 65535.0F);
        }
    }
}

TEST(HeightMap, FloatsAreAsStored)
{
    const std::vector<double> heights = someHeights();
    std::vector<FloatKind> kinds;
    for (const int bits : {32, 64}) {
        for (const char* mode : {"wl", "wb", "wl8"}) {
            for (const int tile : {0, 16}) {
                for (const int codec : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
                    const auto compression = static_cast<std::uint16_t>(codec);
                    FloatKind kind{bits, 1, tile, mode, compression, 0, 0, PHOTOMETRIC_MINISBLACK};
                    kinds.push_back(kind);
                    if (compression != COMPRESSION_NONE) {
                        kind.predictor = PREDICTOR_FLOATINGPOINT;
                        kinds.push_back(kind);
                    }
                }
            }
        }
    }
    for (const FloatKind& kind : kinds) {
        SCOPED_TRACE(std::to_string(kind.bits) + kind.mode + std::to_string(kind.tile) + " " +
                     std::to_string(kind.compression) + " " + std::to_string(kind.predictor));
        const HeightMap map = decodeHeightMap(floatTiff(heights, kind));
        EXPECT_TRUE(map.in_floats);
        ASSERT_EQ(map.levels.size(), heights.size());
        for (std::size_t i = 0; i < heights.size(); ++i) {
            ASSERT_EQ(map.levels[i], static_cast<float>(heights[i])) << i;
        }
    }
}

TEST(HeightMap, FloatsOfOpenExrAndHdrAreAsStoredAndColoursGiveLuma)
{
    const cv::Mat grey = (cv::Mat_<float>(1, 3) << 0.25, 0.5, 768);
    cv::Mat colour;
    cv::merge(std::vector<cv::Mat>{grey, grey, grey}, colour);
    for (const Bytes& file : {encodeMat(grey, ".exr"), encodeMat(colour, ".exr"), encodeMat(colour, ".hdr")}) {
        const HeightMap map = decodeHeightMap(file);
        EXPECT_TRUE(map.in_floats);
        EXPECT_THAT(map.levels, testing::ElementsAre(0.25F, 0.5F, 768.0F));
    }
    const cv::Mat green(1, 1, CV_32FC3, cv::Scalar(0, 2, 0));
    EXPECT_FLOAT_EQ(decodeHeightMap(encodeMat(green, ".exr")).levels[0], 1.174F);
}

TEST(HeightMap, FloatsAreTurnedUpright)
{
    const std::vector<double> heights{0, 1, 2, 3, 4, 5};  // 3 × 2
    const std::vector<std::vector<float>> upright{{0, 1, 2, 3, 4, 5}, {2, 1, 0, 5, 4, 3}, {5, 4, 3, 2, 1, 0},
                                                  {3, 4, 5, 0, 1, 2}, {0, 3, 1, 4, 2, 5}, {3, 0, 4, 1, 5, 2},
                                                  {5, 2, 4, 1, 3, 0}, {2, 5, 1, 4, 0, 3}};
    for (std::uint16_t orientation = 1; orientation <= 8; ++orientation) {
        FloatKind kind;
        kind.orientation = orientation;
        const HeightMap map = decodeHeightMap(floatTiff(heights, kind, 3, 2));
        EXPECT_EQ(map.width, orientation > 4 ? 2 : 3);
        EXPECT_EQ(map.levels, upright[orientation - 1U]) << orientation;
    }
}

TEST(HeightMap, RejectsNonFiniteHeightsWithTheirPlace)
{
    for (const double wrong :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e300}) {
        std::vector<double> heights = someHeights();
        heights[2 * 13 + 5] = wrong;
        FloatKind kind;
        kind.bits = 64;
        EXPECT_THAT(errorOf(floatTiff(heights, kind)), HasSubstr("at pixel (5, 2)"));
    }
    FloatKind half;
    half.bits = 16;
    EXPECT_THAT(errorOf(floatTiff(someHeights(), half)), HasSubstr("unsupported TIFF image"));
    EXPECT_THAT(errorOf(floatTiff(someHeights()), 90), HasSubstr("13 x 7"));
    EXPECT_THAT(errorOf(bytesOf("heights")), Not(testing::IsEmpty()));
    // A TIFF of floats is still not accepted as a mask.
    EXPECT_THAT(messageOf(floatTiff(someHeights())), HasSubstr("not unsigned integers"));
}

TEST(HeightMap, CutFilesAreReadWholeOrRejectedWithoutOutput)
{
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    FloatKind lzw;
    lzw.compression = COMPRESSION_LZW;
    lzw.predictor = PREDICTOR_FLOATINGPOINT;
    FloatKind tiled;
    tiled.bits = 64;
    tiled.tile = 16;
    tiled.mode = "wb8";
    for (const Bytes& file : {floatTiff(someHeights()), floatTiff(someHeights(), lzw), floatTiff(someHeights(), tiled),
                              encodePng(noise(1, 16), {}), encodeTiff(noise(1, 16), {}), encodeJpeg(fields(1, 2, 2))}) {
        const HeightMap whole = decodeHeightMap(file);
        for (std::size_t size = 0; size < file.size(); ++size) {
            const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
            try {
                EXPECT_EQ(decodeHeightMap(cut).levels, whole.levels) << size << " of " << file.size();
                EXPECT_LE(file.size() - size, 8U) << "TIFF's pointer to the next image";
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
                EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
            }
        }
        for (std::size_t at = 0; at < file.size(); ++at) {
            for (const std::byte flip : {std::byte{0x01}, std::byte{0x80}, std::byte{0xff}}) {
                Bytes damaged = file;
                damaged[at] ^= flip;
                try {
                    decodeHeightMap(damaged, 1 << 16).validate();
                } catch (const Error& error) {
                    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
                }
            }
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(HeightMap, ErrorsNameTheFile)
{
    const Bytes good = floatTiff(someHeights());
    const Folder folder;
    writeFile(folder / "good.tif", good);
    EXPECT_EQ(readHeightMap(folder / "good.tif").levels, decodeHeightMap(good).levels);
    writeFile(folder / "bad.png", bytesOf("\x89PNG\r\n\x1a\n"));
    EXPECT_THAT(messageOf([&] { (void)readHeightMap(folder / "bad.png"); }), HasSubstr("bad.png: "));
    EXPECT_THAT(messageOf([&] { (void)readHeightMap(folder / "none.png"); }), HasSubstr("none.png: No such file"));
}

TEST(HeightMap, ValidatesItsInvariant)
{
    EXPECT_NO_THROW((HeightMap{2, 1, {0, 1}, false}.validate()));
    EXPECT_THROW((HeightMap{0, 1, {}, false}.validate()), Error);
    EXPECT_THROW((HeightMap{2, 2, {0, 1}, false}.validate()), Error);
    EXPECT_THROW((HeightMap{2, 1, {0, std::numeric_limits<float>::infinity()}, true}.validate()), Error);
}

}  // namespace
}  // namespace droplet
