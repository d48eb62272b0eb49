// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace droplet {

/// Text for a message of one line: valid UTF-8 without control characters, whatever bytes a file or its name holds.
/// Control characters become `\n`, `\t`, `\r` or, as bytes that are not UTF-8 do, `\x1b`. Other text stays as it is.
std::string printable(std::string_view text);

/// Whether a text is equal to its printable form: what a line of a text file can hold.
bool isPrintable(std::string_view text);

}  // namespace droplet
