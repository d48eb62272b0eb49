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

/// Reads the flat part of TOML that options need: `key = value` lines and comments; strings, numbers and booleans.
/// What it does not read it refuses, so that nothing in a file is passed over in silence.
/// @throws droplet::Error InvalidArgument, naming file and line
std::vector<ConfigEntry> readConfig(const std::string& path);

}  // namespace cli
