// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>
#include <string>

#include "droplet/error.h"
#include "droplet/type/font.h"
#include "utf8.h"

namespace droplet {
namespace {

constexpr char32_t kLast = 0x10ffff;

bool isSpace(char32_t c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

std::optional<char32_t> hexadecimal(char32_t c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    if (c >= 'A' && c <= 'F') {
        return c - 'A' + 10;
    }
    return std::nullopt;
}

class CharsetReader {
public:
    explicit CharsetReader(std::u32string text) : text_(std::move(text)) {}

    std::vector<char32_t> read()
    {
        while (skipSpace()) {
            const char32_t first = character();
            char32_t last = first;
            if (at_ + 1 < text_.size() && text_[at_] == '-' && !isSpace(text_[at_ + 1])) {
                ++at_;
                last = character();
            }
            if (last < first) {
                throw Error(ErrorCode::InvalidArgument, "charset: the range " + characterText(first) + " to " +
                                                            characterText(last) + " runs backward");
            }
            for (char32_t c = first; c <= last; ++c) {
                add(c);
            }
        }
        if (characters_.empty()) {
            throw Error(ErrorCode::InvalidArgument, "charset is empty; it must contain characters, such as A-Za-z");
        }
        return characters_;
    }

private:
    /// Skips white space. Returns false at the end.
    bool skipSpace()
    {
        while (at_ < text_.size() && isSpace(text_[at_])) {
            ++at_;
        }
        return at_ < text_.size();
    }

    char32_t character()
    {
        if (text_[at_] != 'U' || at_ + 1 >= text_.size() || text_[at_ + 1] != '+') {
            return text_[at_++];
        }
        char32_t value = 0;
        std::size_t digits = 0;
        std::size_t i = at_ + 2;
        for (; i < text_.size() && digits < 6; ++i, ++digits) {
            const std::optional<char32_t> digit = hexadecimal(text_[i]);
            if (!digit) {
                break;
            }
            value = value * 16 + *digit;
        }
        if (digits < 4) {
            return text_[at_++];
        }
        if (value > kLast) {
            throw Error(ErrorCode::InvalidArgument,
                        "charset: " + codePointOf(value) + " is not a character; the last is U+10FFFF");
        }
        at_ = i;
        return value;
    }

    void add(char32_t c)
    {
        if ((c < 0xd800 || c > 0xdfff) && seen_.insert(c).second) {
            characters_.push_back(c);
        }
    }

    std::u32string text_;
    std::size_t at_ = 0;
    std::set<char32_t> seen_;
    std::vector<char32_t> characters_;
};

}  // namespace

std::vector<char32_t> parseCharset(std::string_view charset)
{
    return CharsetReader(decodeUtf8(charset, "charset")).read();
}

std::vector<char32_t> charactersOf(std::string_view text)
{
    std::set<char32_t> seen;
    std::vector<char32_t> characters;
    for (const char32_t c : decodeUtf8(text, "the text")) {
        if (c > ' ' && (c < 0x7f || c > 0xa0) && c != 0xfeff && seen.insert(c).second) {
            characters.push_back(c);
        }
    }
    return characters;
}

std::string characterText(char32_t character)
{
    const bool shows = character > ' ' && (character < 0x7f || character > 0xa0) &&
                       (character < 0x2000 || character > 0x200f) && (character < 0x2028 || character > 0x202f) &&
                       (character < 0xd800 || character > 0xf8ff) && character < 0xe0000 && character != 0xfeff;
    return codePointOf(character) + (shows ? " '" + encodeUtf8(character) + "'" : "");
}

}  // namespace droplet
