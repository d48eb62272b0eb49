// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"

namespace cli {

/// An option's value as text, and how to call the option in a message.
struct Given {
    std::string text;
    std::string subject;
};

/// @throws droplet::Error InvalidArgument
[[noreturn]] void refuse(const std::string& message);

/// Refuses a value, naming the option and what it must be.
/// @throws droplet::Error InvalidArgument
[[noreturn]] void refuse(const Given& given, const std::string& constraint);

/// Runs a function of the library and puts the option's name before its complaint.
template <typename Function>
auto forOption(const std::string& subject, Function function)
{
    try {
        return function();
    } catch (const droplet::Error& error) {
        throw droplet::Error(error.code(), subject + ": " + error.what());
    }
}

/// The one of the names that a word is a slip or two away from; empty if there is none.
std::string nearestName(std::string_view word, const std::vector<std::string>& names);

/// What a quantity may be. Beyond these bounds a droplet is no droplet, and squares and single-precision files
/// overflow; the words are what a message says.
struct Range {
    droplet::Dimension dimension;
    double min;
    double max;
    const char* words;
};

inline constexpr Range kLength{droplet::Dimension::Length, 1e-9, 1e3, "from 1nm to 1000m"};

/// @throws droplet::Error InvalidArgument: no quantity of the range's dimension, or beyond its bounds
double quantity(const Given& given, const Range& range);

/// The number a text is, if it is a finite one and nothing else.
std::optional<double> finiteNumber(std::string_view text);

/// A count such as 5000, 5k, 2.5k or 1M.
/// @param words           the largest in words, for a message
/// @throws droplet::Error InvalidArgument: no whole number from 1 to max
std::size_t count(const Given& given, std::size_t max, const std::string& words);

/// The value of that name.
/// @throws droplet::Error InvalidArgument, listing the names known
template <typename Value>
Value choice(const Given& given, std::initializer_list<std::pair<const char*, Value>> known)
{
    std::string names;
    for (const auto& [name, value] : known) {
        if (given.text == name) {
            return value;
        }
        names += std::string(names.empty() ? "" : ", ") + name;
    }
    refuse(given, "one of " + names);
}

}  // namespace cli
