// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "droplet/error.h"

namespace droplet {

/// Refuses a name that is not known.
/// @param what   name of the value in the message: `preset`
/// @param names  all known ones, as in the message
/// @throws Error InvalidArgument, always
[[noreturn]] inline void refuseName(const char* what, std::string_view name, const std::string& names)
{
    constexpr std::size_t kShown = 40;  // letters of a name that is not known
    throw Error(ErrorCode::InvalidArgument,
                std::string(what) + " is '" + std::string(name.substr(0, kShown)) + "', must be one of " + names);
}

/// Entry of a list whose `name` is this one.
/// @throws Error InvalidArgument if there is none; the message lists all names
template <typename Entry>
const Entry& entryNamed(const std::vector<Entry>& known, std::string_view name, const char* what)
{
    std::string names;
    for (const Entry& entry : known) {
        if (entry.name == name) {
            return entry;
        }
        names += (names.empty() ? "" : ", ") + entry.name;
    }
    refuseName(what, name, names);
}

/// Value of an enumeration with this name.
/// @param known  pairs of values and names
/// @throws Error InvalidArgument if there is none; the message lists all names
template <typename Value, std::size_t Count>
Value valueNamed(const std::array<std::pair<Value, const char*>, Count>& known, std::string_view name, const char* what)
{
    std::string names;
    for (const auto& [value, own] : known) {
        if (own == name) {
            return value;
        }
        names += (names.empty() ? "" : ", ") + std::string(own);
    }
    refuseName(what, name, names);
}

/// Name of a value of an enumeration.
/// @throws Error InvalidArgument if it has none
template <typename Value, std::size_t Count>
const char* nameOf(const std::array<std::pair<Value, const char*>, Count>& known, Value value, const char* what)
{
    for (const auto& [own, name] : known) {
        if (own == value) {
            return name;
        }
    }
    throw Error(ErrorCode::InvalidArgument,
                std::string(what) + " = " + std::to_string(static_cast<int>(value)) + " is unknown");
}

}  // namespace droplet
