// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace cli {

/// One name for every way to write a path: absolute, and through no links.
class Places {
public:
    std::string of(const std::string& path);

private:
    std::unordered_map<std::string, std::string> folders_;  ///< by their names as given: many files share one
};

/// Device and number of a file, which are the same whatever it is called (a hard link).
using FileNode = std::pair<dev_t, ino_t>;

/// None if there is no such file.
std::optional<FileNode> nodeOf(const std::string& path);

}  // namespace cli
