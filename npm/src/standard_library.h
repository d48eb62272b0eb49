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

/// The shortest text that reads back as the same number: fmt has its digits, and the rule for the exponent is its own.
/// @param may_shift  whether a text with an exponent may be taken, which is shorter
template <typename Number>
string shortestText(Number value, bool may_shift)
{
    const string text = fmt::format("{}", value);
    if (!isfinite(value) || value == 0) {
        return text;
    }
    const size_t e = text.find('e');
    string digits;
    ptrdiff_t before_point = 0;  // digits before the point, if they begin with the first one that is not 0
    bool is_past_point = false;
    for (const char c : text.substr(0, e)) {
        is_past_point = is_past_point || c == '.';
        if (isdigit(static_cast<unsigned char>(c)) != 0) {
            if (!digits.empty() || c != '0') {
                digits += c;
                before_point += is_past_point ? 0 : 1;
            } else if (is_past_point) {
                --before_point;
            }
        }
    }
    before_point += e != string::npos ? strtol(text.c_str() + e + 1, nullptr, 10) : 0;
    digits.erase(digits.find_last_not_of('0') + 1);
    const string sign = value < 0 ? "-" : "";
    const auto count = static_cast<ptrdiff_t>(digits.size());
    const string whole = before_point <= 0       ? "0." + string(static_cast<size_t>(-before_point), '0') + digits
                         : before_point >= count ? fmt::format("{:.0f}", fabs(value))  // all digits of a large number
                                                 : digits.substr(0, static_cast<size_t>(before_point)) + '.' +
                                                       digits.substr(static_cast<size_t>(before_point));
    const string shifted =
        fmt::format("{}{}{}e{:+03d}", digits[0], count > 1 ? "." : "", digits.substr(1), before_point - 1);
    return sign + (may_shift && shifted.size() < whole.size() ? shifted : whole);
}

template <typename Number, enable_if_t<is_floating_point_v<Number>, int> = 0>
to_chars_result to_chars(char* first, char* last, Number value)
{
    return endedBy(first, last, shortestText(value, true));
}

/// With chars_format::fixed alone.
template <typename Number, enable_if_t<is_floating_point_v<Number>, int> = 0>
to_chars_result to_chars(char* first, char* last, Number value, chars_format)
{
    return endedBy(first, last, shortestText(value, false));
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
