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

/// Reads TOML, of which options need no tables, arrays or dates: what it does not read it refuses, so that nothing in a
/// file is passed over in silence. A number is given by its value, in the fewest digits that tell it.
/// @throws droplet::Error InvalidArgument, naming file and line
std::vector<ConfigEntry> readConfig(const std::string& path);

}  // namespace cli
