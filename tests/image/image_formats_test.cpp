// SPDX-License-Identifier: GPL-3.0-or-later
// Every format, depth and colour type against the samples that were encoded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "image/encoded_images.h"

namespace droplet {
namespace {

using namespace encoded;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

using LevelAt = std::function<double(int, int)>;

/// Compares the luma over black and the alpha of an encoded image with the levels meant, to the bit.
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
            // Luma is rounded once, and once more where alpha takes a part of it.
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

/// As above, for samples that are grey, grey+alpha, RGB or RGB+alpha.
void expectRaster(const Bytes& encoded, const Raster& raster)
{
    const LevelAt bright = [&](int x, int y) {
        return raster.channels < 3 ? raster.level(x, y, 0)
                                   : luma(raster.level(x, y, 0), raster.level(x, y, 1), raster.level(x, y, 2));
    };
    const LevelAt alpha = [&](int x, int y) { return raster.level(x, y, raster.channels - 1); };
    expectLevels(encoded, raster.width, raster.height, bright, raster.channels % 2 == 0 ? alpha : nullptr);
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
                    kind.palette_alpha.push_back(static_cast<png_byte>(90 * i + 5));  // colours beyond are opaque
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

TEST(ReadPng, OneGreyOrColourNamedTransparent)
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

TEST(ReadTiff, EveryDepthChannelOrderAndCompression)
{
    const std::map<int, std::uint16_t> compressions{{1, COMPRESSION_NONE},
                                                    {2, COMPRESSION_ADOBE_DEFLATE},
                                                    {4, COMPRESSION_PACKBITS},
                                                    {8, COMPRESSION_LZW},
                                                    {16, COMPRESSION_NONE}};
    for (const int channels : {1, 2, 3, 4}) {
        for (const int bits : {1, 2, 4, 8, 16}) {
            for (const bool separate : {false, true}) {
                for (const int tile : {0, 16}) {
                    for (const char* mode : {"wl", "wb", "w8"}) {
                        SCOPED_TRACE(testing::Message() << channels << " channels, " << bits << " bits, " << separate
                                                        << ", tile " << tile << ", " << mode);
                        const Raster raster = noise(channels, bits, 37, 19);
                        TiffKind kind;
                        kind.photometric = channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB;
                        if (channels % 2 == 0) {
                            kind.extra_samples = {EXTRASAMPLE_UNASSALPHA};
                        }
                        kind.separate = separate;
                        kind.tile = tile;
                        kind.mode = mode;
                        kind.compression = compressions.at(bits);
                        expectRaster(encodeTiff(raster, kind), raster);
                    }
                }
            }
        }
    }
}

TEST(ReadTiff, WhiteIsZeroAndFax)
{
    Raster raster = noise(1, 1, 37, 19);
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_CCITTFAX3, COMPRESSION_CCITTFAX4}) {
        TiffKind kind;
        kind.photometric = PHOTOMETRIC_MINISWHITE;
        kind.compression = static_cast<std::uint16_t>(compression);
        expectLevels(encodeTiff(raster, kind), 37, 19, [&](int x, int y) { return 1.0 - raster.level(x, y, 0); });
    }
    raster = noise(1, 16);
    TiffKind kind;
    kind.photometric = PHOTOMETRIC_MINISWHITE;
    expectLevels(encodeTiff(raster, kind), 13, 7, [&](int x, int y) { return 1.0 - raster.level(x, y, 0); });
}

TEST(ReadTiff, Palette)
{
    for (const int bits : {1, 2, 4, 8}) {
        const Raster indices = noise(1, bits);
        TiffKind kind;
        kind.photometric = PHOTOMETRIC_PALETTE;
        const unsigned size = indices.white() + 1;
        for (unsigned i = 0; i < 3 * size; ++i) {
            kind.palette.push_back(static_cast<std::uint16_t>(i * 20011 + 300));
        }
        expectLevels(encodeTiff(indices, kind), 13, 7, [&](int x, int y) {
            const unsigned i = indices.at(x, y, 0);
            return luma(kind.palette[i], kind.palette[size + i], kind.palette[2 * size + i]) / 65535;
        });
    }
}

TEST(ReadTiff, PaletteOfEightBitColoursInEitherByte)
{
    const Raster indices = noise(1, 1);
    TiffKind kind;
    kind.photometric = PHOTOMETRIC_PALETTE;
    for (const int shift : {0, 8}) {
        kind.palette.clear();
        for (const int level : {255, 10, 255, 20, 255, 30}) {  // two reds, two greens, two blues
            kind.palette.push_back(static_cast<std::uint16_t>(level << shift));
        }
        expectLevels(encodeTiff(indices, kind), 13, 7,
                     [&](int x, int y) { return indices.at(x, y, 0) == 0 ? 1.0 : luma(10, 20, 30) / 255; });
    }
}

TEST(ReadTiff, ExtraSamplesAreAlphaOnlyIfTheFileSaysSo)
{
    Raster raster = noise(4, 8);
    TiffKind kind;
    kind.photometric = PHOTOMETRIC_RGB;
    kind.extra_samples = {EXTRASAMPLE_UNSPECIFIED};
    const LevelAt opaque = [&](int x, int y) {
        return luma(raster.level(x, y, 0), raster.level(x, y, 1), raster.level(x, y, 2));
    };
    expectLevels(encodeTiff(raster, kind), 13, 7, opaque);

    // Premultiplied: the luma stored is what is seen in front of black.
    kind.extra_samples = {EXTRASAMPLE_ASSOCALPHA};
    const Bytes encoded = encodeTiff(raster, kind);
    const Mask alpha = decodeMask(encoded, only(Channel::Alpha));
    const Mask bright = decodeMask(encoded, only(Channel::Luma));
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 13; ++x) {
            EXPECT_EQ(alpha.at(x, y), raster.at(x, y, 3) * 257);
            EXPECT_NEAR(bright.at(x, y), opaque(x, y) * 65535, 0.501);
        }
    }

    raster = noise(5, 8);
    kind.extra_samples = {EXTRASAMPLE_UNSPECIFIED, EXTRASAMPLE_UNASSALPHA};
    expectLevels(encodeTiff(raster, kind), 13, 7, opaque, [&](int x, int y) { return raster.level(x, y, 4); });
}

