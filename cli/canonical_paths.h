// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace cli {

/// Canonical paths: absolute and without symbolic links, so that each file has one.
class CanonicalPaths {
public:
    std::string of(const std::string& path);

private:
    std::unordered_map<std::string, std::string> folders_;  ///< canonical folders by given folder: many files share one
};

/// Device and inode of a file, the same for all its hard links.
using FileNode = std::pair<dev_t, ino_t>;

/// Inode of a path; nothing if the file does not exist.
std::optional<FileNode> nodeOf(const std::string& path);

}  // namespace cli
