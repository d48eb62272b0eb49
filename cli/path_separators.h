// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>

namespace cli {

/// Characters that separate the parts of a path, as std::string::find_last_of() takes them: on Windows, both slashes.
inline constexpr std::array<char, 3> kPathSeparators{'/', static_cast<char>(std::filesystem::path::preferred_separator),
                                                     '\0'};

}  // namespace cli
