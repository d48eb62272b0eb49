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

/// The same of what is in a file; empty where there is none to be read.
/// @throws droplet::Error InvalidInput: it cannot be read
std::string hashOfFile(const std::optional<std::string>& path);

/// A hash of several texts, of which none can run into the next.
std::string fingerprintOf(const std::vector<std::string>& parts);

}  // namespace cli
