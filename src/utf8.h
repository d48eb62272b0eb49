// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace droplet {

/// Character of a text in UTF-8.
struct Utf8Character {
    char32_t value;     ///< a Unicode scalar value
    std::size_t bytes;  ///< 1 to 4
};

/// Character that begins at a byte of a text; nothing if the bytes there are not valid.
/// @param begin  less than the text's size
std::optional<Utf8Character> characterAt(std::string_view text, std::size_t begin);

/// Decodes UTF-8.
/// @param subject  start of the error message
/// @throws Error   InvalidArgument: not UTF-8; the message gives the first wrong byte
std::u32string decodeUtf8(std::string_view text, const std::string& subject);

/// Encodes a character as UTF-8.
/// @param character  a Unicode scalar value
std::string encodeUtf8(char32_t character);

/// Code point in the notation of Unicode: `U+0041`.
std::string codePointOf(char32_t character);

}  // namespace droplet
