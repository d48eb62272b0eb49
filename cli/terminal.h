// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace cli {

/// Erases the line that the cursor is in.
inline constexpr const char* kEraseLine = "\r\033[K";

enum class Colour { Red, Yellow, Bold };

/// Whether standard error goes to a terminal that can move its cursor.
bool errorIsTerminal();

/// The text in a colour, if standard error is a terminal and NO_COLOR is unset or empty.
std::string paint(std::string_view text, Colour colour);

/// The text without line breaks and other control characters: file names may hold any.
std::string oneLine(std::string_view text);

}  // namespace cli
