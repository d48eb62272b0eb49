// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace droplet {

/// @throws Error InvalidArgument, `subject` before its complaint: not UTF-8, with the first byte that is not
std::u32string decodeUtf8(std::string_view text, const std::string& subject);

/// @param character  a Unicode scalar value
std::string encodeUtf8(char32_t character);

/// A code point as Unicode writes it: `U+0041`.
std::string codePointOf(char32_t character);

}  // namespace droplet
