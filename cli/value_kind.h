// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace cli {

/// What the value of an option is, for programs that set it.
struct ValueKind {
    std::string_view kind;       ///< such as `length` or `path`; `words` for one of several words
    std::string_view unit = {};  ///< SI unit of a plain number; empty if it has none
};

/// Kind of a value, by its name in the help, such as `LENGTH`, or its allowed words, such as `linear|exact`.
/// @return none if no kind has this name; every option's value has one
std::optional<ValueKind> valueKind(std::string_view name);

}  // namespace cli
