// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "droplet/error.h"

namespace droplet {

/// Entry of a list whose `name` is this one.
/// @param what   name of the value in the message: `preset`
/// @throws Error InvalidArgument if there is none; the message lists all names
template <typename Entry>
const Entry& entryNamed(const std::vector<Entry>& known, std::string_view name, const char* what)
{
    constexpr std::size_t kShown = 40;  // letters of a name that is not known
    std::string names;
    for (const Entry& entry : known) {
        if (entry.name == name) {
            return entry;
        }
        names += (names.empty() ? "" : ", ") + entry.name;
    }
    throw Error(ErrorCode::InvalidArgument,
                std::string(what) + " is '" + std::string(name.substr(0, kShown)) + "', must be one of " + names);
}

}  // namespace droplet
