// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace droplet {

using Bytes = std::vector<std::byte>;

/// What is wrong with a file; readFile adds which.
class Damage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A path as it can stand in a message of one line.
std::string shown(const std::filesystem::path& path);

/// Up to `max` bytes of a file, which may be a pipe; of one that does not begin as `expected`, the beginning alone, so
/// that an endless device is not read for ever. What has been read is asked about every 64 KiB.
/// @throws Damage where it cannot be read
Bytes readBytes(const std::filesystem::path& path, std::size_t max, const std::function<bool(const Bytes&)>& expected);

/// The same, by the first byte.
Bytes readBytes(const std::filesystem::path& path, std::size_t max, const std::function<bool(std::byte)>& expected);

/// Runs a reader of a file. What it throws becomes one line that names the file.
/// @throws Error InvalidInput
void readFile(const std::filesystem::path& path, const std::function<void()>& read);

}  // namespace droplet
