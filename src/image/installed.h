// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

namespace droplet {

/// Finds a file that is installed with the library. It is searched where the library or the command with this code was
/// installed or built, then in the folders that the system searches for their libraries.
std::optional<std::filesystem::path> installedFile(const char* name);

}  // namespace droplet
