// SPDX-License-Identifier: GPL-3.0-or-later
//
// Multibyte characters of the C library in UTF-8. Windows' old C library, which Debian's MinGW-w64 has, knows UTF-8 in
// its functions for files, but in no locale; and the constructor of std::filesystem::path reads a text by mbrtowc().
// These functions stand before the library's own when the program is linked.
#include <cerrno>
#include <cwchar>

namespace {

constexpr auto kInvalid = static_cast<std::size_t>(-1);
constexpr auto kIncomplete = static_cast<std::size_t>(-2);

/// Bytes of the character that begins with a byte; 0 if none does.
std::size_t lengthOf(unsigned char first)
{
    return first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
}

}  // namespace

extern "C" {

/// A character above U+FFFF gives two units: the first one for three bytes, the second one for the last byte. The
/// second one waits in the state.
std::size_t mbrtowc(wchar_t* to, const char* from, std::size_t size, std::mbstate_t* state)
{
    static std::mbstate_t own{};
    std::mbstate_t& pending = state != nullptr ? *state : own;
    if (from == nullptr) {
        pending = {};
        return 0;
    }
    if (size == 0) {
        return kIncomplete;
    }
    const auto put = [&](unsigned unit) {
        if (to != nullptr) {
            *to = static_cast<wchar_t>(unit);
        }
    };
    if (pending != 0) {
        put(static_cast<unsigned>(pending));
        pending = {};
        return 1;
    }
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(from[k]); };
    const std::size_t length = lengthOf(byte(0));
    unsigned code = length < 2 ? byte(0) : byte(0) & (0x7FU >> length);
    for (std::size_t k = 1; k < length && k < size; ++k) {
        if ((byte(k) & 0xC0U) != 0x80U) {
            errno = EILSEQ;
            return kInvalid;
        }
        code = code << 6U | (byte(k) & 0x3FU);
    }
    if (length > size) {
        return kIncomplete;
    }
    const bool is_overlong = (length == 3 && code < 0x800) || (length == 4 && (code < 0x10000 || code > 0x10FFFF));
    if (length == 0 || is_overlong || (code >= 0xD800 && code < 0xE000)) {
        errno = EILSEQ;
        return kInvalid;
    }
    if (length < 4) {
        put(code);
        return code == 0 ? 0 : length;
    }
    put(0xD800U + ((code - 0x10000U) >> 10U));
    pending = static_cast<std::mbstate_t>(0xDC00U + (code & 0x3FFU));
    return 3;
}

std::size_t mbrlen(const char* from, std::size_t size, std::mbstate_t* state)
{
    static std::mbstate_t own{};
    return mbrtowc(nullptr, from, size, state != nullptr ? state : &own);
}

std::size_t mbsrtowcs(wchar_t* to, const char** from, std::size_t size, std::mbstate_t* state)
{
    const char* at = *from;
    std::size_t count = 0;
    for (; to == nullptr || count < size; ++count) {
        wchar_t unit = 0;
        const std::size_t used = mbrtowc(&unit, at, 4, state);
        if (used == kInvalid || used == kIncomplete) {
            return kInvalid;
        }
        if (to != nullptr) {
            to[count] = unit;
        }
        if (used == 0) {
            at = nullptr;
            break;
        }
        at += used;
    }
    if (to != nullptr) {
        *from = at;
    }
    return count;
}

}  // extern "C"
