// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>

#include "option_values.h"

namespace cli {

/// Values of placeholders, by their names.
using PatternValues = std::map<std::string, std::string, std::less<>>;

/// Replaces the placeholders of a pattern such as 'out/{stem}.glb'; {{ and }} are braces. No value leads out of the
/// folder that the pattern names.
/// @param allowed         allowed placeholders, for messages: `{stem} or {index}`
/// @throws droplet::Error InvalidArgument: an unknown placeholder, a single brace, a value that makes a folder `..`, or
/// an
///                        absolute path of a relative one
std::string fillPattern(const Given& pattern, const PatternValues& values, const std::string& allowed);

}  // namespace cli
