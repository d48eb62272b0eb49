// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

namespace droplet {

/// A file that is installed with the library: where the library or the command that holds this code was installed or
/// built, else in the folders that the system searches for the libraries of either.
std::optional<std::filesystem::path> installedFile(const char* name);

}  // namespace droplet
