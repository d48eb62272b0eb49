// SPDX-License-Identifier: GPL-3.0-or-later
// Compares every format, depth and colour type with the samples that were encoded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "image/encoded_images.h"

namespace droplet {
namespace {

using namespace encoded;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

using LevelAt = std::function<double(int, int)>;

/// Compares the luma over black and the alpha of an encoded image exactly with expected levels.
void expectLevels(const Bytes& encoded, int width, int height, const LevelAt& luma, const LevelAt& alpha = nullptr)
{
    const Mask bright = decodeMask(encoded, only(Channel::Luma));
    ASSERT_EQ(bright.width, width);
    ASSERT_EQ(bright.height, height);
    EXPECT_NO_THROW(bright.validate());
    Mask opaque;
    if (alpha) {
        opaque = decodeMask(encoded, only(Channel::Alpha));
        EXPECT_NO_THROW(opaque.validate());
    } else {
        EXPECT_THROW(decodeMask(encoded, only(Channel::Alpha)), Error) << "has an alpha it should not have";
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            // Luma is rounded once, and again if it is weighted by alpha.
            const double level = luma(x, y) * (alpha ? alpha(x, y) : 1.0);
            ASSERT_NEAR(bright.at(x, y), level * 65535, alpha ? 1.001 : 0.501) << x << ", " << y;
            if (alpha) {
                ASSERT_NEAR(opaque.at(x, y), alpha(x, y) * 65535, 1e-6) << x << ", " << y;
            }
        }
    }
}

double luma(double r, double g, double b)
{
    return 0.299 * r + 0.587 * g + 0.114 * b;
}

/// Compares an encoded image with samples of grey, grey+alpha, RGB or RGB+alpha.
void expectRaster(const Bytes& encoded, const Raster& raster)
{
    const LevelAt bright = [&](int x, int y) {
        return raster.channels < 3 ? raster.level(x, y, 0)
                                   : luma(raster.level(x, y, 0), raster.level(x, y, 1), raster.level(x, y, 2));
    };
    const LevelAt alpha = [&](int x, int y) { return raster.level(x, y, raster.channels - 1); };
    expectLevels(encoded, raster.width, raster.height, bright, raster.channels % 2 == 0 ? alpha : nullptr);
}

/// Compares levels to 8 bits, for decoders that keep colours with 8 bits.
void expectNearly(const Bytes& encoded, int width, int height, const LevelAt& luma)
{
    const Mask mask = decodeMask(encoded, only(Channel::Luma));
    ASSERT_EQ(mask.width, width);
    ASSERT_EQ(mask.height, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            ASSERT_NEAR(mask.at(x, y) / 65535.0, luma(x, y), 1.0 / 255) << x << ", " << y;
        }
    }
}

TEST(ReadPng, EveryDepthAndColourTypeInterlacedOrNot)
{
    struct Case {
        int colour_type;
        int channels;
        std::vector<int> depths;
    };
    for (const auto& [colour_type, channels, depths] :
         {Case{PNG_COLOR_TYPE_GRAY, 1, {1, 2, 4, 8, 16}}, Case{PNG_COLOR_TYPE_GRAY_ALPHA, 2, {8, 16}},
          Case{PNG_COLOR_TYPE_RGB, 3, {8, 16}}, Case{PNG_COLOR_TYPE_RGB_ALPHA, 4, {8, 16}}}) {
        for (const int bits : depths) {
            for (const bool interlaced : {false, true}) {
                SCOPED_TRACE(testing::Message() << channels << " channels, " << bits << " bits, " << interlaced);
                const Raster raster = noise(channels, bits);
                expectRaster(encodePng(raster, {colour_type, interlaced, {}, {}, nullptr}), raster);
            }
        }
    }
}

TEST(ReadPng, InterlacedOfEverySmallSize)
{
    for (int width = 1; width <= 9; ++width) {
        for (int height = 1; height <= 9; ++height) {
            const Raster raster = noise(1, 16, width, height);
            expectRaster(encodePng(raster, {PNG_COLOR_TYPE_GRAY, true, {}, {}, nullptr}), raster);
        }
    }
}

