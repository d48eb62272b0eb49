// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace droplet {

/// Files of the system's fonts of a family, such as Arial and Arial Bold of Arial; empty if it has none.
std::vector<std::filesystem::path> systemFonts(const std::string& family);

}  // namespace droplet
