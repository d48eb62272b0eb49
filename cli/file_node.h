// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace cli {

/// Device and inode of a file, the same for all its hard links.
using FileNode = std::pair<std::uint64_t, std::uint64_t>;

/// Inode of a path; nothing if the file does not exist.
std::optional<FileNode> nodeOf(const std::string& path);

/// Standard stream that may be a file.
enum class Stream { Input, Output };

/// Inode of a standard stream that is a regular file, as in `program - out < out`.
std::optional<FileNode> nodeOf(Stream stream);

}  // namespace cli
