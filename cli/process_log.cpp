// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_log.h"

#include <array>
#include <regex>

namespace cli {

std::string logText(std::FILE* log)
{
    std::array<char, 4096> text{};
    std::rewind(log);
    return {text.data(), std::fread(text.data(), 1, text.size(), log)};
}

std::string firstLine(std::FILE* log)
{
    const std::string text = logText(log);
    return std::regex_replace(text.substr(0, text.find_first_of("\r\n")), std::regex(" @ 0x[0-9a-f]+"), "");
}

}  // namespace cli
