// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/vector.h"

namespace cli {

/// Value of an option as text.
struct Given {
    std::string text;
    std::string subject;  ///< name of the option in messages
};

/// Throws an error about the command line.
/// @throws droplet::Error InvalidArgument
[[noreturn]] void refuse(const std::string& message);

/// Refuses a value; the message is "OPTION: 'VALUE' must be CONSTRAINT".
/// @throws droplet::Error InvalidArgument
[[noreturn]] void refuse(const Given& given, const std::string& constraint);

/// Runs a function of the library and puts the option's name before its error message.
template <typename Function>
auto forOption(const std::string& subject, Function function)
{
    try {
        return function();
    } catch (const droplet::Error& error) {
        throw droplet::Error(error.code(), subject + ": " + error.what());
    }
}

/// Name that differs from a word by at most two letters; empty if there is none.
std::string nearestName(std::string_view word, const std::vector<std::string>& names);

/// Allowed range of a quantity. Beyond it, results have no meaning, or squares and single-precision files overflow.
struct Range {
    droplet::Dimension dimension;
    double min;
    double max;
    const char* allowed;  ///< range in words, for messages
};

inline constexpr Range kLength{droplet::Dimension::Length, 1e-9, 1e3, "from 1nm to 1000m"};

/// Parses a quantity, in SI units.
/// @throws droplet::Error InvalidArgument: not a quantity of the range's dimension, or out of range
double quantity(const Given& given, const Range& range);

/// Number, if the whole text is a finite number.
std::optional<double> finiteNumber(std::string_view text);

/// Allowed range of a whole number.
struct CountRange {
    std::size_t min;
    std::size_t max;
    std::string max_text;  ///< for messages, such as `1M`
};

/// Parses a count such as 5000, 5k, 2.5k or 1M.
/// @throws droplet::Error InvalidArgument: not a whole number of the range
std::size_t count(const Given& given, const CountRange& range);

/// Value of a name.
/// @param known           pairs of names and values
/// @throws droplet::Error InvalidArgument, listing the known names
template <typename Known>
auto choiceOf(const Given& given, const Known& known)
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

template <typename Value>
Value choice(const Given& given, std::initializer_list<std::pair<const char*, Value>> known)
{
    return choiceOf(given, known);
}

/// Names of things as the words of an option: water|ethanol|glycerol.
/// @param name  of a thing: a member, or a function
template <typename Things, typename Name>
std::string wordsOf(const Things& things, const Name& name)
{
    std::string words;
    for (const auto& thing : things) {
        words += (words.empty() ? "" : "|") + std::string(std::invoke(name, thing));
    }
    return words;
}

/// A number in SI units, or a quantity.
double plainOr(const Given& given, const Range& range);

/// Parts of a list with commas.
std::vector<Given> partsOf(const Given& given);

/// A vector of a file's frame, turned to z up.
droplet::Vec3 vector(const Given& given, const Range& range);

/// A unit vector of a file's frame, turned to z up.
droplet::Vec3 direction(const Given& given);

}  // namespace cli