TEST(ReadPng, PaletteWithAndWithoutTransparency)
{
    for (const int bits : {1, 2, 4, 8}) {
        for (const bool transparent : {false, true}) {
            SCOPED_TRACE(testing::Message() << bits << " bits, " << transparent);
            const Raster indices = noise(1, bits);
            PngKind kind;
            kind.colour_type = PNG_COLOR_TYPE_PALETTE;
            kind.interlaced = bits == 4;
            for (unsigned i = 0; i <= indices.white(); ++i) {
                kind.palette.push_back(
                    {static_cast<png_byte>(i * 7 + 3), static_cast<png_byte>(200 - i), static_cast<png_byte>(i * 31)});
                if (transparent && i < 2) {
                    kind.palette_alpha.push_back(static_cast<png_byte>(90 * i + 5));  // other colours are opaque
                }
            }
            const LevelAt bright = [&](int x, int y) {
                const png_color& colour = kind.palette[indices.at(x, y, 0)];
                return luma(colour.red, colour.green, colour.blue) / 255;
            };
            const LevelAt alpha = [&](int x, int y) {
                const unsigned index = indices.at(x, y, 0);
                return index < 2 ? kind.palette_alpha[index] / 255.0 : 1.0;
            };
            expectLevels(encodePng(indices, kind), 13, 7, bright, transparent ? alpha : nullptr);
        }
    }
}

TEST(ReadPng, OneTransparentGreyOrColour)
{
    for (const int bits : {1, 2, 4, 8, 16}) {
        const Raster grey = noise(1, bits);
        const unsigned clear = grey.at(4, 3, 0);
        png_color_16 key{};
        key.gray = static_cast<png_uint_16>(clear);
        expectLevels(
            encodePng(grey, {PNG_COLOR_TYPE_GRAY, false, {}, {}, &key}), 13, 7,
            [&](int x, int y) { return grey.level(x, y, 0); },
            [&](int x, int y) { return grey.at(x, y, 0) == clear ? 0.0 : 1.0; });
    }
    for (const int bits : {8, 16}) {
        const Raster colour = noise(3, bits);
        png_color_16 key{};
        key.red = static_cast<png_uint_16>(colour.at(4, 3, 0));
        key.green = static_cast<png_uint_16>(colour.at(4, 3, 1));
        key.blue = static_cast<png_uint_16>(colour.at(4, 3, 2));
        expectLevels(
            encodePng(colour, {PNG_COLOR_TYPE_RGB, false, {}, {}, &key}), 13, 7,
            [&](int x, int y) { return luma(colour.level(x, y, 0), colour.level(x, y, 1), colour.level(x, y, 2)); },
            [&](int x, int y) { return x == 4 && y == 3 ? 0.0 : 1.0; });
    }
}

TEST(ReadPng, ADamagedTransparencyIsNotDropped)
{
    const Raster grey = noise(1, 8);
    png_color_16 key{};
    key.gray = 100;
    Bytes png = encodePng(grey, {PNG_COLOR_TYPE_GRAY, false, {}, {}, &key});
    const Bytes type = bytesOf("tRNS");
    const auto chunk = std::search(png.begin(), png.end(), type.begin(), type.end());
    ASSERT_NE(chunk, png.end());
    *(chunk + 5) ^= std::byte{1};
    EXPECT_THAT(messageOf(png), AllOf(HasSubstr("damaged PNG"), HasSubstr("CRC")));
}

TEST(ReadTiff, GreyAndColourOfEightAndSixteenBits)
{
    for (const int channels : {1, 3, 4}) {
        for (const int bits : {8, 16}) {
            for (const int tile : {0, 16}) {
                for (const char* mode : {"wl", "wb8"}) {
                    SCOPED_TRACE(testing::Message() << channels << " " << bits << " " << tile << " " << mode);
                    const Raster raster = noise(channels, bits, 37, 19);
                    TiffKind kind;
                    kind.photometric = channels == 1 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB;
                    kind.tile = tile;
                    kind.mode = mode;
                    kind.compression = COMPRESSION_LZW;
                    expectRaster(encodeTiff(raster, kind), raster);
                }
            }
        }
    }
}

