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

TEST(ReadBmp, FourthByteIsAlphaIfPixelsDifferInIt)
{
    for (const unsigned alpha : {0x00U, 0xffU}) {
        Bytes bmp = bmpHeader(2, 1, {40, 32, 0, false, 0, {}});
        appendLittle(bmp, 0x00ffffff | alpha << 24, 4);
        appendLittle(bmp, 0x00000000 | alpha << 24, 4);
        expectLevels(bmp, 2, 1, [](int x, int) { return x == 0 ? 1.0 : 0.0; });
        bmp.back() = std::byte{0x33};
        expectLevels(
            bmp, 2, 1, [](int x, int) { return x == 0 ? 1.0 : 0.0; },
            [alpha](int x, int) { return x == 0 ? alpha / 255.0 : 0.2; });
    }
    const Raster raster = noise(4, 8);
    BmpKind masks{108, 32, 3, true, 0, {}};  // version 4, as many programs export
    Bytes bmp = bmpHeader(raster.width, raster.height, masks);
    for (const unsigned mask : {0xff000000U, 0xff0000U, 0xff00U, 0xffU}) {
        appendLittle(bmp, mask, 4);
    }
    bmp.resize(14 + 108);
    for (int y = 0; y < raster.height; ++y) {
        for (int x = 0; x < raster.width; ++x) {
            for (int c = 3; c >= 0; --c) {
                bmp.push_back(static_cast<std::byte>(raster.at(x, y, c)));
            }
        }
    }
    expectRaster(bmp, raster);
}

TEST(ReadBmp, SixteenBitsHaveFiveOrSixForEachColour)
{
    Bytes plain = bmpHeader(2, 1, {40, 16, 0, false, 0, {}});
    appendLittle(plain, 0x7fff | 0x03e0 << 16, 4);
    expectNearly(plain, 2, 1, [](int x, int) { return x == 0 ? 1.0 : 0.587; });
    EXPECT_EQ(decodeMask(plain, only(Channel::Luma)).at(0, 0), 65535);
    BmpKind masks{40, 16, 3, false, 0, {}};
    for (const unsigned mask : {0xf800U, 0x07e0U, 0x001fU}) {
        appendLittle(masks.after_header, mask, 4);
    }
    Bytes wide = bmpHeader(2, 1, masks);
    appendLittle(wide, 0xffff | 0x001f << 16, 4);
    expectNearly(wide, 2, 1, [](int x, int) { return x == 0 ? 1.0 : 0.114; });
}