TEST(ReadTiff, FourSamplesWithoutAWordAreRgbAndAlpha)
{
    // OpenCV writes them so.
    const Raster raster = noise(4, 8);
    cv::Mat image(raster.height, raster.width, CV_8UC4);
    for (int y = 0; y < raster.height; ++y) {
        for (int x = 0; x < raster.width; ++x) {
            for (int c = 0; c < 4; ++c) {
                image.at<cv::Vec4b>(y, x)[c == 3 ? 3 : 2 - c] = static_cast<std::uint8_t>(raster.at(x, y, c));
            }
        }
    }
    std::vector<std::uint8_t> buffer;
    ASSERT_TRUE(cv::imencode(".tif", image, buffer));
    const auto* first = reinterpret_cast<const std::byte*>(buffer.data());
    expectRaster(Bytes(first, first + buffer.size()), raster);
}

TEST(ReadTiff, Inks)
{
    for (const int bits : {8, 16}) {
        const Raster raster = noise(4, bits);
        TiffKind kind;
        kind.photometric = PHOTOMETRIC_SEPARATED;
        const Mask mask = decodeMask(encodeTiff(raster, kind), only(Channel::Luma));
        for (int y = 0; y < 7; ++y) {
            for (int x = 0; x < 13; ++x) {
                const auto light = [&](int c) { return (1 - raster.level(x, y, c)) * (1 - raster.level(x, y, 3)); };
                EXPECT_NEAR(mask.at(x, y) / 65535.0, luma(light(0), light(1), light(2)),
                            0.51 / raster.white() + 0.51 / 65535);
            }
        }
    }
}

