// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/printable.h"

#include <fmt/core.h>

#include <cstddef>

#include "utf8.h"

namespace droplet {
namespace {

std::string escaped(unsigned char byte)
{
    switch (byte) {
        case '\n':
            return "\\n";
        case '\r':
            return "\\r";
        case '\t':
            return "\\t";
        default:
            return fmt::format("\\x{:02x}", byte);
    }
}

/// Whether a terminal or an editor would act on a character instead of showing it.
bool isControl(char32_t c)
{
    constexpr char32_t kLineSeparator = 0x2028;
    constexpr char32_t kParagraphSeparator = 0x2029;
    return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == kLineSeparator || c == kParagraphSeparator;
}

}  // namespace

std::string printable(std::string_view text)
{
    std::string shown;
    shown.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const auto character = characterAt(text, i);
        const std::size_t count = character ? character->bytes : 1;
        if (character && !isControl(character->value)) {
            shown += text.substr(i, count);
        } else {
            for (const char byte : text.substr(i, count)) {
                shown += escaped(static_cast<unsigned char>(byte));
            }
        }
        i += count;
    }
    return shown;
}

bool isPrintable(std::string_view text)
{
    return printable(text) == text;
}

}  // namespace droplet