TEST(ReadBmp, PalettesOfAFewBitsAndTheirRunLengths)
{
    BmpKind kind{40, 4, 0, false, 2, {}};
    appendLittle(kind.after_header, 0x00ffffff'00000000U, 8);
    Bytes bmp = bmpHeader(3, 2, kind);
    appendLittle(bmp, 0x1001, 4);  // below: 0 1 1
    appendLittle(bmp, 0x0010, 4);  // above: 1 0 0
    const auto expected = ElementsAre(65535, 0, 0, 0, 65535, 65535);
    EXPECT_THAT(decodeMask(bmp, only(Channel::Luma)).coverage, expected);
    kind.compression = 2;
    Bytes runs = bmpHeader(3, 2, kind);
    for (const unsigned byte : {1U, 0x00U, 2U, 0x11U, 0U, 0U, 0U, 3U, 0x10U, 0x00U, 0U, 1U}) {
        runs.push_back(static_cast<std::byte>(byte));
    }
    EXPECT_THAT(decodeMask(runs, only(Channel::Luma)).coverage, expected);
    kind = {12, 1, 0, false, 0, {}};
    appendLittle(kind.after_header, 0xffffff'000000U, 6);
    Bytes old = bmpHeader(3, 2, kind);
    appendLittle(old, 0x60, 4);
    appendLittle(old, 0x80, 4);
    EXPECT_THAT(decodeMask(old, only(Channel::Luma)).coverage, expected);
    EXPECT_THAT(messageOf(bmpHeader(3, 2, {40, 24, 4, false, 0, {}})), HasSubstr("compression 4 of 24 bits"));
}

TEST(ReadGif, EveryDepthInterlacedOrNot)
{
    for (const int bits : {1, 2, 4, 8}) {
        for (const bool interlaced : {false, true}) {
            for (const int width : {1, 13, 200}) {
                const Raster raster = noise(1, bits, width, 37);
                expectRaster(encodeGif(raster, {width, 37, 0, 0, interlaced, -1}), raster);
            }
        }
    }
}

TEST(ReadGif, FirstPictureLiesOnATransparentScreen)
{
    const Raster raster = noise(1, 8);
    const auto inside = [](int x, int y) { return x >= 3 && x < 16 && y >= 5; };
    // The screen cuts off its last rows.
    Bytes file = encodeGif(raster, {20, 10, 3, 5, false, 255});
    const auto grey = [&](int x, int y) { return inside(x, y) ? raster.level(x - 3, y - 5, 0) : 0.0; };
    expectLevels(file, 20, 10, grey, [&](int x, int y) { return inside(x, y) && grey(x, y) < 1.0 ? 1.0 : 0.0; });
    // More pictures follow.
    const Bytes whole = encodeGif(raster, {13, 7, 0, 0, false, -1});
    Bytes animation = whole;
    animation.pop_back();
    animation.insert(animation.end(), whole.begin() + 13 + 3 * 256, whole.end());
    expectRaster(animation, raster);
    EXPECT_THAT(messageOf(encodeGif(raster, {20000, 20000, 0, 0, false, -1})), HasSubstr("20000 x 20000"));
}

TEST(ReadTga, ColoursGreyPaletteAndRunLengths)
{
    expectRaster(encodeTga(noise(3, 8)), noise(3, 8));
    expectRaster(encodeTga(noise(4, 8)), noise(4, 8));
    Bytes grey = tgaHeader(3, 2, {11, 8, 0x20, {}});
    for (const unsigned byte : {0x83U, 0xffU, 0x01U, 0x00U, 0x33U}) {  // a run goes on in the next row
        grey.push_back(static_cast<std::byte>(byte));
    }
    EXPECT_THAT(decodeMask(grey, only(Channel::Luma)).coverage, ElementsAre(65535, 65535, 65535, 65535, 0, 0x3333));
    Bytes palette = tgaHeader(2, 1, {1, 8, 0x10, bytesOf(std::string_view("\0\0\0\xff\xff\xff", 6))});
    appendLittle(palette, 0x0001, 2);
    EXPECT_THAT(decodeMask(palette, only(Channel::Luma)).coverage, ElementsAre(0, 65535)) << "from the right";
    Bytes high = tgaHeader(2, 1, {2, 16, 1, {}});
    appendLittle(high, 0x83e07fffU, 4);
    expectLevels(
        high, 2, 1, [](int x, int) { return x == 0 ? 1.0 : luma(0, 1, 0); },
        [](int x, int) { return x == 0 ? 0.0 : 1.0; });
    Bytes opaque = tgaHeader(2, 1, {2, 32, 8, {}});
    appendLittle(opaque, 0x00ffffff'00000000U, 8);
    expectLevels(opaque, 2, 1, [](int x, int) { return x == 0 ? 0.0 : 1.0; });
}

TEST(ReadIco, LargestPictureIsReadWithItsMask)
{
    const auto icon = [](int side, unsigned bits) {
        BmpKind kind{40, bits, 0, false, 0, {}};
        Bytes bitmap = bmpHeader(side, 2 * side, kind);
        return Bytes(bitmap.begin() + 14, bitmap.end());
    };
    Bytes small = icon(2, 32);
    for (const unsigned pixel : {0x10ffffffU, 0x20000000U, 0x30000000U, 0x40ffffffU}) {
        appendLittle(small, pixel, 4);
    }
    appendLittle(small, 0, 8);
    expectLevels(
        encodeIco({{1, encodePng(noise(3, 8, 1, 1), {PNG_COLOR_TYPE_RGB, false, {}, {}, nullptr})}, {2, small}}), 2, 2,
        [](int x, int y) { return x == y ? 0.0 : 1.0; },
        [](int x, int y) { return (y == 1 ? x + 1 : x + 3) * 16 / 255.0; });
    Bytes masked = icon(2, 24);
    appendLittle(masked, 0xffffff, 8);
    appendLittle(masked, 0xffffff, 8);
    appendLittle(masked, 0x80, 4);  // below left
    appendLittle(masked, 0x40, 4);  // above right
    expectLevels(
        encodeIco({{2, masked}}), 2, 2, [](int x, int) { return x == 0 ? 1.0 : 0.0; },
        [](int x, int y) { return x == y ? 1.0 : 0.0; });
    const Raster raster = noise(4, 8, 300, 5);
    expectRaster(encodeIco({{2, masked}, {256, encodePng(raster, {PNG_COLOR_TYPE_RGB_ALPHA, false, {}, {}, nullptr})}}),
                 raster);
    EXPECT_THAT(messageOf(encodeIco({{9, {}}})), HasSubstr("before its largest picture"));
}

TEST(ForeignFormats, NameAProgramThatConverts)
{
    using namespace std::string_view_literals;
    for (const auto& [begin, words] : {
             std::pair{"\0\0\0\x18"
                       "ftypheic\0\0\0\0mif1heic"sv,
                       "HEIC files are not read; heif-convert"},
             {"\0\0\0\x1c"
              "ftypmif1\0\0\0\0mif1avifmiaf"sv,
              "AVIF files are not read; avifdec"},
             {"%PDF-1.7\n"sv, "PDF (or Illustrator) files are not read; pdftocairo -svg"},
             {"%!PS-Adobe-3.0 EPSF-3.0\n"sv, "EPS (or Illustrator) files are not read; ps2pdf -dEPSCrop"},
             {"\xc5\xd0\xd3\xc6\x20\0\0\0"sv, "EPS (or Illustrator)"},
             {"\xff\x0a\0"sv, "JPEG XL files are not read; djxl"},
             {"8BPS\0\1"sv, "Photoshop"},
             {"gimp xcf v011"sv, "GIMP"},
         }) {
        EXPECT_THAT(messageOf(bytesOf(begin)), HasSubstr(words));
    }
    EXPECT_THAT(messageOf(bytesOf("hello")), HasSubstr("not an image this program reads (PNG"));
}

TEST(ReadWebp, LosslessIsExact)
{
    expectRaster(encodeWebp(noise(3, 8)), noise(3, 8));
    expectRaster(encodeWebp(noise(4, 8)), noise(4, 8));
}

TEST(ReadWebp, FirstPictureOfAnAnimationLiesOnATransparentCanvas)
{
    const Raster raster = noise(4, 8);
    expectRaster(webpAnimation(encodeWebp(raster), 13, 7, {13, 7, 0, 0, false, -1}, 2), raster);
    const auto inside = [](int x, int y) { return x >= 4 && x < 17 && y >= 2 && y < 9; };
    expectLevels(
        webpAnimation(encodeWebp(noise(3, 8)), 13, 7, {20, 10, 4, 2, false, -1}), 20, 10,
        [&](int x, int y) {
            const Raster colours = noise(3, 8);
            const auto level = [&](int c) { return colours.level(x - 4, y - 2, c); };
            return inside(x, y) ? luma(level(0), level(1), level(2)) : 0.0;
        },
        [&](int x, int y) { return inside(x, y) ? 1.0 : 0.0; });
    // With loss, alpha is a part of its own.
    const Mask still = decodeMask(encodeWebp(raster, 80), only(Channel::Alpha));
    EXPECT_EQ(decodeMask(webpAnimation(encodeWebp(raster, 80), 13, 7, {13, 7, 0, 0, false, -1}), only(Channel::Alpha))
                  .coverage,
              still.coverage);
    EXPECT_THAT(messageOf(webpAnimation(encodeWebp(raster), 13, 7, {16384, 16385, 0, 0, false, -1})),
                HasSubstr("16384 x 16385"));
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
