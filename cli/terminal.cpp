// SPDX-License-Identifier: GPL-3.0-or-later
#include "terminal.h"

#include <cstdlib>
#include <iostream>

#include "droplet/printable.h"

namespace cli {
namespace {

std::string_view environment(const char* variable)
{
    const char* const value = std::getenv(variable);
    return value == nullptr ? std::string_view{} : std::string_view{value};
}

}  // namespace

std::string paint(std::string_view text, Colour colour)
{
    std::string plain(text);
    if (!errorIsTerminal() || !environment("NO_COLOR").empty()) {
        return plain;
    }
    const char* const code = colour == Colour::Red ? "31" : colour == Colour::Yellow ? "33" : "1";
    return std::string("\033[") + code + "m" + plain + "\033[0m";
}

std::string oneLine(std::string_view text)
{
    return droplet::printable(text);
}

void printError(std::string_view message)
{
    // In one piece, as another thread may end the process meanwhile.
    std::cerr << paint("droplet-shape: ", Colour::Red) + oneLine(message) + "\n" << std::flush;
}

}  // namespace cli
