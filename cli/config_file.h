// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace cli {

/// One `key = value` of a configuration file.
struct ConfigEntry {
    std::string key;
    std::string value;  ///< a string without its quotes, or a bare number, true or false
    int line = 0;
};

/// Reads `key = value` lines of TOML. Tables, arrays and dates are refused, so that nothing in a file is silently
/// ignored. A number becomes the shortest text that has the same value.
/// @throws droplet::Error InvalidArgument, naming file and line
std::vector<ConfigEntry> readConfig(const std::string& path);

}  // namespace cli