TEST(ReadTiff, WhiteIsZeroAndFax)
{
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_CCITTFAX4}) {
        for (const int photometric : {PHOTOMETRIC_MINISWHITE, PHOTOMETRIC_MINISBLACK}) {
            const Raster raster = noise(1, 1, 37, 19);
            TiffKind kind;
            kind.photometric = static_cast<std::uint16_t>(photometric);
            kind.compression = static_cast<std::uint16_t>(compression);
            const bool negative = photometric == PHOTOMETRIC_MINISWHITE;
            expectLevels(encodeTiff(raster, kind), 37, 19,
                         [&](int x, int y) { return negative ? 1.0 - raster.level(x, y, 0) : raster.level(x, y, 0); });
        }
    }
}

TEST(ReadTiff, Palette)
{
    for (const int bits : {1, 8}) {
        const Raster indices = noise(1, bits);
        TiffKind kind;
        kind.photometric = PHOTOMETRIC_PALETTE;
        const unsigned size = indices.white() + 1;
        for (unsigned i = 0; i < 3 * size; ++i) {
            kind.palette.push_back(static_cast<std::uint16_t>(i * 20011 + 300));
        }
        expectNearly(encodeTiff(indices, kind), 13, 7, [&](int x, int y) {
            const unsigned i = indices.at(x, y, 0);
            return luma(kind.palette[i], kind.palette[size + i], kind.palette[2 * size + i]) / 65535;
        });
    }
}

TEST(ReadTiff, FourthSamplesAreAlphaOnlyIfTheFileSaysSo)
{
    for (const int bits : {8, 16}) {
        const Raster raster = noise(4, bits);
        const LevelAt colour = [&](int x, int y) {
            return luma(raster.level(x, y, 0), raster.level(x, y, 1), raster.level(x, y, 2));
        };
        const LevelAt seen = [&](int x, int y) { return colour(x, y) * raster.level(x, y, 3); };
        TiffKind kind;
        kind.photometric = PHOTOMETRIC_RGB;
        expectRaster(encodeTiff(raster, kind), raster);  // no ExtraSamples field, as OpenCV writes them

        kind.extra_samples = {EXTRASAMPLE_UNSPECIFIED};
        expectLevels(encodeTiff(raster, kind), 13, 7, colour);

        // Colours are premultiplied: the stored luma is the one in front of black.
        for (const int extra : {EXTRASAMPLE_ASSOCALPHA, EXTRASAMPLE_UNASSALPHA}) {
            kind.extra_samples = {static_cast<std::uint16_t>(extra)};
            const Bytes encoded = encodeTiff(raster, kind);
            expectNearly(encoded, 13, 7, extra == EXTRASAMPLE_ASSOCALPHA ? colour : seen);
            const Mask alpha = decodeMask(encoded, only(Channel::Alpha));
            for (int y = 0; y < 7; ++y) {
                for (int x = 0; x < 13; ++x) {
                    EXPECT_EQ(alpha.at(x, y), std::lround(raster.level(x, y, 3) * 65535));
                }
            }
        }
    }
}

TEST(ReadTiff, Cmyk)
{
    const Raster raster = noise(4, 8);
    TiffKind kind;
    kind.photometric = PHOTOMETRIC_SEPARATED;
    expectNearly(encodeTiff(raster, kind), 13, 7, [&](int x, int y) {
        const auto light = [&](int c) { return (1 - raster.level(x, y, c)) * (1 - raster.level(x, y, 3)); };
        return luma(light(0), light(1), light(2));
    });
}

