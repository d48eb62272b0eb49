// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/type/font.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/type/glyph.h"
#include "support/fonts.h"
#include "support/paths.h"

namespace droplet {
namespace {

using testing::bytesOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::kSans;
using testing::kVariable;

template <typename Function>
void expectError(ErrorCode code, const std::vector<std::string>& words, Function function)
{
    try {
        function();
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        for (const std::string& word : words) {
            EXPECT_THAT(error.what(), HasSubstr(word));
        }
    }
}

TEST(Font, HasNamesGlyphsAndCharacters)
{
    const Font font = readFont(kSans);
    EXPECT_EQ(font.family(), "DejaVu Sans");
    EXPECT_EQ(font.style(), "Book");
    EXPECT_EQ(font.glyphCount(), 6253U);
    EXPECT_TRUE(font.axes().empty());
    const GlyphId a = font.glyphOf('A').value();
    EXPECT_EQ(font.nameOf(a), "A");
    EXPECT_EQ(font.characterOf(a), U'A');
    EXPECT_EQ(font.nameOf(0), ".notdef");
    EXPECT_FALSE(font.characterOf(0));
    EXPECT_FALSE(font.glyphOf(U'水'));
    EXPECT_EQ(font.nameOf(font.glyphOf('&').value()), "ampersand");
}

TEST(Font, CopiesShareTheFace)
{
    const Font font = readFont(kSans);
    const Font copy = font;
    EXPECT_EQ(&copy.face(), &font.face());
}

TEST(Font, AxesHaveTagsAndRanges)
{
    const std::vector<FontAxis> axes = readFont(kVariable).axes();
    const auto weight = std::find_if(axes.begin(), axes.end(), [](const FontAxis& a) { return a.tag == "wght"; });
    ASSERT_NE(weight, axes.end());
    EXPECT_EQ(weight->name, "Weight");
    EXPECT_EQ(weight->min, 100.0);
    EXPECT_EQ(weight->standard, 400.0);
    EXPECT_EQ(weight->max, 900.0);
}

TEST(Font, ErrorsOfAxesListTheExistingOnes)
{
    expectError(ErrorCode::InvalidArgument, {"Inter.var.ttf", "axis 'wdth'", "no such axis", "wght from 100 to 900"},
                [] {
                    readFont(kVariable, {0, {{"wdth", 100}}});
                });
    expectError(ErrorCode::InvalidArgument, {"axis 'wght': 1000 is out of range", "wght from 100 to 900"}, [] {
        readFont(kVariable, {0, {{"wght", 1000}}});
    });
    expectError(ErrorCode::InvalidArgument, {"axis 'wght': nan is out of range"}, [] {
        readFont(kVariable, {0, {{"wght", std::stod("nan")}}});
    });
    expectError(ErrorCode::InvalidArgument, {"axis 'wght': the font has no axes"}, [] {
        readFont(kSans, {0, {{"wght", 400}}});
    });
    expectError(ErrorCode::InvalidArgument, {"axis 'wght': 1000"}, [] {
        readFont(kVariable, {0, {{"wght", 1000}, {"wght", 900}}});
    });
}

TEST(Font, FacesAreCountedFromZero)
{
    EXPECT_NO_THROW(readFont(kSans, {0, {}}));
    expectError(ErrorCode::InvalidArgument, {"face index 1 is too large", "one font, 0"}, [] {
        readFont(kSans, {1, {}});
    });
}

/// Collection of fonts after the OpenType specification: `ttcf`, version 1.0, and offsets of their table directories.
/// Offsets in those count from the beginning of the file, so they change.
std::vector<std::byte> collectionOf(const std::vector<std::vector<std::byte>>& fonts)
{
    std::vector<std::byte> file;
    const auto put = [&](std::vector<std::byte>& bytes, std::size_t at, std::uint32_t value) {
        for (std::size_t k = 0; k < 4; ++k) {
            bytes[at + k] = static_cast<std::byte>(value >> (24U - 8U * k));
        }
    };
    const auto get = [](const std::vector<std::byte>& bytes, std::size_t at, std::size_t count) {
        std::uint32_t value = 0;
        for (std::size_t k = 0; k < count; ++k) {
            value = value << 8U | std::to_integer<std::uint32_t>(bytes[at + k]);
        }
        return value;
    };
    file.resize(12 + 4 * fonts.size());
    put(file, 0, 0x74746366);
    put(file, 4, 0x00010000);
    put(file, 8, static_cast<std::uint32_t>(fonts.size()));
    for (std::size_t i = 0; i < fonts.size(); ++i) {
        const auto begin = static_cast<std::uint32_t>(file.size());
        put(file, 12 + 4 * i, begin);
        std::vector<std::byte> font = fonts[i];
        for (std::size_t table = 0; table < get(font, 4, 2); ++table) {
            const std::size_t at = 12 + 16 * table + 8;
            put(font, at, get(font, at, 4) + begin);
        }
        file.insert(file.end(), font.begin(), font.end());
        file.resize((file.size() + 3) / 4 * 4);
    }
    return file;
}

TEST(Font, CollectionsHaveSeveralFonts)
{
    const std::vector<std::byte> both = collectionOf({bytesOf(kSans), bytesOf(testing::kSerif)});
    EXPECT_EQ(decodeFont(both, {0, {}}).family(), "DejaVu Sans");
    EXPECT_EQ(decodeFont(both, {1, {}}).family(), "DejaVu Serif");
    expectError(ErrorCode::InvalidArgument, {"face index 2 is too large", "fonts 0 to 1"}, [&] {
        decodeFont(both, {2, {}});
    });
    expectError(ErrorCode::InvalidArgument, {"face index 65536 is too large"}, [&] { decodeFont(both, {65536, {}}); });
}

TEST(Font, FilesThatAreNotFontsAreRefused)
{
    expectError(ErrorCode::InvalidInput, {"is not a font"}, [] { decodeFont({}); });
    expectError(ErrorCode::InvalidInput, {"cannot read /no/such.ttf"}, [] { readFont("/no/such.ttf"); });
    expectError(ErrorCode::InvalidInput, {"cannot read /usr"}, [] { readFont("/usr"); });
    expectError(ErrorCode::InvalidInput, {"CMakeLists.txt: is not a font"},
                [] { readFont(testing::inSource("CMakeLists.txt")); });
}

/// Font of two sizes of colour bitmaps; see make_bitmap_font.py.
Font bitmapFont()
{
    return readFont(testing::inSource("tests/type/bitmap.ttf"));
}

TEST(Font, ColourBitmapsAreDrawnAtTheLargestSize)
{
    // Pictures of 64 pixels for an em of 50; a small size has other pictures. D is a disc of radius 20 pixels around
    // (32, 12) above the base line, O the same with a hole of radius 10.
    const Font font = bitmapFont();
    EXPECT_EQ(font.otherColours(), "CBDT");
    GlyphOptions options;
    options.em = 50.0;  // a metre for a pixel
    const auto area = [](const Outline& outline) {
        return std::accumulate(outline.loops.begin(), outline.loops.end(), 0.0,
                               [](double sum, const Loop& loop) { return sum + signedArea(loop); });
    };
    const Outline disc = glyphOutline(font, font.glyphOf(U'D').value(), options);
    ASSERT_EQ(disc.loops.size(), 1U);
    EXPECT_NEAR(area(disc) / (std::numbers::pi * 400.0), 1.0, 5e-3);
    EXPECT_NEAR(disc.extent.x, 64.0, 1e-6);
    EXPECT_NEAR(disc.extent.y, 60.0, 1e-6);
    for (const Vec2 p : disc.loops[0].points) {
        // The line reaches from -10 to 50, so its middle is 20 above the base line.
        ASSERT_NEAR(std::hypot(p.x, p.y + 8.0), 20.0, 0.2);
    }
    const Outline ring = glyphOutline(font, font.glyphOf(U'O').value(), options);
    ASSERT_EQ(ring.loops.size(), 2U);
    EXPECT_NEAR(area(ring) / (std::numbers::pi * 300.0), 1.0, 5e-3);
    EXPECT_FALSE(hasInk(font, font.glyphOf(U' ').value(), options));

    TextOptions text;
    text.glyph = options;
    const TextLayout line = layOutText(font, "DO", text);
    EXPECT_EQ(line.outline.loops.size(), 3U);
    EXPECT_NEAR(line.outline.extent.x, 128.0, 1e-6);
}

/// Opens, measures and draws everything; only an Error is allowed.
void useAll(std::span<const std::byte> encoded)
{
    try {
        const Font font = decodeFont(encoded);
        for (std::size_t glyph = 0; glyph < font.glyphCount(); glyph += 1 + font.glyphCount() / 40) {
            try {
                glyphOutline(font, static_cast<GlyphId>(glyph));
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << error.what();
            }
        }
        layOutText(font, "AVfi\nשלום");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << error.what();
    }
}

TEST(Font, DamagedBitmapsCauseOnlyErrors)
{
    const std::vector<std::byte> whole = bytesOf(testing::inSource("tests/type/bitmap.ttf").c_str());
    for (std::size_t at = 0; at < whole.size(); at += 3) {
        std::vector<std::byte> damaged = whole;
        damaged[at] ^= std::byte{0x81};
        useAll(damaged);
    }
}

TEST(Font, BitmapFontsAreRefused)
{
    // The smallest font in the Glyph Bitmap Distribution Format: one glyph, of pixels.
    const std::string text =
        "STARTFONT 2.1\nFONT -x-Dots-Medium-R-Normal--8-80-75-75-C-80-ISO10646-1\nSIZE 8 75 75\n"
        "FONTBOUNDINGBOX 8 8 0 0\nSTARTPROPERTIES 2\nFONT_ASCENT 8\nFONT_DESCENT 0\nENDPROPERTIES\nCHARS 1\n"
        "STARTCHAR A\nENCODING 65\nSWIDTH 1000 0\nDWIDTH 8 0\nBBX 8 1 0 0\nBITMAP\nFF\nENDCHAR\nENDFONT\n";
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    expectError(ErrorCode::InvalidInput, {"bitmaps of its glyphs, not outlines; a picture of the text"}, [&] {
        decodeFont({first, text.size()});
    });
}

TEST(Font, CutOffFilesCauseOnlyErrors)
{
    const std::vector<std::byte> whole = bytesOf(testing::kSerif);
    for (std::size_t k = 0; k < 40; ++k) {
        useAll(std::span(whole).first(whole.size() * k / 40));
    }
    for (std::size_t size = 1; size < 600; size += 13) {
        useAll(std::span(whole).first(size));
    }
}

TEST(Font, DamagedFilesCauseOnlyErrors)
{
    std::mt19937 random(11);
    for (const char* path : {testing::kSerif, kVariable}) {
        const std::vector<std::byte> whole = bytesOf(path);
        for (int trial = 0; trial < 12; ++trial) {
            std::vector<std::byte> damaged = whole;
            // In the directory and heads of tables, or anywhere.
            const std::size_t reach = trial % 2 == 0 ? 2000 : damaged.size();
            for (int k = 0; k < 1 << (trial % 8); ++k) {
                damaged[random() % reach] = static_cast<std::byte>(random() & 0xffU);
            }
            useAll(damaged);
        }
    }
}

TEST(Charset, HasCharactersAndRanges)
{
    EXPECT_THAT(parseCharset("abc"), ElementsAre('a', 'b', 'c'));
    EXPECT_THAT(parseCharset("A-C0-2"), ElementsAre('A', 'B', 'C', '0', '1', '2'));
    EXPECT_THAT(parseCharset("U+0041-U+0043 U+1F600"), ElementsAre('A', 'B', 'C', U'\U0001F600'));
    EXPECT_THAT(parseCharset("ä-ü").size(), U'ü' - U'ä' + 1);
    EXPECT_THAT(parseCharset("banana"), ElementsAre('b', 'a', 'n'));
    EXPECT_THAT(parseCharset("-a"), ElementsAre('-', 'a'));
    EXPECT_THAT(parseCharset("a-"), ElementsAre('a', '-'));
    EXPECT_THAT(parseCharset("a - c"), ElementsAre('a', '-', 'c'));
    EXPECT_THAT(parseCharset("+--"), ElementsAre('+', ',', '-'));
    EXPECT_THAT(parseCharset("U+"), ElementsAre('U', '+'));
    EXPECT_THAT(parseCharset("U+41"), ElementsAre('U', '+', '4', '1')) << "four digits at least";
    EXPECT_THAT(parseCharset("U+00411"), ElementsAre(0x411));
    EXPECT_EQ(parseCharset("U+0000-U+10FFFF").size(), 0x110000U - 0x800U) << "surrogates are not characters";
}

TEST(Charset, ErrorsGiveTheReason)
{
    expectError(ErrorCode::InvalidArgument, {"charset is empty"}, [] { parseCharset(" "); });
    expectError(ErrorCode::InvalidArgument, {"U+005A 'Z' to U+0041 'A' runs backward"}, [] { parseCharset("Z-A"); });
    expectError(ErrorCode::InvalidArgument, {"U+110000 is not a character"}, [] { parseCharset("U+110000"); });
    for (const char* text : {"a\xff", "\xc3", "\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82", "\x80"}) {
        expectError(ErrorCode::InvalidArgument, {"not UTF-8 at byte"}, [&] { parseCharset(text); });
    }
}

TEST(Charset, OfATextHasItsVisibleCharacters)
{
    EXPECT_THAT(charactersOf("to be,\r\n\tor not"), ElementsAre('t', 'o', 'b', 'e', ',', 'r', 'n'));
    EXPECT_THAT(charactersOf("a-c"), ElementsAre('a', '-', 'c'));
    EXPECT_TRUE(charactersOf("").empty());
}

TEST(Charset, CharactersAreShownByCodePoint)
{
    EXPECT_EQ(characterText('A'), "U+0041 'A'");
    EXPECT_EQ(characterText(U'é'), "U+00E9 'é'");
    EXPECT_EQ(characterText(U'水'), "U+6C34 '水'");
    EXPECT_EQ(characterText(U'\U0001F4A7'), "U+1F4A7 '\U0001F4A7'");
    EXPECT_EQ(characterText('\n'), "U+000A");
    EXPECT_EQ(characterText(0x202e), "U+202E") << "it would reverse the line";
}

}  // namespace
}  // namespace droplet
