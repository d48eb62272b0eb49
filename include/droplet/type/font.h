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

/// Axis of a variable font.
struct FontAxis {
    std::string tag;        ///< four characters, such as `wght`
    std::string name;       ///< name in the font
    double min = 0.0;       ///< smallest value
    double standard = 0.0;  ///< default value
    double max = 0.0;       ///< largest value
};

/// Value for an axis of a variable font.
struct AxisSetting {
    std::string tag;     ///< four characters, such as `wght`
    double value = 0.0;  ///< value in the range of the axis
};

/// Choice of a font in a font file, and values of its axes.
struct FontOptions {
    std::size_t face_index = 0;     ///< index of the font in a collection, from 0
    std::vector<AxisSetting> axes;  ///< if a tag occurs twice, the later one counts
    std::size_t palette = 0;        ///< index of the palette of a colour font, from 0
};

/// Open font: an immutable value that is cheap to copy. Several threads may use copies at the same time.
class Font {
public:
    /// Wraps an open face; for the library alone.
    explicit Font(std::shared_ptr<const FontFace> face) : face_(std::move(face)) {}

    [[nodiscard]] std::string family() const;          ///< such as `DejaVu Sans`; may be empty
    [[nodiscard]] std::string style() const;           ///< such as `Bold Oblique`; may be empty
    [[nodiscard]] std::size_t glyphCount() const;      ///< number of glyphs; their ids are 0 … glyphCount() − 1
    [[nodiscard]] std::vector<FontAxis> axes() const;  ///< empty unless the font is variable

    /// Glyph of a character; empty if the font has none.
    [[nodiscard]] std::optional<GlyphId> glyphOf(char32_t character) const;

    /// Lowest character that a glyph stands for; empty for ligatures, alternates and the like.
    [[nodiscard]] std::optional<char32_t> characterOf(GlyphId glyph) const;

    /// Name of a glyph in the font, such as `ampersand`; `glyph` and its index if it has no name.
    [[nodiscard]] std::string nameOf(GlyphId glyph) const;

    /// Whether glyphs may have layers in flat colours: table COLR.
    [[nodiscard]] bool hasColourLayers() const;

    /// Tag of the first table with colours that are not layers, and are not read: `SVG`, `sbix`, `CBDT`; empty if there
    /// is none.
    [[nodiscard]] std::string otherColours() const;

    /// Face behind the font; for the library alone.
    [[nodiscard]] const FontFace& face() const { return *face_; }

private:
    std::shared_ptr<const FontFace> face_;
};

/// Opens a font with outlines, or with colour bitmaps (CBDT): TrueType, OpenType, collections, WOFF, Type 1.
/// @param encoded  bytes of a font file
/// @param options  font of a collection, values of axes, palette
/// @throws Error   InvalidInput: not such a font, or other bitmaps; InvalidArgument: a face, axis or palette that the
///                 font does not have, or a value out of range; the message lists what exists
Font decodeFont(std::span<const std::byte> encoded, const FontOptions& options = {});

/// Opens a font file as decodeFont() does. Errors name the file.
/// @throws Error  as decodeFont(); InvalidInput: the file cannot be read
Font readFont(const std::filesystem::path& path, const FontOptions& options = {});

/// Lists the characters of a charset in their order, each once.
///
/// A charset is a sequence of characters and of ranges with a hyphen, as in `A-Za-z&`. A character is written as itself
/// or as `U+` and its code point in 4 to 6 hexadecimal digits, as in `U+0391-U+03A9`. A hyphen at the beginning or the
/// end is a character. White space is ignored.
/// @param charset  UTF-8
/// @throws Error   InvalidArgument: empty, not UTF-8, a reversed range, a code point beyond U+10FFFF
std::vector<char32_t> parseCharset(std::string_view charset);

/// Lists the characters of a text in order of first occurrence, each once, without white space and control characters.
/// @throws Error  InvalidArgument: not UTF-8
std::vector<char32_t> charactersOf(std::string_view text);

/// Writes a character for a message: `U+0041 'A'`, or the code point alone if the character is invisible.
std::string characterText(char32_t character);

}  // namespace droplet