// OpenCV 4.6 would silently read most of these wrongly.
TEST(ReadTiff, UnsupportedKindsAreNamed)
{
    const auto refusal = [](int channels, int bits, const std::function<void(TiffKind&)>& set) {
        TiffKind kind;
        kind.photometric = channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB;
        set(kind);
        return messageOf(encodeTiff(noise(channels, bits), kind));
    };
    for (const int bits : {8, 16}) {
        EXPECT_THAT(refusal(2, bits, [](TiffKind& kind) { kind.extra_samples = {EXTRASAMPLE_UNASSALPHA}; }),
                    HasSubstr("grey with alpha"));
        for (const int channels : {1, 3}) {
            EXPECT_THAT(refusal(channels, bits, [](TiffKind& kind) { kind.sample_format = SAMPLEFORMAT_INT; }),
                        HasSubstr("not unsigned integers"));
        }
    }
    for (const int channels : {3, 4}) {
        EXPECT_THAT(refusal(channels, 16, [](TiffKind& kind) { kind.separate = true; }),
                    HasSubstr("separate colour planes"));
    }
    EXPECT_THAT(refusal(1, 16, [](TiffKind& kind) { kind.photometric = PHOTOMETRIC_MINISWHITE; }),
                HasSubstr("photometric interpretation 0"));
    EXPECT_THAT(refusal(1, 4, [](TiffKind&) {}), HasSubstr("unsupported TIFF image: Invalid bitsperpixel value"));
    EXPECT_THAT(refusal(1, 16, [](TiffKind& kind) { kind.sample_format = SAMPLEFORMAT_IEEEFP; }),
                HasSubstr("unsupported TIFF image"));
    EXPECT_THAT(refusal(5, 8, [](TiffKind& kind) { kind.extra_samples = {0, 2}; }), HasSubstr("channels"));
}

TEST(ReadJpeg, GreyAndColourBaselineAndProgressive)
{
    for (const int channels : {1, 3}) {
        for (const bool progressive : {false, true}) {
            const Raster raster = fields(channels, 4, 2);
            const Mask mask = decodeMask(encodeJpeg(raster, {progressive, true, 100, {}}), only(Channel::Luma));
            ASSERT_EQ(mask.width, 32);
            ASSERT_EQ(mask.height, 16);
            for (int y = 0; y < 16; ++y) {
                for (int x = 0; x < 32; ++x) {
                    const double level = channels == 1
                                             ? raster.at(x, y, 0)
                                             : luma(raster.at(x, y, 0), raster.at(x, y, 1), raster.at(x, y, 2));
                    ASSERT_NEAR(mask.at(x, y) / 257.0, level, 1.01);
                }
            }
        }
    }
}

TEST(ReadJpeg, Cmyk)
{
    const Raster raster = fields(4, 4, 2);
    for (const bool adobe : {true, false}) {
        const Mask mask = decodeMask(encodeJpeg(raster, {false, adobe, 100, {}}), only(Channel::Luma));
        for (int y = 0; y < 16; ++y) {
            for (int x = 0; x < 32; ++x) {
                // Adobe stores the remaining paper, others store the ink.
                const auto paper = [&](int c) { return adobe ? raster.level(x, y, c) : 1 - raster.level(x, y, c); };
                const double level = paper(3) * luma(paper(0), paper(1), paper(2));
                ASSERT_NEAR(mask.at(x, y) / 65535.0, level, 2.5 / 255) << adobe;
            }
        }
    }
}

TEST(ReadJpeg, CutAnywhereIsAnErrorEvenWithinTheLastBytes)
{
    const Bytes whole = encodeJpeg(fields(3, 4, 4), {false, true, 90, {}});
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_THROW(decodeMask(std::span(whole).first(size)), Error) << size << " of " << whole.size();
    }
}

TEST(ReadJpeg, EndMarkBeforeThePixelsEndIsAnError)
{
    // libjpeg would fill the rest with grey and warn.
    Bytes jpeg = encodeJpeg(noise(3, 8, 64, 64), {false, true, 90, {}});
    ASSERT_GT(jpeg.size(), 3000U);
    jpeg.erase(jpeg.end() - 402, jpeg.end() - 2);
    EXPECT_THAT(messageOf(jpeg), HasSubstr("damaged JPEG"));
}

