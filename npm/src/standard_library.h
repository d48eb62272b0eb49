// SPDX-License-Identifier: GPL-3.0-or-later
// What the library needs of C++20 and emscripten's standard library lacks. Included before every file.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>

namespace std {

template <typename To, typename From>
To bit_cast(const From& from)
{
    static_assert(sizeof(To) == sizeof(From));
    To to;
    memcpy(&to, &from, sizeof(To));
    return to;
}

template <typename Items>
unique_ptr<Items> make_unique_for_overwrite(size_t count)
{
    return unique_ptr<Items>(new remove_extent_t<Items>[count]);
}

/// strtod of musl rounds correctly and knows only the locale C. What it takes and std::from_chars does not, is checked
/// before: white space, plus signs, hexadecimal numbers.
template <typename Number, enable_if_t<is_floating_point_v<Number>, int> = 0>
from_chars_result from_chars(const char* first, const char* last, Number& value)
{
    const char* const digits = first != last && *first == '-' ? first + 1 : first;
    if (digits == last || !(isdigit(static_cast<unsigned char>(*digits)) != 0 || strchr(".iInN", *digits) != nullptr)) {
        return {first, errc::invalid_argument};
    }
    // strtod would take 0x10 for 16; here it is 0, followed by x10.
    const bool is_hexadecimal = *digits == '0' && last - digits > 1 && (digits[1] == 'x' || digits[1] == 'X');
    const string text(first, is_hexadecimal ? digits + 1 : last);
    char* end = nullptr;
    const double number = strtod(text.c_str(), &end);
    if (end == text.c_str()) {
        return {first, errc::invalid_argument};
    }
    const char* const rest = first + (end - text.c_str());
    const bool is_too_large = isinf(number) && (isdigit(static_cast<unsigned char>(*digits)) != 0 || *digits == '.');
    if (is_too_large) {
        return {rest, errc::result_out_of_range};
    }
    value = static_cast<Number>(number);
    return {rest, errc{}};
}

inline to_chars_result endedBy(char* first, char* last, const string& text)
{
    if (text.size() > static_cast<size_t>(last - first)) {
        return {last, errc::value_too_large};
    }
    memcpy(first, text.data(), text.size());
    return {first + text.size(), errc{}};
}

template <typename Number, enable_if_t<is_floating_point_v<Number>, int> = 0>
to_chars_result to_chars(char* first, char* last, Number value)
{
    return endedBy(first, last, fmt::format("{}", value));
}

/// With chars_format::general alone.
template <typename Number, enable_if_t<is_floating_point_v<Number>, int> = 0>
to_chars_result to_chars(char* first, char* last, Number value, chars_format, int digits)
{
    return endedBy(first, last, fmt::format("{:.{}g}", value, digits));
}

/// Quickselect with the steps of GCC's library. CGAL inserts points in the order in which nth_element leaves them, and
/// other orders give other triangles than the command's.
template <typename Iterator, typename Less = std::less<>>
void selectNth(Iterator first, Iterator nth, Iterator last, Less less = {})
{
    for (int depth = 2 * static_cast<int>(bit_width(static_cast<size_t>(max<ptrdiff_t>(last - first, 1)))) - 2;
         last - first > 3; --depth) {
        if (depth == 0) {
            partial_sort(first, nth + 1, last, less);
            return;
        }
        const Iterator a = first + 1;
        const Iterator b = first + (last - first) / 2;
        const Iterator c = last - 1;
        const Iterator median = less(*a, *b) ? (less(*b, *c)   ? b
                                                : less(*a, *c) ? c
                                                               : a)
                                             : (less(*a, *c)   ? a
                                                : less(*b, *c) ? c
                                                               : b);
        iter_swap(first, median);
        Iterator low = first + 1;
        Iterator high = last;
        while (true) {
            while (less(*low, *first)) {
                ++low;
            }
            --high;
            while (less(*first, *high)) {
                --high;
            }
            if (!(low < high)) {
                break;
            }
            iter_swap(low, high);
            ++low;
        }
        (low <= nth ? first : last) = low;
    }
    // Insertion, which keeps the order of equal items.
    for (Iterator i = first; i != last; ++i) {
        rotate(upper_bound(first, i, *i, less), i, i + 1);
    }
}

}  // namespace std

#define nth_element selectNth

#define RENAME_NOREPLACE 1

extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags);
