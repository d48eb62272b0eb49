// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace cli {

/// Phrase of the library's messages, and the options of the command that it speaks of.
struct NamedOption {
    std::string_view phrase;
    std::string_view options;
};

/// All phrases that options belong to.
std::span<const NamedOption> namedOptions();

/// Message of the library with the command's options in it: the library speaks of a number of triangles, the command of
/// a number of triangles (--triangles). An option that the message has already is not added again.
std::string withOptions(std::string message);

}  // namespace cli
