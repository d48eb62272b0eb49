// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace cli {

/// Control sequence that erases the cursor's line.
inline constexpr const char* kEraseLine = "\r\033[K";

enum class Colour { Red, Yellow, Bold };

/// Whether standard error is a terminal that can move its cursor.
bool errorIsTerminal();

/// Text in a colour, if standard error is a terminal and NO_COLOR is unset or empty.
std::string paint(std::string_view text, Colour colour);

/// Text in one line of valid UTF-8, by droplet::printable(): file names may hold any bytes.
std::string oneLine(std::string_view text);

/// Prints a failure in one line on standard error.
void printError(std::string_view message);

}  // namespace cli
