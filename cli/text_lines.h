// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/core.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "option_values.h"

namespace cli {

/// Lines of the text file that an option names.
/// @throws droplet::Error  InvalidArgument: it cannot be read
inline std::vector<std::string> readLines(const char* option, const std::string& path)
{
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
        lines.push_back(line);
    }
    // A directory opens and fails at the first read; a missing file fails at once.
    if (!file.eof()) {
        refuse(fmt::format("{}: {} cannot be read: {}", option, path, std::strerror(errno)));
    }
    return lines;
}

}  // namespace cli
