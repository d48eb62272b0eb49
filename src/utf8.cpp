// SPDX-License-Identifier: GPL-3.0-or-later
#include "utf8.h"

#include <fmt/core.h>

#include <cstdint>

#include "droplet/error.h"

namespace droplet {
namespace {

/// Number of bytes that follow a first byte; 4 if it is not a valid first byte.
std::size_t following(unsigned char first)
{
    if (first < 0x80) {
        return 0;
    }
    if (first < 0xc0) {
        return 4;
    }
    return first < 0xe0 ? 1 : (first < 0xf0 ? 2 : (first < 0xf8 ? 3 : 4));
}

bool isScalarValue(char32_t c)
{
    return c <= 0x10ffff && (c < 0xd800 || c > 0xdfff);
}

}  // namespace

std::optional<Utf8Character> characterAt(std::string_view text, std::size_t begin)
{
    const auto first = static_cast<unsigned char>(text[begin]);
    const std::size_t count = following(first);
    if (count == 4 || count >= text.size() - begin) {
        return std::nullopt;
    }
    char32_t c = count == 0 ? first : static_cast<char32_t>(first & (0x3fU >> count));
    for (std::size_t k = 1; k <= count; ++k) {
        const auto next = static_cast<unsigned char>(text[begin + k]);
        if ((next & 0xc0U) != 0x80U) {
            return std::nullopt;
        }
        c = (c << 6U) | (next & 0x3fU);
    }
    // Only the shortest form is valid.
    constexpr char32_t kMin[] = {0, 0x80, 0x800, 0x10000};
    return c < kMin[count] || !isScalarValue(c) ? std::nullopt : std::optional(Utf8Character{c, count + 1});
}

std::u32string decodeUtf8(std::string_view text, const std::string& subject)
{
    std::u32string characters;
    for (std::size_t i = 0; i < text.size();) {
        const auto character = characterAt(text, i);
        if (!character) {
            throw Error(ErrorCode::InvalidArgument, subject + " is not UTF-8 at byte " + std::to_string(i + 1));
        }
        characters.push_back(character->value);
        i += character->bytes;
    }
    return characters;
}

std::string encodeUtf8(char32_t c)
{
    const auto byte = [](char32_t bits) { return static_cast<char>(static_cast<unsigned char>(bits)); };
    if (c < 0x80) {
        return {byte(c)};
    }
    if (c < 0x800) {
        return {byte(0xc0 | (c >> 6U)), byte(0x80 | (c & 0x3fU))};
    }
    if (c < 0x10000) {
        return {byte(0xe0 | (c >> 12U)), byte(0x80 | ((c >> 6U) & 0x3fU)), byte(0x80 | (c & 0x3fU))};
    }
    return {byte(0xf0 | (c >> 18U)), byte(0x80 | ((c >> 12U) & 0x3fU)), byte(0x80 | ((c >> 6U) & 0x3fU)),
            byte(0x80 | (c & 0x3fU))};
}

std::string codePointOf(char32_t c)
{
    return fmt::format("U+{:04X}", static_cast<std::uint32_t>(c));
}

}  // namespace droplet