TEST(ReadTiff, YCbCrInsideJpegCompression)
{
    Raster raster{32, 32, 3, 8, {}};
    for (int i = 0; i < 32 * 32; ++i) {
        const bool left = i % 32 < 16;
        raster.samples.insert(raster.samples.end(), {left ? 250U : 10U, left ? 20U : 60U, left ? 30U : 200U});
    }
    const Folder folder;
    TIFF* tiff = TIFFOpen((folder / "image.tif").c_str(), "w");
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 32);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 32);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 3);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_JPEG);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_YCBCR);
    TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
    TIFFSetField(tiff, TIFFTAG_JPEGQUALITY, 100);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 32);
    for (int y = 0; y < 32; ++y) {
        auto row = packedRow(raster, y);
        TIFFWriteScanline(tiff, row.data(), static_cast<std::uint32_t>(y), 0);
    }
    TIFFClose(tiff);
    const Mask mask = readMask(folder / "image.tif", only(Channel::Luma));
    EXPECT_NEAR(mask.at(3, 20) / 257.0, luma(250, 20, 30), 2);
    EXPECT_NEAR(mask.at(28, 20) / 257.0, luma(10, 60, 200), 2);
}

TEST(ReadTiff, KindsNotReadAreNamed)
{
    TiffKind kind;
    kind.sample_format = SAMPLEFORMAT_INT;
    EXPECT_THAT(messageOf(encodeTiff(noise(1, 16), kind)), HasSubstr("not unsigned integers"));
    kind.sample_format = SAMPLEFORMAT_IEEEFP;
    EXPECT_THAT(messageOf(encodeTiff(noise(1, 16), kind)), HasSubstr("not unsigned integers"));
    kind = {};
    kind.photometric = PHOTOMETRIC_CIELAB;
    EXPECT_THAT(messageOf(encodeTiff(noise(3, 8), kind)), HasSubstr("photometric interpretation 8"));
    // libtiff may not know a compression at all.
    kind = {};
    Bytes tiff = encodeTiff(noise(1, 8), kind);
    const Bytes field{std::byte{0x03}, std::byte{0x01}, std::byte{3}, std::byte{0}};
    const auto compression = std::search(tiff.begin(), tiff.end(), field.begin(), field.end());
    ASSERT_NE(compression, tiff.end());
    *(compression + 8) = std::byte{0x77};
    *(compression + 9) = std::byte{0x77};
    EXPECT_THAT(messageOf(tiff), HasSubstr("compression 30583"));
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

TEST(ReadJpeg, Inks)
{
    const Raster raster = fields(4, 4, 2);
    for (const bool adobe : {true, false}) {
        const Mask mask = decodeMask(encodeJpeg(raster, {false, adobe, 100, {}}), only(Channel::Luma));
        for (int y = 0; y < 16; ++y) {
            for (int x = 0; x < 32; ++x) {
                // Adobe stores the paper that is left, others the ink.
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

TEST(ReadJpeg, ProgressiveFileOfVeryManyScansIsRefused)
{
    // Every coefficient alone, from its 10th bit down: the most that libjpeg writes.
    JpegKind kind;
    constexpr int kTopBit = 10;
    for (int coefficient = 0; coefficient < 64; ++coefficient) {
        for (int bit = kTopBit; bit >= 0; --bit) {
            kind.scans.push_back({1, {0}, coefficient, coefficient, bit == kTopBit ? 0 : bit + 1, bit});
        }
    }
    EXPECT_THAT(messageOf(encodeJpeg(fields(1, 1, 1), kind)), HasSubstr("more than 500 scans"));
    kind.scans.resize(11);  // the first coefficient is all these fields need
    EXPECT_EQ(decodeMask(encodeJpeg(fields(1, 1, 1), kind), only(Channel::Luma)).at(3, 3),
              decodeMask(encodeJpeg(fields(1, 1, 1)), only(Channel::Luma)).at(3, 3));
}

TEST(ReadBmp, PalettesOfEveryDepth)
{
    for (const int bits : {1, 2, 4, 8}) {
        for (const int header : {12, 40}) {
            for (const bool top_down : {false, true}) {
                if (header == 12 && top_down) {
                    continue;  // its height has no sign
                }
                SCOPED_TRACE(testing::Message() << bits << " bits, header of " << header << ", " << top_down);
                const Raster indices = noise(1, bits);
                BmpKind kind{header, static_cast<unsigned>(bits), 0, top_down, 0, {}};
                const auto colour = [](unsigned i) { return std::array{i * 9 % 256, (255 - i) % 256, i * 77 % 256}; };
                for (unsigned i = 0; i <= indices.white(); ++i) {
                    for (int c = 2; c >= 0; --c) {
                        kind.after_header.push_back(static_cast<std::byte>(colour(i)[static_cast<std::size_t>(c)]));
                    }
                    if (header > 12) {
                        kind.after_header.push_back(std::byte{0});
                    }
                }
                Bytes bmp = bmpHeader(13, 7, kind);
                for (int stored = 0; stored < 7; ++stored) {
                    auto row = packedRow(indices, top_down ? stored : 6 - stored);
                    row.resize((row.size() + 3) / 4 * 4);
                    for (const std::uint8_t byte : row) {
                        bmp.push_back(std::byte{byte});
                    }
                }
                expectLevels(bmp, 13, 7, [&](int x, int y) {
                    const auto rgb = colour(indices.at(x, y, 0));
                    return luma(rgb[0], rgb[1], rgb[2]) / 255;
                });
            }
        }
    }
}

TEST(ReadBmp, TrueColourWithAndWithoutAlpha)
{
    for (const int channels : {3, 4}) {
        const Raster raster = noise(channels, 8);
        Bytes bmp = bmpHeader(13, 7, {40, 8U * static_cast<unsigned>(channels), 0, false, 0, {}});
        for (int y = 6; y >= 0; --y) {
            for (int x = 0; x < 13; ++x) {
                for (const int c : {2, 1, 0, 3}) {
                    if (c < channels) {
                        bmp.push_back(static_cast<std::byte>(raster.at(x, y, c)));
                    }
                }
            }
            if (channels == 3) {
                bmp.push_back(std::byte{0});  // 39 bytes to 40
            }
        }
        expectRaster(bmp, raster);
    }
}

TEST(ReadBmp, FourthByteLeftAtZeroIsNotAlpha)
{
    Bytes bmp = bmpHeader(2, 1, {40, 32, 0, false, 0, {}});
    appendLittle(bmp, 0x00ffffff, 4);
    appendLittle(bmp, 0x00000000, 4);
    expectLevels(bmp, 2, 1, [](int x, int) { return x == 0 ? 1.0 : 0.0; });
}

TEST(ReadBmp, ColourMasks)
{
    struct Case {
        int header;
        unsigned bits;
        std::vector<unsigned> masks;
    };
    for (const auto& [header, bits, masks] :
         {Case{40, 16, {0xf800, 0x07e0, 0x001f}}, Case{40, 16, {0x7c00, 0x03e0, 0x001f}},
          Case{108, 16, {0x0f00, 0x00f0, 0x000f, 0xf000}}, Case{124, 32, {0xff, 0xff00, 0xff0000, 0xff000000}},
          Case{124, 32, {0x3ff00000, 0x000ffc00, 0x000003ff, 0xc0000000}}}) {
        SCOPED_TRACE(testing::Message() << header << " " << bits << " " << masks.size());
        BmpKind kind{header, bits, 3, false, 0, {}};
        Bytes after;
        for (const unsigned mask : masks) {
            appendLittle(after, mask, 4);
        }
        if (header == 40) {
            kind.after_header = after;
        } else {
            after.resize(static_cast<std::size_t>(header - 40));
        }
        Bytes bmp = bmpHeader(5, 1, kind);
        if (header > 40) {
            bmp.insert(bmp.end(), after.begin(), after.end());
        }
        const std::array<unsigned, 5> pixels{0, 0xffffffff, 0x12345678, 0x9abcdef1, 0x87654321};
        for (const unsigned pixel : pixels) {
            appendLittle(bmp, pixel, static_cast<int>(bits / 8));
        }
        bmp.resize((bmp.size() + 3) / 4 * 4 + 4);
        const auto level = [&, m = masks](int x, std::size_t c) {
            return (pixels[static_cast<std::size_t>(x)] & m[c]) / double(m[c]);
        };
        const Mask mask = decodeMask(bmp, only(Channel::Luma));
        for (int x = 0; x < 5; ++x) {
            const double alpha = masks.size() == 4 ? level(x, 3) : 1.0;
            EXPECT_NEAR(mask.at(x, 0), luma(level(x, 0), level(x, 1), level(x, 2)) * alpha * 65535, 1.6);
            if (masks.size() == 4) {
                EXPECT_NEAR(decodeMask(bmp, only(Channel::Alpha)).at(x, 0), alpha * 65535, 0.501);
            }
        }
    }
}

TEST(ReadBmp, RunLengths)
{
    BmpKind kind{40, 8, 1, false, 3, {}};
    for (const unsigned grey : {0U, 100U, 255U}) {
        appendLittle(kind.after_header, grey | grey << 8 | grey << 16, 4);
    }
    const auto decoded = [&](std::initializer_list<unsigned> runs) {
        Bytes bmp = bmpHeader(5, 3, kind);
        for (const unsigned byte : runs) {
            bmp.push_back(static_cast<std::byte>(byte));
        }
        std::vector<int> levels;
        for (const std::uint16_t level : decodeMask(bmp, only(Channel::Luma)).coverage) {
            levels.push_back(level / 257);
        }
        return levels;
    };
    // A run, the end of the line; three as they are and their padding; a jump by (1, 1); the end.
    EXPECT_THAT(decoded({4, 1, 0, 0, 0, 3, 2, 0, 2, 0, 0, 2, 1, 1, 1, 2, 0, 1}),
                ElementsAre(0, 0, 0, 0, 255, 255, 0, 255, 0, 0, 100, 100, 100, 100, 0));
    EXPECT_THAT(decoded({5, 1, 0, 0, 5, 2, 0, 0, 5, 1}),
                ElementsAre(100, 100, 100, 100, 100, 255, 255, 255, 255, 255, 100, 100, 100, 100, 100))
        << "without the mark of the end";
    EXPECT_THAT(messageOf([&] { decoded({5, 1, 0, 0, 5, 2, 0, 0, 4, 1}); }), HasSubstr("too early"));
    EXPECT_THAT(messageOf([&] { decoded({5, 3, 0, 1}); }), HasSubstr("colour 3 of a palette of 3"));
    kind.bits = 4;
    kind.compression = 2;
    EXPECT_THAT(decoded({5, 0x12, 0, 0, 0, 5, 0x21, 0x02, 0x10, 0, 0, 0, 5, 0x22, 0, 1}),
                ElementsAre(255, 255, 255, 255, 255, 255, 100, 0, 255, 100, 100, 255, 100, 255, 100));
}

TEST(ReadBmp, KindsNotReadAreNamed)
{
    for (const auto& [bits, compression] : std::vector<std::pair<unsigned, unsigned>>{
             {24, 4}, {0, 5}, {24, 1}, {4, 1}, {8, 2}, {24, 3}, {3, 0}, {64, 0}}) {
        Bytes bmp = bmpHeader(2, 2, {40, bits, compression, false, 0, {}});
        bmp.resize(2000);
        EXPECT_THAT(messageOf(bmp), AllOf(HasSubstr("compression " + std::to_string(compression)),
                                          HasSubstr(std::to_string(bits) + " bits")));
    }
}

TEST(ReadWebp, WithoutLossToTheBit)
{
    expectRaster(encodeWebp(noise(3, 8)), noise(3, 8));
    expectRaster(encodeWebp(noise(4, 8)), noise(4, 8));
}

TEST(ReadWebp, WithLossNearly)
{
    for (const int channels : {3, 4}) {
        Raster raster{32, 32, channels, 8, {}};
        for (int i = 0; i < 32 * 32; ++i) {
            raster.samples.insert(raster.samples.end(), 3, i % 32 < 16 ? 220 : 60);
            if (channels == 4) {
                raster.samples.push_back(i / 32 < 16 ? 255 : 100);
            }
        }
        const Bytes webp = encodeWebp(raster, 95);
        const Mask mask = decodeMask(webp, only(Channel::Luma));
        EXPECT_NEAR(mask.at(5, 5) / 257.0, 220, 3);
        EXPECT_NEAR(mask.at(25, 5) / 257.0, 60, 3);
        if (channels == 4) {
            EXPECT_EQ(decodeMask(webp, only(Channel::Alpha)).at(5, 25), 100 * 257);
        }
    }
}

TEST(ReadWebp, AnimationIsNamed)
{
    Bytes webp = bytesOf("RIFF");
    const Bytes frame = encodeWebp(noise(3, 8));
    Bytes body = bytesOf("WEBPVP8X");
    appendLittle(body, 10, 4);
    appendLittle(body, 0x02, 4);
    appendLittle(body, 12, 3);
    appendLittle(body, 6, 3);
    const Bytes anim = bytesOf("ANIM");
    body.insert(body.end(), anim.begin(), anim.end());
    appendLittle(body, 6, 4);
    appendLittle(body, 0, 6);
    const Bytes anmf = bytesOf("ANMF");
    body.insert(body.end(), anmf.begin(), anmf.end());
    appendLittle(body, 16 + frame.size() - 12, 4);
    appendLittle(body, 0, 6);
    appendLittle(body, 12, 3);
    appendLittle(body, 6, 3);
    appendLittle(body, 100, 4);
    body.insert(body.end(), frame.begin() + 12, frame.end());
    appendLittle(webp, body.size(), 4);
    webp.insert(webp.end(), body.begin(), body.end());
    EXPECT_THAT(messageOf(webp), HasSubstr("animation"));
}

TEST(ReadNetpbm, RawAsOpenCvWritesIt)
{
    expectRaster(encodeWithOpenCv(noise(1, 8), ".pgm"), noise(1, 8));
    expectRaster(encodeWithOpenCv(noise(1, 16), ".pgm"), noise(1, 16));
    expectRaster(encodeWithOpenCv(noise(3, 8), ".ppm"), noise(3, 8));
    expectRaster(encodeWithOpenCv(noise(3, 16), ".ppm"), noise(3, 16));
}

TEST(ReadNetpbm, EveryKindByHand)
{
    const auto levels = [](std::string_view text) { return decodeMask(bytesOf(text), only(Channel::Luma)).coverage; };
    EXPECT_THAT(levels("P1\n# black is one\n3 2\n101\n0 1 0\n"), ElementsAre(0, 65535, 0, 65535, 0, 65535));
    EXPECT_THAT(levels("P4 3 2 \xa0\x40"), ElementsAre(0, 65535, 0, 65535, 0, 65535));
    EXPECT_THAT(levels("P2 3 1 4 0 1 4 "), ElementsAre(0, 16384, 65535));
    EXPECT_THAT(levels("P2\r\n3 # three\r\n1\r\n1000\r\n0 #a\n500 1000\r\n"), ElementsAre(0, 32768, 65535));
    EXPECT_THAT(levels("P5 3 1 9 \x01\x05\x09"), ElementsAre(7282, 36408, 65535));
    EXPECT_THAT(levels("P3 2 1 1 1 1 1 0 1 0 "), ElementsAre(65535, std::lround(0.587 * 65535)));
    EXPECT_THAT(levels(std::string_view("P6 1 1 256 \x01\0\x01\0\x01\0", 17)), ElementsAre(65535));
}

TEST(ReadNetpbm, WrongNumbersAreNamed)
{
    EXPECT_THAT(messageOf(bytesOf("P5 1 1 0 \1")), HasSubstr("level of white is 0"));
    EXPECT_THAT(messageOf(bytesOf("P5 1 1 65536 \1\1")), HasSubstr("65536"));
    EXPECT_THAT(messageOf(bytesOf("P5 1 1 9 \x0a")), HasSubstr("level 10 is above the level of white, 9"));
    EXPECT_THAT(messageOf(bytesOf("P2 1 1 9 99999999999999999999 ")), HasSubstr("above the level of white"));
    EXPECT_THAT(messageOf(bytesOf("P2 1 1 9 -1")), HasSubstr("not a number"));
    EXPECT_THAT(messageOf(bytesOf("P1 1 1 2")), HasSubstr("neither 0 nor 1"));
    EXPECT_THAT(messageOf(bytesOf("P5 x 1 9 \1")), HasSubstr("other than numbers"));
    EXPECT_THAT(messageOf(bytesOf("P5 1 1 9x")), HasSubstr("white space"));
    EXPECT_THAT(messageOf(bytesOf("P5 2 2 255 abc")), HasSubstr("too early"));
}

}  // namespace
}  // namespace droplet
