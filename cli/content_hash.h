// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

/// SHA-256 in hexadecimal digits.
std::string hashOf(std::span<const std::byte> bytes);

/// SHA-256 of a file's content; empty without a path.
/// @throws droplet::Error InvalidInput if the file cannot be read
std::string hashOfFile(const std::optional<std::string>& path);

/// Hash of several texts. Different lists have different hashes, even if the joined texts are the same.
std::string fingerprintOf(const std::vector<std::string>& parts);

}  // namespace cli
