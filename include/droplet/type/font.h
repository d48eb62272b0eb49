// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace droplet {

class FontFace;

/// Index of a glyph in its font.
using GlyphId = std::uint32_t;

/// An axis of a variable font.
struct FontAxis {
    std::string tag;   ///< four characters, such as `wght`
    std::string name;  ///< as the font calls it
    double min = 0.0;
    double standard = 0.0;  ///< where it stands unless set
    double max = 0.0;
};

/// Where an axis is to stand.
struct AxisSetting {
    std::string tag;
    double value = 0.0;
};

/// Which of a font file's fonts, and where the axes stand.
struct FontOptions {
    std::size_t face_index = 0;     ///< of a collection's fonts, counted from 0
    std::vector<AxisSetting> axes;  ///< the later of two of one tag counts
};

/// A font, opened: an immutable value, cheap to copy, whose copies may be used from several threads.
class Font {
public:
    explicit Font(std::shared_ptr<const FontFace> face) : face_(std::move(face)) {}

    [[nodiscard]] std::string family() const;          ///< such as `DejaVu Sans`; empty if the font does not say
    [[nodiscard]] std::string style() const;           ///< such as `Bold Oblique`; empty if the font does not say
    [[nodiscard]] std::size_t glyphCount() const;      ///< glyphs are 0 … glyphCount() − 1
    [[nodiscard]] std::vector<FontAxis> axes() const;  ///< none unless the font is variable

    /// The glyph of a character; none if the font lacks it.
    [[nodiscard]] std::optional<GlyphId> glyphOf(char32_t character) const;

    /// The least of the characters a glyph stands for; none for ligatures, alternates and the like.
    [[nodiscard]] std::optional<char32_t> characterOf(GlyphId glyph) const;

    /// What the font calls a glyph, such as `ampersand`; `glyph` and its index where it has no name for it.
    [[nodiscard]] std::string nameOf(GlyphId glyph) const;

    /// The library's own.
    [[nodiscard]] const FontFace& face() const { return *face_; }

private:
    std::shared_ptr<const FontFace> face_;
};

/// Opens a font with outlines: TrueType, OpenType, collections of them, WOFF, Type 1.
/// @param encoded  a font file's bytes
/// @throws Error   InvalidInput: not such a font, or one of pictures in place of outlines; InvalidArgument: a face or
///                 axis the font does not have, or a value beyond its range; the message lists what there is
Font decodeFont(std::span<const std::byte> encoded, const FontOptions& options = {});

/// Opens a font file; errors name it.
/// @throws Error  as decodeFont(), and InvalidInput if the file cannot be read
Font readFont(const std::filesystem::path& path, const FontOptions& options = {});

/// The characters a charset names, in its order, each once.
///
/// A charset is characters one after another and ranges of two with a hyphen between, as in `A-Za-z&`; a character is
/// written as itself or as `U+` and its code point in 4 to 6 hexadecimal digits, as in `U+0391-U+03A9`. A hyphen first
/// or last is a character. White space between is passed over.
/// @param charset  UTF-8
/// @throws Error   InvalidArgument: empty, not UTF-8, a range that runs backward, a code point beyond U+10FFFF
std::vector<char32_t> parseCharset(std::string_view charset);

/// The characters that occur in a text but white space and control characters, in order of first occurrence, each once.
/// @throws Error  InvalidArgument: not UTF-8
std::vector<char32_t> charactersOf(std::string_view text);

/// A character as messages show it: `U+0041 'A'`, without the character where it shows nothing.
std::string shownCharacter(char32_t character);

}  // namespace droplet