TEST(ReadJpeg, ProgressiveFileOfVeryManyScansIsRejected)
{
    // Every coefficient alone, from its 10th bit down: the largest number of scans that libjpeg writes.
    JpegKind kind;
    constexpr int kTopBit = 10;
    for (int coefficient = 0; coefficient < 64; ++coefficient) {
        for (int bit = kTopBit; bit >= 0; --bit) {
            kind.scans.push_back({1, {0}, coefficient, coefficient, bit == kTopBit ? 0 : bit + 1, bit});
        }
    }
    EXPECT_THAT(messageOf(encodeJpeg(fields(1, 1, 1), kind)), HasSubstr("more than 500 scans"));
    kind.scans.resize(11);  // the first coefficient is enough for these fields
    EXPECT_EQ(decodeMask(encodeJpeg(fields(1, 1, 1), kind), only(Channel::Luma)).at(3, 3),
              decodeMask(encodeJpeg(fields(1, 1, 1)), only(Channel::Luma)).at(3, 3));
}

TEST(ReadBmp, PalettesRunLengthsAndTrueColour)
{
    const Raster raster = noise(3, 8);
    expectRaster(encodeWithOpenCv(raster, ".bmp"), raster);
    expectRaster(encodeWithOpenCv(noise(1, 8), ".bmp"), noise(1, 8));

    BmpKind kind{40, 8, 1, true, 3, {}};
    for (const unsigned grey : {0U, 100U, 255U}) {
        appendLittle(kind.after_header, grey | grey << 8 | grey << 16, 4);
    }
    Bytes runs = bmpHeader(5, 2, kind);
    for (const unsigned byte : {5U, 1U, 0U, 0U, 3U, 2U, 2U, 0U, 0U, 1U}) {
        runs.push_back(static_cast<std::byte>(byte));
    }
    EXPECT_THAT(decodeMask(runs, only(Channel::Luma)).coverage,
                ElementsAre(25700, 25700, 25700, 25700, 25700, 65535, 65535, 65535, 0, 0));
}

TEST(ReadBmp, FourthByteIsRejectedIfItIsUsed)
{
    for (const unsigned alpha : {0x00U, 0xffU}) {
        Bytes bmp = bmpHeader(2, 1, {40, 32, 0, false, 0, {}});
        appendLittle(bmp, 0x00ffffff | alpha << 24, 4);
        appendLittle(bmp, 0x00000000 | alpha << 24, 4);
        expectLevels(bmp, 2, 1, [](int x, int) { return x == 0 ? 1.0 : 0.0; });
        bmp.back() = std::byte{0x80};
        EXPECT_THAT(messageOf(bmp), HasSubstr("32 bits per pixel with alpha"));
    }
}

TEST(ReadWebp, LosslessIsExact)
{
    expectRaster(encodeWebp(noise(3, 8)), noise(3, 8));
    expectRaster(encodeWebp(noise(4, 8)), noise(4, 8));
}

TEST(ReadNetpbm, EveryKind)
{
    expectRaster(encodeWithOpenCv(noise(1, 8), ".pgm"), noise(1, 8));
    expectRaster(encodeWithOpenCv(noise(3, 16), ".ppm"), noise(3, 16));
    const auto levels = [](std::string_view text) { return decodeMask(bytesOf(text), only(Channel::Luma)).coverage; };
    EXPECT_THAT(levels("P1\n# black is one\n3 2\n101\n0 1 0\n"), ElementsAre(0, 65535, 0, 65535, 0, 65535));
    EXPECT_THAT(levels("P4 3 2 \xa0\x40"), ElementsAre(0, 65535, 0, 65535, 0, 65535));
    EXPECT_THAT(levels("P2\r\n3 # three\r\n1\r\n255\r\n0 #a\n51 255\r\n"), ElementsAre(0, 13107, 65535));
    EXPECT_THAT(levels("P3 2 1 65535 65535 65535 65535 0 65535 0\n"), ElementsAre(65535, std::lround(0.587 * 65535)));
}

