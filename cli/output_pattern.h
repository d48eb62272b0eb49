// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>

#include "option_values.h"

namespace cli {

/// What stands for placeholders, by their names.
using PatternValues = std::map<std::string, std::string, std::less<>>;

/// A pattern such as 'out/{stem}.glb' with its placeholders filled in; {{ and }} are braces.
/// @param words           the placeholders there are, for a message: `{stem} or {index}`
/// @throws droplet::Error InvalidArgument: something else in braces, or a brace alone
std::string filled(const Given& pattern, const PatternValues& values, const std::string& words);

}  // namespace cli
