// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "droplet/error.h"

namespace binding {

/// Arguments of a command, in the order of its command line: `--width=20mm`, `--open`.
using Arguments = std::vector<std::string>;

/// Parses arguments by the rules of a command.
/// @param parse           such as cli::parseShape
/// @param arguments       options, then positional arguments
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
template <typename Options>
Options parsed(std::variant<Options, std::string> (*parse)(int, const char* const*), const Arguments& arguments)
{
    std::vector<const char*> words{"droplet-shape"};
    for (const std::string& argument : arguments) {
        words.push_back(argument.c_str());
    }
    auto result = parse(static_cast<int>(words.size()), words.data());
    if (auto* options = std::get_if<Options>(&result)) {
        return std::move(*options);
    }
    throw droplet::Error(droplet::ErrorCode::InvalidArgument, "help and version are not options of the module");
}

}  // namespace binding