// OpenCV 4.6 treats most levels as shares of 255 or 65535, whatever the level of white is.
TEST(ReadNetpbm, EveryLevelOfWhite)
{
    const auto levels = [](std::string_view text) { return decodeMask(bytesOf(text), only(Channel::Luma)).coverage; };
    EXPECT_THAT(levels("P2 2 1 1 0 1\n"), ElementsAre(0, 65535));
    EXPECT_THAT(levels("P2 # a #\n3 1 1000 0 500 1000\n"), ElementsAre(0, 32768, 65535));
    EXPECT_THAT(levels("P5 3 1 9 \x01\x05\x09"), ElementsAre(7282, 36408, 65535));
    EXPECT_THAT(levels(std::string_view("P6 1 1 256 \x01\0\x01\0\x01\0", 17)), ElementsAre(65535));
    EXPECT_THAT(levels("P5 2 1 9 \x09\x0a"), ElementsAre(65535, 65535)) << "above white";
    EXPECT_THAT(messageOf(bytesOf("P5 1 1 0 \1")), HasSubstr("PBM/PGM/PPM image"));
    EXPECT_THAT(messageOf(bytesOf("P5 1 1 65536 \1\1")), HasSubstr("Invalid header"));
}

TEST(ReadJpeg2000, GreyColourAndAlpha)
{
    // OpenCV writes it with loss, but one colour is exact.
    const auto read = [](int type, const cv::Scalar& colour, Channel channel) {
        const Mask mask = decodeMask(encodeMat(cv::Mat(40, 50, type, colour), ".jp2"), only(channel));
        EXPECT_EQ(mask.width, 50);
        EXPECT_EQ(mask.height, 40);
        return mask.at(20, 30) / 65535.0;
    };
    EXPECT_NEAR(read(CV_8UC1, {51}, Channel::Luma), 0.2, 1.0 / 255);
    EXPECT_NEAR(read(CV_16UC1, {13107}, Channel::Luma), 0.2, 1.0 / 255);
    const cv::Scalar blue_green_red_alpha(51, 102, 255, 153);
    EXPECT_NEAR(read(CV_8UC3, blue_green_red_alpha, Channel::Luma), luma(1, 0.4, 0.2), 1.0 / 255);
    EXPECT_NEAR(read(CV_8UC4, blue_green_red_alpha, Channel::Luma), 0.6 * luma(1, 0.4, 0.2), 1.0 / 255);
    EXPECT_NEAR(read(CV_8UC4, blue_green_red_alpha, Channel::Alpha), 0.6, 1.0 / 255);
}

TEST(ReadFloats, MaskLevelsAreClippedToBlackAndWhite)
{
    const cv::Mat grey = (cv::Mat_<float>(1, 5) << -1, 0, 0.5, 1, 7);
    cv::Mat colour;
    cv::merge(std::vector<cv::Mat>{grey, grey, grey}, colour);
    const auto levels = [](const cv::Mat& image, const char* extension) {
        return decodeMask(encodeMat(image, extension), only(Channel::Luma)).coverage;
    };
    EXPECT_THAT(levels(grey, ".exr"), ElementsAre(0, 0, 32768, 65535, 65535));
    EXPECT_THAT(levels(colour, ".exr"), ElementsAre(0, 0, 32768, 65535, 65535));
    EXPECT_THAT(levels(cv::Mat(colour.colRange(1, 5)), ".hdr"), ElementsAre(0, 32768, 65535, 65535));

    // Colours of OpenEXR are premultiplied.
    const cv::Mat clear(1, 2, CV_32FC4, cv::Scalar(0.25, 0.25, 0.25, 0.5));
    const Bytes encoded = encodeMat(clear, ".exr");
    EXPECT_EQ(decodeMask(encoded, only(Channel::Luma)).at(0, 0), 16384);
    EXPECT_EQ(decodeMask(encoded, only(Channel::Alpha)).at(0, 0), 32768);
}

}  // namespace
}  // namespace droplet
